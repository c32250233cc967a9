//! What the contact force of one port does to another port that is in contact too, on a step of one length.

use super::basis::NODES;
use super::kernel::{Kernel, Shape};
use super::response::{Making, Reading, Row};
use super::table::reach;
use crate::plant::EnergyMeter;
use crate::wide::{Lane, widest};

/// Answers of a seen port to the nodal forces of another, one lane per nodal force; each lane holds the nodes of the seen port and
/// the end of the step.
#[derive(Debug, Clone, Default)]
pub struct CrossTable {
    /// Displacement, m/N.
    pub displacement: [Lane; NODES],
    /// Velocity, m/(N s).
    pub velocity: [Lane; NODES],
    /// Acceleration without the direct share of the force, m/(N s^2).
    pub acceleration: [Lane; NODES],
    /// Largest displacement under nodal forces of magnitude 1, m/N.
    pub reach_m_n: f64,
    /// Largest velocity under nodal forces of magnitude 1, m/(N s).
    pub reach_m_n_s: f64,
    /// Per load: the meter's row of the seen port, integrated against the functions of its basis.
    pub loads: Vec<[Lane; NODES]>,
    /// The same for damping.
    pub damping: [Lane; NODES],
}

impl CrossTable {
    /// For the force of the first port as felt by the second, each with its basis.
    pub fn new(kernel: &Kernel, [(port, shape), (seen, reader)]: [(usize, Shape); 2], length_s: f64) -> Self {
        let plant = &kernel.plant;
        let pointwise = |row: &[f64]| Row { row: row.to_vec(), reading: Reading::Pointwise };
        let meter = |meter: &EnergyMeter| Row { row: meter.port_row(seen).to_vec(), reading: Reading::Integral };
        let felt = &plant.ports[seen];
        let mut rows = vec![pointwise(&felt.displacement), pointwise(&felt.velocity), pointwise(&kernel.acceleration_row(seen))];
        rows.push(meter(&kernel.meters().damping));
        rows.extend(kernel.meters().loads.iter().map(meter));
        let made = widest(Making {
            block: &plant.diagonal.block,
            layout: &kernel.layout,
            basis: kernel.basis(port, shape),
            reader: kernel.basis(seen, reader),
            force: &plant.ports[port].force,
            rows: &rows,
            length_s,
        });
        let mut answers = made.rows.into_iter().map(|response| response.push);
        let mut next = || answers.next().unwrap_or([Lane::ZERO; NODES]);
        let (displacement, velocity, acceleration, damping) = (next(), next(), next(), next());
        Self {
            reach_m_n: reach(&displacement),
            reach_m_n_s: reach(&velocity),
            displacement,
            velocity,
            acceleration,
            damping,
            loads: answers.collect(),
        }
    }
}
