//! Sampling of the points of a study.

use super::sobol::sobol;
use jounce_signal::RandomStream;

/// Methods of choosing points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sampling {
    /// Every combination of the values of the keys; the first key varies fastest.
    Grid,
    /// The values of all keys paired by index.
    List,
    /// Independent and uniform.
    Random,
    /// One point in each of equal cells along every key; as many cells as points.
    LatinHypercube,
    /// The Sobol sequence, its digits shifted by the seed.
    Sobol,
}

impl Sampling {
    /// All methods.
    pub const ALL: [Self; 5] = [
        Self::Grid,
        Self::List,
        Self::Random,
        Self::LatinHypercube,
        Self::Sobol,
    ];

    /// Returns the name in a study.
    pub fn name(self) -> &'static str {
        match self {
            Self::Grid => "grid",
            Self::List => "list",
            Self::Random => "random",
            Self::LatinHypercube => "latin-hypercube",
            Self::Sobol => "sobol",
        }
    }

    /// True where points are drawn between the ends of a range.
    pub fn draws(self) -> bool {
        matches!(self, Self::Random | Self::LatinHypercube | Self::Sobol)
    }
}

/// Positions of drawn points in the unit cube.
#[derive(Debug, Clone)]
pub struct CubePoints {
    sampling: Sampling,
    points: usize,
    seed: u64,
    /// Per dimension, the cell of each point; only for the Latin hypercube.
    cells: Vec<Vec<u32>>,
    /// Per dimension, the shift of the digits; only for Sobol.
    shifts: Vec<u32>,
}

impl CubePoints {
    /// Creates the positions of a number of points; grids and lists have none.
    pub fn new(sampling: Sampling, dimensions: usize, points: usize, seed: u64) -> Self {
        let each = |is_used: bool| if is_used { dimensions } else { 0 };
        let cells = (0..each(sampling == Sampling::LatinHypercube))
            .map(|dimension| shuffled(points, seed, dimension as u64))
            .collect();
        let shift = |dimension| (RandomStream::new(seed, dimension as u64).seed() >> 21) as u32;
        let shifts = (0..each(sampling == Sampling::Sobol)).map(shift).collect();
        Self {
            sampling,
            points,
            seed,
            cells,
            shifts,
        }
    }

    /// Returns the position of a point along a dimension, in [0, 1).
    pub fn coordinate(&self, index: usize, dimension: usize) -> f64 {
        match self.sampling {
            Sampling::Sobol => sobol(dimension, index as u32, self.shifts[dimension]),
            Sampling::LatinHypercube => {
                let cell = f64::from(self.cells[dimension][index]);
                ((cell + self.uniform(index, dimension)) / self.points as f64)
                    .min(1.0 - f64::EPSILON)
            }
            Sampling::Random | Sampling::Grid | Sampling::List => self.uniform(index, dimension),
        }
    }

    fn uniform(&self, index: usize, dimension: usize) -> f64 {
        let mut stream =
            RandomStream::new(self.seed.wrapping_add(dimension as u64 + 1), index as u64);
        stream.uniform()
    }
}

/// Returns the numbers below `count` in an order drawn from the seed (Fisher and Yates).
fn shuffled(count: usize, seed: u64, dimension: u64) -> Vec<u32> {
    let mut cells: Vec<u32> = (0..count as u32).collect();
    let mut stream = RandomStream::new(seed, u64::MAX - dimension);
    for k in (1..count).rev() {
        cells.swap(k, (stream.uniform() * (k + 1) as f64) as usize);
    }
    cells
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_latin_hypercube_has_one_point_in_each_cell_of_every_key() {
        let draw = CubePoints::new(Sampling::LatinHypercube, 3, 100, 7);
        for dimension in 0..3 {
            let mut cells: Vec<usize> = (0..100)
                .map(|index| (100.0 * draw.coordinate(index, dimension)) as usize)
                .collect();
            assert!(!cells.iter().copied().eq(0..100), "the order is drawn");
            cells.sort_unstable();
            assert!(cells.iter().copied().eq(0..100));
        }
    }

    /// Mean and variance of 20000 uniform numbers are 1/2 and 1/12 within four standard errors, and
    /// two keys are uncorrelated.
    #[test]
    fn random_points_fill_the_cube() {
        let draw = CubePoints::new(Sampling::Random, 2, 20_000, 1);
        let points: Vec<[f64; 2]> = (0..20_000)
            .map(|index| {
                [
                    draw.coordinate(index, 0) - 0.5,
                    draw.coordinate(index, 1) - 0.5,
                ]
            })
            .collect();
        let mean =
            |value: &dyn Fn(&[f64; 2]) -> f64| points.iter().map(value).sum::<f64>() / 20_000.0;
        assert!(mean(&|p| p[0]).abs() < 4.0 * (1.0_f64 / 12.0 / 20_000.0).sqrt());
        assert!(
            (mean(&|p| p[1] * p[1]) - 1.0 / 12.0).abs() < 4.0 * (1.0_f64 / 180.0 / 20_000.0).sqrt()
        );
        assert!(mean(&|p| p[0] * p[1]).abs() < 4.0 * (1.0_f64 / 144.0 / 20_000.0).sqrt());
    }

    #[test]
    fn another_seed_gives_other_points() {
        for sampling in [Sampling::Random, Sampling::LatinHypercube, Sampling::Sobol] {
            let coordinates = |seed| {
                (0..8)
                    .map(|index| CubePoints::new(sampling, 2, 8, seed).coordinate(index, 1))
                    .collect::<Vec<f64>>()
            };
            assert_eq!(coordinates(1), coordinates(1));
            assert_ne!(coordinates(1), coordinates(2), "{}", sampling.name());
        }
    }
}
