//! From where the marches of a basin begin.

use super::{Cloud, Grid};
use crate::plant::Plant;

/// Starts of a study.
#[derive(Debug, Clone, PartialEq)]
pub enum InitialStates {
    /// A seeded cloud.
    Cloud(Cloud),
    /// A plane or a box.
    Grid(Grid),
}

impl InitialStates {
    /// How many there are.
    pub fn len(&self) -> usize {
        match self {
            InitialStates::Cloud(cloud) => cloud.starts,
            InitialStates::Grid(grid) => grid.len(),
        }
    }

    /// True without a start.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Start number `index`, physical state `(q, q', V)`.
    pub fn start(&self, plant: &Plant, index: usize) -> Vec<f64> {
        match self {
            InitialStates::Cloud(cloud) => cloud.start(plant, index),
            InitialStates::Grid(grid) => grid.start(plant, index),
        }
    }
}
