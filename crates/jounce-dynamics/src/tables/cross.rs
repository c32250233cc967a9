//! Effect of the contact force of one port on another port in contact, on a step of one length.

use super::contact::reach;
use crate::force_response::basis::NODES;
use crate::force_response::output_rows::{OutputRowsTask, RowReading, RowRequest};
use crate::kernel::{ForceBasis, Kernel};
use jounce_model::plant::EnergyMeter;
use jounce_simd::{F64x8, widest};

/// Responses of one port to the nodal forces of another, one vector per nodal force; each vector
/// holds the nodes of the responding port and the end of the step.
#[derive(Debug, Clone, Default)]
pub struct CrossTable {
    /// Displacement, m/N.
    pub displacement: [F64x8; NODES],
    /// Velocity, m/(N s).
    pub velocity: [F64x8; NODES],
    /// Acceleration without the direct effect of the force, m/(N s^2).
    pub acceleration: [F64x8; NODES],
    /// Largest displacement under nodal forces of magnitude 1, m/N.
    pub reach_m_n: f64,
    /// Largest velocity under nodal forces of magnitude 1, m/(N s).
    pub reach_m_n_s: f64,
    /// For each load, the meter row of the responding port, integrated against the functions of its
    /// basis.
    pub loads: Vec<[F64x8; NODES]>,
    /// Meter row of damping, integrated in the same way.
    pub damping: [F64x8; NODES],
}

impl CrossTable {
    /// Computes the table for the force of the first port acting on the second, each with its
    /// basis.
    pub fn new(
        kernel: &Kernel,
        [(port, shape), (other_port, reader)]: [(usize, ForceBasis); 2],
        length_s: f64,
    ) -> Self {
        let plant = &kernel.plant;
        let pointwise = |row: &[f64]| RowRequest {
            row: row.to_vec(),
            reading: RowReading::Pointwise,
        };
        let meter = |meter: &EnergyMeter| RowRequest {
            row: meter.port_row(other_port).to_vec(),
            reading: RowReading::Integral,
        };
        let observed_port = &plant.ports[other_port];
        let mut rows = vec![
            pointwise(&observed_port.displacement),
            pointwise(&observed_port.velocity),
            pointwise(&kernel.acceleration_row(other_port)),
        ];
        rows.push(meter(&kernel.meters().damping));
        rows.extend(kernel.meters().loads.iter().map(meter));
        let tables = widest(OutputRowsTask {
            block: &plant.diagonal.block,
            layout: &kernel.layout,
            basis: kernel.basis(port, shape),
            reader: kernel.basis(other_port, reader),
            force: &plant.ports[port].force,
            rows: &rows,
            length_s,
        });
        let mut responses = tables.rows.into_iter().map(|response| response.push);
        let mut next = || responses.next().unwrap_or([F64x8::ZERO; NODES]);
        let (displacement, velocity, acceleration, damping) = (next(), next(), next(), next());
        Self {
            reach_m_n: reach(&displacement),
            reach_m_n_s: reach(&velocity),
            displacement,
            velocity,
            acceleration,
            damping,
            loads: responses.collect(),
        }
    }
}
