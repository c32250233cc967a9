//! Everything that a contact step of one length needs, computed once per plant: exact flow, Duhamel weights of the contact force,
//! rows of the port displacement at the nodes, and the work of the force on the energy meters.

use super::basis::{BasisFunctions, NODES};
use super::duhamel::Duhamel;
use super::flow::Flow;
use super::flow_row::FlowRow;
use super::kernel::Kernel;
use super::output_rows::{OutputRow, OutputRowsTask, RowReading, RowRequest};
use crate::plant::EnergyMeter;
use crate::simd::{F64x8, widest};
use std::sync::OnceLock;

/// Tables of one step length and one port.
#[derive(Debug, Clone)]
pub struct ContactTable {
    /// Length, s.
    pub length_s: f64,
    /// Exact flow over it.
    pub flow: Flow,
    /// What the nodal forces do to the state and to the meters of their work.
    pub duhamel: Duhamel,
    /// Lanes of the state at the end of the step per unit nodal force, once asked for: marching does without.
    push: OnceLock<Vec<[F64x8; NODES]>>,
    /// Displacement of the port at the nodes and at the end.
    pub displacement: OutputRow,
    /// Velocity of the port.
    pub velocity: OutputRow,
    /// Answer of the displacement to a constant unit force.
    pub constant: F64x8,
    /// Answer of the displacement to a force that rises from 0 to 1.
    pub ramp: F64x8,
    /// Largest displacement under nodal forces of magnitude 1, m/N.
    pub reach_m_n: f64,
    /// Largest velocity under nodal forces of magnitude 1, m/(N s).
    pub reach_m_n_s: f64,
    /// Per load: the meter's row, integrated against the functions of the basis, of what each nodal force itself moves.
    pub loads: Vec<[F64x8; NODES]>,
    /// The same for damping.
    pub damping: [F64x8; NODES],
}

impl ContactTable {
    /// Makes the table of a length for a force in a basis.
    pub fn new(kernel: &Kernel, port: usize, basis: &BasisFunctions, length_s: f64) -> Self {
        let (plant, layout) = (&kernel.plant, &kernel.layout);
        let port_of = &plant.ports[port];
        let meter = |meter: &EnergyMeter| RowRequest {
            row: meter.port_row(port).to_vec(),
            reading: RowReading::Integral,
        };
        let pointwise = |row: &[f64]| RowRequest {
            row: row.to_vec(),
            reading: RowReading::Pointwise,
        };
        let mut rows = vec![
            pointwise(&port_of.displacement),
            pointwise(&port_of.velocity),
            meter(&kernel.meters().damping),
        ];
        rows.extend(kernel.meters().loads.iter().map(meter));
        let block = &plant.diagonal.block;
        let made = widest(OutputRowsTask {
            block,
            layout,
            basis,
            reader: basis,
            force: &port_of.force,
            rows: &rows,
            length_s,
        });
        let mut responses = made.rows.into_iter();
        let mut next = || responses.next().unwrap_or_default();
        let (displacement, velocity, damping) = (next(), next(), next());
        let weighted = |weight: &dyn Fn(usize) -> f64| {
            displacement
                .push
                .iter()
                .enumerate()
                .fold(F64x8::ZERO, |sum, (j, lane)| {
                    sum.add_scaled(weight(j), lane)
                })
        };
        Self {
            length_s,
            flow: Flow::over(block, layout, length_s),
            duhamel: if basis.is_mirrored() {
                Duhamel::mirrored(&made.from_start)
            } else {
                Duhamel::Each([made.from_start, made.towards_end])
            },
            push: OnceLock::new(),
            constant: weighted(&|_| 1.0),
            ramp: weighted(&|j| basis.places[j]),
            reach_m_n: reach(&displacement.push),
            reach_m_n_s: reach(&velocity.push),
            loads: responses.map(|response| response.push).collect(),
            displacement,
            velocity,
            damping: damping.push,
        }
    }

    /// Lanes of the state at the end of the step per unit nodal force, whose column is given.
    pub fn push(&self, column: &FlowRow) -> &[[F64x8; NODES]] {
        self.push.get_or_init(|| self.duhamel.pushes(column))
    }
}

/// Largest answer at the nodes and the end to nodal forces of magnitude 1.
pub(super) fn reach(push: &[F64x8; NODES]) -> f64 {
    (0..=NODES)
        .map(|i| push.iter().map(|lane| lane.0[i].abs()).sum())
        .fold(0.0, f64::max)
}

/// What rest on a rigid stop needs on a step, made when it happens.
#[derive(Debug, Clone)]
pub struct StickingTable {
    /// Relative acceleration of the port, without the direct share of the force.
    pub acceleration: OutputRow,
    /// From free accelerations at the nodes to the nodal forces that cancel them, kg.
    pub inverse: [[f64; NODES]; NODES],
}

impl StickingTable {
    /// For a step of one length.
    pub fn new(kernel: &Kernel, port: usize, basis: &BasisFunctions, length_s: f64) -> Self {
        use faer::linalg::solvers::DenseSolveCore;
        let plant = &kernel.plant;
        let rows = [RowRequest {
            row: kernel.acceleration_row(port),
            reading: RowReading::Pointwise,
        }];
        let (block, force) = (&plant.diagonal.block, &plant.ports[port].force);
        let made = widest(OutputRowsTask {
            block,
            layout: &kernel.layout,
            basis,
            reader: basis,
            force,
            rows: &rows,
            length_s,
        });
        let acceleration = made.rows.into_iter().next().unwrap_or_default();
        let mobility = plant.ports[port].mobility_per_kg;
        let system = faer::Mat::from_fn(NODES, NODES, |i, j| {
            (if i == j { mobility } else { 0.0 }) - acceleration.push[j].0[i]
        });
        let inverse = system.partial_piv_lu().inverse();
        Self {
            acceleration,
            inverse: std::array::from_fn(|i| std::array::from_fn(|j| inverse[(i, j)])),
        }
    }
}
