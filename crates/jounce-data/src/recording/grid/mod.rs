//! Sample positions in time or frequency.

mod corridor;
mod digits;
mod even;
pub(super) mod gaps;
mod irregular;
mod rounded;
pub(super) mod stamps;
mod steps;

use self::gaps::typical_step;
use self::stamps::Stamped;
use crate::recording::Issue;

/// Independent variable of the samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Over {
    /// Time, s.
    Time,
    /// Frequency, Hz.
    Frequency,
}

/// Sample positions, s or Hz.
#[derive(Debug, Clone, PartialEq)]
pub enum Grid {
    /// Uniform: `start + k step`.
    Even {
        /// First position.
        start: f64,
        /// Spacing, > 0.
        step: f64,
        /// Number of positions.
        count: usize,
    },
    /// One position for each sample, ascending.
    Stamped(Vec<f64>),
}

/// Error of invalid stamps.
#[derive(Debug, Clone, PartialEq, thiserror::Error, serde::Serialize)]
#[serde(untagged)]
pub enum GridError {
    /// The step or the start is not finite, or the step is not positive.
    #[error("the step is {step} from {start}; a step must be a finite number > 0")]
    Step {
        /// The start.
        start: f64,
        /// The step.
        step: f64,
    },
    /// Fewer than two stamps.
    #[error("there are {count} stamps; a rate needs at least two")]
    Few {
        /// Number of stamps.
        count: usize,
    },
    /// A uniform grid would be far longer than the recording.
    #[error(
        "the stamps span {positions:.3e} uniform positions, but there are only {samples} samples; cut the recording at its gaps into parts, or correct the stamps"
    )]
    Sparse {
        /// Number of samples.
        samples: usize,
        /// Number of positions at the typical rate.
        positions: f64,
    },
    /// A stamp is not a number.
    #[error("the stamp of sample {sample} is {value}; every stamp must be a number")]
    NotANumber {
        /// Index of the sample, from 0.
        sample: usize,
        /// Stamp.
        value: f64,
    },
    /// A stamp is earlier than the previous one.
    #[error(
        "the stamp of sample {sample} is {value}, before {before} of the sample before it; sort the recording or cut it there"
    )]
    Backwards {
        /// Index of the sample, from 0.
        sample: usize,
        /// Stamp.
        value: f64,
        /// Previous stamp.
        before: f64,
    },
}

impl Grid {
    /// Returns a uniform grid.
    ///
    /// # Errors
    /// A step that is not positive, a start that is not a number.
    pub fn even(start: f64, step: f64, count: usize) -> Result<Self, GridError> {
        if step > 0.0 && step.is_finite() && start.is_finite() {
            Ok(Self::Even { start, step, count })
        } else {
            Err(GridError::Step { start, step })
        }
    }

    /// Determines positions from stamps, with issues. The grid is uniform if it explains all stamps
    /// within their printed digits, or within 2 % of a step; else it retains the stamps.
    ///
    /// # Errors
    /// Fewer than two stamps, one that is not a number, one earlier than its predecessor.
    pub fn from_stamps(stamps: Vec<f64>) -> Result<(Self, Vec<Issue>), GridError> {
        let Ok(result) = Stamped::of(&stamps.as_slice(), None, "s");
        Ok(match result? {
            Stamped::Even {
                start,
                step,
                issues,
            } => (
                Self::Even {
                    start,
                    step,
                    count: stamps.len(),
                },
                issues,
            ),
            Stamped::Uneven(issues) => (Self::Stamped(stamps), issues),
        })
    }

    /// Number of positions.
    pub fn len(&self) -> usize {
        match self {
            Self::Even { count, .. } => *count,
            Self::Stamped(stamps) => stamps.len(),
        }
    }

    /// True without positions.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Position of sample `k`.
    pub fn at(&self, k: usize) -> f64 {
        match self {
            Self::Even { start, step, .. } => start + k as f64 * step,
            Self::Stamped(stamps) => stamps.get(k).copied().unwrap_or(f64::NAN),
        }
    }

    /// All positions.
    pub fn places(&self) -> Vec<f64> {
        (0..self.len()).map(|k| self.at(k)).collect()
    }

    /// Samples per unit of the grid (Hz over time): exact for uniform grids, else the typical rate
    /// (over the mean step without long gaps).
    pub fn rate(&self) -> f64 {
        match self {
            Self::Even { step, .. } => 1.0 / step,
            Self::Stamped(stamps) => {
                let Ok(step) = typical_step(&stamps.as_slice());
                1.0 / step
            }
        }
    }
}
