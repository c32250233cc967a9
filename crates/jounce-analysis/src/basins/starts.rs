//! Initial states of a basin computation.

use super::{Cloud, Grid};
use jounce_model::plant::Plant;

/// Initial states.
#[derive(Debug, Clone, PartialEq)]
pub enum InitialStates {
    /// A seeded cloud.
    Cloud(Cloud),
    /// A plane or a box.
    Grid(Grid),
}

impl InitialStates {
    /// Number of starts.
    pub fn len(&self) -> usize {
        match self {
            InitialStates::Cloud(cloud) => cloud.starts,
            InitialStates::Grid(grid) => grid.len(),
        }
    }

    /// True without starts.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Returns start number `index` as a physical state `(q, q', V)`.
    pub fn start(&self, plant: &Plant, index: usize) -> Vec<f64> {
        match self {
            InitialStates::Cloud(cloud) => cloud.start(plant, index),
            InitialStates::Grid(grid) => grid.start(plant, index),
        }
    }
}
