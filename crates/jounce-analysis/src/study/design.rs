//! The points of a study.

use super::sampling::{CubePoints, Sampling};
use jounce_spec::NumericKey;

/// Key to be varied.
#[derive(Debug, Clone)]
pub struct Varied {
    /// Key.
    pub key: NumericKey,
    /// Values, SI; for drawn points the two ends of the range.
    pub values: Vec<f64>,
    /// True: drawn evenly in the logarithm.
    pub logarithmic: bool,
}

/// All points of a study, each computed on demand.
#[derive(Debug, Clone)]
pub struct Design {
    /// Keys to be varied.
    pub varied: Vec<Varied>,
    /// Method of choosing points.
    pub sampling: Sampling,
    points: usize,
    draw: CubePoints,
}

impl Design {
    /// Creates a design of `sample_count` points; a grid or a list has the points of its values.
    pub fn new(varied: Vec<Varied>, sampling: Sampling, sample_count: usize, seed: u64) -> Self {
        let points = match sampling {
            Sampling::Grid => varied.iter().map(|varied| varied.values.len()).product(),
            Sampling::List => varied.first().map_or(0, |varied| varied.values.len()),
            Sampling::Random | Sampling::LatinHypercube | Sampling::Sobol => sample_count,
        };
        let draw = CubePoints::new(sampling, varied.len(), points, seed);
        Self {
            varied,
            sampling,
            points,
            draw,
        }
    }

    /// Returns the number of points.
    pub fn len(&self) -> usize {
        self.points
    }

    /// True if there are no points.
    pub fn is_empty(&self) -> bool {
        self.points == 0
    }

    /// Returns the value of each key at a point, SI.
    pub fn point(&self, index: usize) -> Vec<f64> {
        let mut rest = index;
        let value = |(dimension, varied): (usize, &Varied)| match self.sampling {
            Sampling::Grid => {
                let value_index = rest % varied.values.len();
                rest /= varied.values.len();
                varied.values[value_index]
            }
            Sampling::List => varied.values[index],
            Sampling::Random | Sampling::LatinHypercube | Sampling::Sobol => {
                varied.between(self.draw.coordinate(index, dimension))
            }
        };
        self.varied.iter().enumerate().map(value).collect()
    }
}

impl Varied {
    /// Returns the value at a relative position between the two ends.
    fn between(&self, fraction: f64) -> f64 {
        let (low, high) = (self.values[0], self.values[1]);
        let value = if self.logarithmic {
            low * (high / low).powf(fraction)
        } else {
            low + (high - low) * fraction
        };
        value.clamp(low, high)
    }
}
