//! Where samples lie in time or frequency.

use super::{Finding, FindingKind, Place};

/// What the samples are taken over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
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
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
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
    #[error("the stamp of sample {sample} is {value}, before {before} of the sample before it; sort the recording or cut it there")]
    Backwards {
        /// The sample, from 0.
        sample: usize,
        /// Its stamp.
        value: f64,
        /// The stamp before.
        before: f64,
    },
}

/// Stamps closer to even places than this share of a step are even: their digits end there.
const ROUNDED: f64 = 0.02;
/// A step longer than this many usual steps is a gap.
const GAP: f64 = 1.9;
/// A step longer than this many usual steps is no late sample.
const LONG_GAP: f64 = 5.0;

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

    /// Places from stamps: even where the stamps are, within 2 % of a step, and as they stand elsewhere; with what was noticed.
    ///
    /// # Errors
    /// Fewer than two stamps, one that is not a number, one that goes back.
    pub fn from_stamps(stamps: Vec<f64>) -> Result<(Self, Vec<Finding>), GridError> {
        check(&stamps)?;
        let (count, span) = (stamps.len(), stamps[stamps.len() - 1] - stamps[0]);
        if span <= 0.0 {
            return Err(GridError::Step { start: stamps[0], step: 0.0 });
        }
        let step = span / (count - 1) as f64;
        let off = stamps.iter().enumerate().map(|(k, t)| ((t - stamps[0]) / step - k as f64).abs()).fold(0.0, f64::max);
        if off <= ROUNDED {
            return Ok((Self::Even { start: stamps[0], step, count }, Vec::new()));
        }
        let findings = oddities(&stamps);
        Ok((Self::Stamped(stamps), findings))
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
            Self::Stamped(stamps) => 1.0 / usual_step(stamps),
        }
    }
}

fn check(stamps: &[f64]) -> Result<(), GridError> {
    if stamps.len() < 2 {
        return Err(GridError::Few { count: stamps.len() });
    }
    if let Some(sample) = stamps.iter().position(|t| !t.is_finite()) {
        return Err(GridError::NotANumber { sample, value: stamps[sample] });
    }
    match stamps.windows(2).position(|pair| pair[1] < pair[0]) {
        Some(before) => Err(GridError::Backwards { sample: before + 1, value: stamps[before + 1], before: stamps[before] }),
        None => Ok(()),
    }
}

/// The middle of all steps: a gap does not move it.
fn median_step(stamps: &[f64]) -> f64 {
    let mut steps: Vec<f64> = stamps.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let middle = steps.len() / 2;
    *steps.select_nth_unstable_by(middle, f64::total_cmp).1
}

/// The mean of all steps but those of long gaps: a median would follow the digits of coarse stamps.
fn usual_step(stamps: &[f64]) -> f64 {
    let most = LONG_GAP * median_step(stamps);
    let (sum, count) =
        stamps.windows(2).map(|pair| pair[1] - pair[0]).filter(|step| *step < most).fold((0.0, 0.0), |(s, n), x| (s + x, n + 1.0));
    if count > 0.0 { sum / count } else { (stamps[stamps.len() - 1] - stamps[0]) / (stamps.len() - 1) as f64 }
}

fn oddities(stamps: &[f64]) -> Vec<Finding> {
    let usual = median_step(stamps);
    let steps = || stamps.windows(2).map(|pair| pair[1] - pair[0]);
    let mut findings = Vec::new();
    let even: Vec<f64> = steps().filter(|step| *step < GAP * usual).collect();
    let mean = usual_step(stamps);
    let deviation = (even.iter().map(|step| (step - mean).powi(2)).sum::<f64>() / even.len().max(1) as f64).sqrt();
    let uneven = |step: &f64| (step / usual - 1.0).abs() > ROUNDED;
    let count = steps().filter(|step| uneven(step)).count();
    let first = steps().position(|step| uneven(&step)).map(|k| Place::Sample(k + 1));
    findings.push(Finding::new(
        FindingKind::Jitter,
        count,
        first,
        format!("steps between stamps vary: median {usual:.6e}, mean {mean:.6e}, standard deviation {deviation:.2e}"),
    ));
    let gaps: Vec<usize> = steps().enumerate().filter(|(_, step)| *step >= GAP * usual).map(|(k, _)| k + 1).collect();
    if let Some(first) = gaps.first() {
        let longest = steps().fold(0.0, f64::max);
        let about = format!("samples are missing: a step of up to {longest:.6e} where {usual:.6e} is usual");
        findings.push(Finding::new(FindingKind::Gap, gaps.len(), Some(Place::Sample(*first)), about));
    }
    let repeated: Vec<usize> = steps().enumerate().filter(|(_, step)| *step == 0.0).map(|(k, _)| k + 1).collect();
    if let Some(first) = repeated.first() {
        let about = "the stamp is that of the sample before".to_owned();
        findings.push(Finding::new(FindingKind::RepeatedStamp, repeated.len(), Some(Place::Sample(*first)), about));
    }
    findings
}
