//! Force column of a port, and the meter rows for its work.

use crate::flow::layout::StateLayout;
use crate::flow::row::FlowRow;
use jounce_model::plant::{Meters, Plant};

/// Vectors of one port in SIMD layout.
#[derive(Debug)]
pub struct PortVectors {
    /// Column of a unit force.
    pub column: FlowRow,
    /// Row of the meter of each load.
    pub loads: Vec<FlowRow>,
    /// Row of the meter of damping.
    pub damping: FlowRow,
}

impl PortVectors {
    /// Returns the vectors of every port of a plant.
    pub fn of_all(plant: &Plant, meters: &Meters, layout: &StateLayout) -> Vec<Self> {
        let block = &plant.diagonal.block;
        let of = |port: usize| {
            let row = |meter: &jounce_model::plant::EnergyMeter| {
                FlowRow::row(layout, block, meter.port_row(port))
            };
            Self {
                column: FlowRow::column(layout, block, &plant.ports[port].force),
                loads: meters.loads.iter().map(row).collect(),
                damping: row(&meters.damping),
            }
        };
        (0..plant.ports.len()).map(of).collect()
    }
}
