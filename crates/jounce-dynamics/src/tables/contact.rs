//! Tables of a contact step of one length, computed once per plant. They hold the exact flow, the
//! Duhamel weights of the contact force, the rows of the port displacement at the nodes, and the
//! work of the force on the energy meters.

use crate::flow::Flow;
use crate::flow::row::FlowRow;
use crate::force_response::basis::{BasisFunctions, NODES};
use crate::force_response::duhamel::Duhamel;
use crate::force_response::output_rows::{OutputRow, OutputRowsTask, RowReading, RowRequest};
use crate::kernel::Kernel;
use jounce_model::plant::EnergyMeter;
use jounce_simd::{F64x8, widest};
use std::sync::OnceLock;

/// Tables of one step length and one port.
#[derive(Debug, Clone)]
pub struct ContactTable {
    /// Length, s.
    pub length_s: f64,
    /// Exact flow over the step.
    pub flow: Flow,
    /// Effect of the nodal forces on the state and on the meters of their work.
    pub duhamel: Duhamel,
    /// Vectors of the state at the end of the step per unit nodal force, computed on request: the
    /// integration does not need them.
    push: OnceLock<Vec<[F64x8; NODES]>>,
    /// Displacement of the port at the nodes and at the end.
    pub displacement: OutputRow,
    /// Velocity of the port.
    pub velocity: OutputRow,
    /// Response of the displacement to a constant unit force.
    pub constant: F64x8,
    /// Response of the displacement to a force that rises from 0 to 1.
    pub ramp: F64x8,
    /// Largest displacement under nodal forces of magnitude 1, m/N.
    pub reach_m_n: f64,
    /// Largest velocity under nodal forces of magnitude 1, m/(N s).
    pub reach_m_n_s: f64,
    /// For each load, the meter row, integrated against the functions of the basis, over the motion
    /// that each nodal force causes.
    pub loads: Vec<[F64x8; NODES]>,
    /// Meter row of damping, integrated in the same way.
    pub damping: [F64x8; NODES],
}

impl ContactTable {
    /// Computes the table of a length for a force in a basis.
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
        let tables = widest(OutputRowsTask {
            block,
            layout,
            basis,
            reader: basis,
            force: &port_of.force,
            rows: &rows,
            length_s,
        });
        let mut responses = tables.rows.into_iter();
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
                Duhamel::mirrored(&tables.from_start)
            } else {
                Duhamel::Each([tables.from_start, tables.towards_end])
            },
            push: OnceLock::new(),
            constant: weighted(&|_| 1.0),
            ramp: weighted(&|j| basis.positions[j]),
            reach_m_n: reach(&displacement.push),
            reach_m_n_s: reach(&velocity.push),
            loads: responses.map(|response| response.push).collect(),
            displacement,
            velocity,
            damping: damping.push,
        }
    }

    /// Returns the vectors of the state at the end of the step per unit nodal force with a given
    /// column.
    pub fn push(&self, column: &FlowRow) -> &[[F64x8; NODES]] {
        self.push.get_or_init(|| self.duhamel.pushes(column))
    }
}

/// Returns the largest response at the nodes and the end to nodal forces of magnitude 1.
pub(crate) fn reach(push: &[F64x8; NODES]) -> f64 {
    (0..=NODES)
        .map(|i| push.iter().map(|lane| lane.0[i].abs()).sum())
        .fold(0.0, f64::max)
}

/// Tables of a step for sticking to a rigid stop, computed on request.
#[derive(Debug, Clone)]
pub struct StickingTable {
    /// Relative acceleration of the port, without the direct effect of the force.
    pub acceleration: OutputRow,
    /// Matrix from free accelerations at the nodes to the nodal forces that cancel them, kg.
    pub inverse: [[f64; NODES]; NODES],
}

impl StickingTable {
    /// Computes the tables of a step of one length.
    pub fn new(kernel: &Kernel, port: usize, basis: &BasisFunctions, length_s: f64) -> Self {
        let plant = &kernel.plant;
        let rows = [RowRequest {
            row: kernel.acceleration_row(port),
            reading: RowReading::Pointwise,
        }];
        let (block, force) = (&plant.diagonal.block, &plant.ports[port].force);
        let tables = widest(OutputRowsTask {
            block,
            layout: &kernel.layout,
            basis,
            reader: basis,
            force,
            rows: &rows,
            length_s,
        });
        let acceleration = tables.rows.into_iter().next().unwrap_or_default();
        let mobility = plant.ports[port].mobility_per_kg;
        let system = jounce_linalg::Mat::from_fn(NODES, NODES, |i, j| {
            (if i == j { mobility } else { 0.0 }) - acceleration.push[j].0[i]
        });
        let inverse = jounce_linalg::inverse(&system);
        Self {
            acceleration,
            inverse: std::array::from_fn(|i| std::array::from_fn(|j| inverse[(i, j)])),
        }
    }
}
