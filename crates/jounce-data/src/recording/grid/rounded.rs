//! Uniform grids of rounded stamps.

use super::corridor::Corridor;
use super::digits::Digits;
use super::stamps::Stamped;
use super::steps::MAX_UNIFORM_DEVIATION;
use crate::recording::{Issue, IssueKind, Series};

/// Uniform grid that explains all stamps within their digits.
pub(super) struct EvenStamps {
    start: f64,
    step: f64,
    /// Half the range of admissible steps.
    uncertain: f64,
    /// Maximum rounding error of a stamp.
    rounding: f64,
}

/// Finds the uniform grid of rounded stamps, if there is one. The step is `stated_step` if
/// admissible, else the mean step, else the middle of the admissible range.
pub(super) fn uniform_grid<S: Series>(
    stamps: &S,
    digits: &Digits,
    mean: (f64, f64),
    stated_step: Option<f64>,
) -> Result<Option<EvenStamps>, S::Fault> {
    // Deviations from the grid of the mean step retain their digits.
    let (start, step) = mean;
    let (mut corridor, mut rounding, mut k) = (Corridor::default(), 0.0, 0.0);
    stamps.each(|t| {
        let (deviation, rounding_error) = (t - (start + k * step), digits.rounding(t));
        corridor.add(k, deviation - rounding_error, deviation + rounding_error);
        rounding = f64::max(rounding, rounding_error);
        k += 1.0;
    })?;
    let Some((low, high)) = corridor.slopes() else {
        return Ok(None);
    };
    let stated_slope = stated_step
        .map(|stated_step| stated_step - step)
        .filter(|slope| (low..=high).contains(slope));
    let slope = stated_slope
        .or((low..=high).contains(&0.0).then_some(0.0))
        .unwrap_or(0.5 * (low + high));
    let (mut lower, mut upper, mut k) = (f64::NEG_INFINITY, f64::INFINITY, 0.0);
    stamps.each(|t| {
        let (deviation, rounding_error) = (t - (start + k * step) - k * slope, digits.rounding(t));
        lower = f64::max(lower, deviation - rounding_error);
        upper = f64::min(upper, deviation + rounding_error);
        k += 1.0;
    })?;
    // Leave the first stamp unchanged if admissible.
    let shift = if (lower..=upper).contains(&0.0) {
        0.0
    } else {
        0.5 * (lower + upper)
    };
    Ok(Some(EvenStamps {
        start: start + shift,
        step: step + slope,
        uncertain: 0.5 * (high - low),
        rounding,
    }))
}

impl EvenStamps {
    /// Reports stamps rounded by more than a small share of a step.
    pub(super) fn into_stamped(self, count: usize, unit: &str) -> Stamped {
        let Self {
            start,
            step,
            uncertain,
            rounding,
        } = self;
        let percentage = 200.0 * rounding / step;
        let message = format!(
            "the stamps are rounded to {:.1e} {unit}, {percentage:.3} % of a step; a uniform grid \
            explains them all: a step of {step:.9e} {unit}, within {:.1e}",
            2.0 * rounding,
            uncertain / step
        );
        let is_coarse = rounding > MAX_UNIFORM_DEVIATION * step;
        let issues = is_coarse
            .then(|| Issue::new(IssueKind::RoundedStamps, count, None, message))
            .into_iter()
            .collect();
        Stamped::Even {
            start,
            step,
            issues,
        }
    }
}
