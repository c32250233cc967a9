//! Places that fill the unit cube.

use jounce_analysis::study::{CubePoints, MAX_SOBOL_DIMENSIONS, Sampling};

/// Sequence of places in a unit cube, drawn from a seed.
pub struct Places {
    points: CubePoints,
    dimensions: usize,
    next: usize,
}

impl Places {
    /// Starts the Sobol sequence; in many dimensions the places are independent.
    pub fn new(dimensions: usize, seed: u64) -> Self {
        let sampling = match dimensions <= MAX_SOBOL_DIMENSIONS {
            true => Sampling::Sobol,
            false => Sampling::Random,
        };
        Self {
            points: CubePoints::new(sampling, dimensions, 0, seed),
            dimensions,
            next: 0,
        }
    }

    /// Returns the next places.
    pub fn take(&mut self, count: usize) -> Vec<Vec<f64>> {
        let first = self.next;
        self.next += count;
        let coordinate = |index, dimension| self.points.coordinate(index, dimension);
        (first..self.next)
            .map(|index| (0..self.dimensions).map(|k| coordinate(index, k)).collect())
            .collect()
    }
}
