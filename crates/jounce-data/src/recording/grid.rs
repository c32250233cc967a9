//! Where samples lie in time or frequency.

use super::Issue;
use super::stamps::{self, Stamped};

/// What the samples are taken over.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Over {
    /// Time, s.
    Time,
    /// Frequency, Hz.
    Frequency,
}

/// Places of samples, s or Hz.
#[derive(Debug, Clone, PartialEq)]
pub enum Grid {
    /// Even: `start + k step`.
    Even {
        /// The first place.
        start: f64,
        /// Their distance, > 0.
        step: f64,
        /// Their number.
        count: usize,
    },
    /// One place for each sample, ascending.
    Stamped(Vec<f64>),
}

/// Stamps that are no places of samples.
#[derive(Debug, Clone, PartialEq, thiserror::Error, serde::Serialize)]
#[serde(untagged)]
pub enum GridError {
    /// A step or a start that is not a number, or a step at or below zero.
    #[error("the step is {step} from {start}; a step must be a finite number > 0")]
    Step {
        /// The start.
        start: f64,
        /// The step.
        step: f64,
    },
    /// Fewer than two stamps.
    #[error("there are {count} stamps; at least two are needed to tell a rate")]
    Few {
        /// How many there are.
        count: usize,
    },
    /// A stamp that is not a number.
    #[error("the stamp of sample {sample} is {value}; every stamp must be a number")]
    NotANumber {
        /// The sample, from 0.
        sample: usize,
        /// Its stamp.
        value: f64,
    },
    /// A stamp before the one of an earlier sample.
    #[error(
        "the stamp of sample {sample} is {value}, before {before} of the sample before it; sort the recording or cut it there"
    )]
    Backwards {
        /// The sample, from 0.
        sample: usize,
        /// Its stamp.
        value: f64,
        /// The stamp before.
        before: f64,
    },
}

impl Grid {
    /// Even places.
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

    /// Places from stamps: even where they explain all stamps within the digits that these were printed with, or within 2 % of a step, and as they
    /// stand elsewhere; with what was noticed.
    ///
    /// # Errors
    /// Fewer than two stamps, one that is not a number, one that goes back.
    pub fn from_stamps(stamps: Vec<f64>) -> Result<(Self, Vec<Issue>), GridError> {
        let Ok(found) = Stamped::of(&stamps.as_slice(), None, "s");
        Ok(match found? {
            Stamped::Even {
                start,
                step,
                noticed,
            } => (
                Self::Even {
                    start,
                    step,
                    count: stamps.len(),
                },
                noticed,
            ),
            Stamped::Uneven(findings) => (Self::Stamped(stamps), findings),
        })
    }

    /// Number of places.
    pub fn len(&self) -> usize {
        match self {
            Self::Even { count, .. } => *count,
            Self::Stamped(stamps) => stamps.len(),
        }
    }

    /// True without any place.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The place of sample `k`.
    pub fn at(&self, k: usize) -> f64 {
        match self {
            Self::Even { start, step, .. } => start + k as f64 * step,
            Self::Stamped(stamps) => stamps.get(k).copied().unwrap_or(f64::NAN),
        }
    }

    /// All places.
    pub fn places(&self) -> Vec<f64> {
        (0..self.len()).map(|k| self.at(k)).collect()
    }

    /// Samples per unit of the grid (Hz over time): exact where even, the usual one (over the mean step, long gaps left out) elsewhere.
    pub fn rate(&self) -> f64 {
        match self {
            Self::Even { step, .. } => 1.0 / step,
            Self::Stamped(stamps) => {
                let Ok(step) = stamps::usual_step(&stamps.as_slice());
                1.0 / step
            }
        }
    }
}
