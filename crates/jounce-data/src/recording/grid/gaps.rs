//! Uniform grids with missing samples.

use super::digits::Digits;
use super::steps::{MAX_UNIFORM_DEVIATION, mean_below, median_step, steps, steps_between};
use crate::recording::{PIECE, Series};

/// A step shorter than this many typical steps is one step.
const MAX_SINGLE_STEP_RATIO: f64 = 1.5;

/// A step longer than this many typical steps is not a late sample.
const LONG_GAP_STEP_RATIO: f64 = 5.0;

/// Share of long steps above which the stamps have too few digits for the rate, rather than samples
/// being lost.
pub(super) const MAX_GAP_SHARE: f64 = 0.05;

/// Uniform grid that contains all stamps, with some empty positions.
pub(crate) struct StampsWithGaps {
    /// Spacing of the grid.
    pub step: f64,
    /// Number of positions without a stamp.
    pub missing: usize,
}

impl StampsWithGaps {
    /// Finds a uniform grid in which each stamp has its own position within its digits or 2 % of a
    /// step, and few positions are empty. `None` if there is no such grid.
    pub(crate) fn of<S: Series>(stamps: &S) -> Result<Option<Self>, S::Fault> {
        Self::with_median(stamps, median_step(stamps)?, &Digits::of(stamps)?)
    }

    pub(super) fn with_median<S: Series>(
        stamps: &S,
        median: f64,
        digits: &Digits,
    ) -> Result<Option<Self>, S::Fault> {
        let near = mean_below(stamps, MAX_SINGLE_STEP_RATIO * median)?;
        let (mut total, mut step_total, mut long, mut is_increasing) = (0.0, 0.0, 0.0, true);
        steps(stamps, |_, step| {
            let step_count = steps_between(step, near);
            total += step;
            step_total += step_count;
            long += f64::from(step_count > 1.0);
            is_increasing &= step_count >= 1.0;
        })?;
        let step = total / step_total;
        let (mut at, mut index, mut is_on_grid) = (0.0, 0.0, true);
        let last = stamps
            .piece(stamps.count().saturating_sub(1) / PIECE)?
            .last()
            .copied()
            .unwrap_or(0.0);
        // The first and the last stamp are rounded too.
        let rounding = 2.0 * digits.rounding(last);
        steps(stamps, |_, increment| {
            at += increment;
            index += steps_between(increment, near);
            is_on_grid &=
                (at - index * step).abs() <= f64::max(MAX_UNIFORM_DEVIATION * step, rounding);
        })?;
        let count = stamps.count() as f64 - 1.0;
        let missing = step_total - count;
        Ok(
            (is_increasing && is_on_grid && long <= MAX_GAP_SHARE * count).then_some(Self {
                step,
                missing: missing as usize,
            }),
        )
    }
}

/// Step of the uniform grid that contains all stamps; without one, the mean step without long gaps.
/// A median would follow the digits of coarse stamps.
pub(crate) fn typical_step<S: Series>(stamps: &S) -> Result<f64, S::Fault> {
    let median = median_step(stamps)?;
    match StampsWithGaps::with_median(stamps, median, &Digits::of(stamps)?)? {
        Some(with_gaps) => Ok(with_gaps.step),
        None => mean_step(stamps, median),
    }
}

/// Mean step without long gaps.
pub(super) fn mean_step<S: Series>(stamps: &S, median: f64) -> Result<f64, S::Fault> {
    let mean = mean_below(stamps, LONG_GAP_STEP_RATIO * median)?;
    if mean.is_finite() {
        return Ok(mean);
    }
    let (mut first, mut last) = (None, f64::NAN);
    stamps.each(|t| {
        first = first.or(Some(t));
        last = t;
    })?;
    Ok((last - first.unwrap_or(f64::NAN)) / stamps.count().saturating_sub(1) as f64)
}
