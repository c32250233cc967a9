//! Detects uniform, rounded and missing stamps in a few passes.

use super::digits::Digits;
use super::gaps::MAX_GAP_SHARE;
use super::irregular::irregularities;
use super::rounded::uniform_grid;
use super::steps::{MAX_UNIFORM_DEVIATION, median_step, steps, steps_between};
use crate::recording::{GridError, Issue, Series};

/// Maximum number of long steps between equal ones that are read as lost samples, though rounded
/// stamps would show them too.
const MAX_LOST_SAMPLE_GAPS: usize = 2;

/// Maximum deviation from the uniform grid, in steps, that is roundoff.
const GRID_ROUNDOFF: f64 = 1e-6;

/// Result for stamps.
pub(crate) enum Stamped {
    /// Uniform grid, with issues: all stamps agree within their printed digits, or within 2 % of a
    /// step.
    Even {
        start: f64,
        step: f64,
        issues: Vec<Issue>,
    },
    /// Uneven stamps, with issues.
    Uneven(Vec<Issue>),
}

impl Stamped {
    /// Analyses stamps, in s or Hz by `unit`. Among steps that explain all stamps, `stated_step`
    /// from a header is preferred. The inner error concerns the stamps, the outer one their storage.
    pub(crate) fn of<S: Series>(
        stamps: &S,
        stated_step: Option<f64>,
        unit: &str,
    ) -> Result<Result<Self, GridError>, S::Fault> {
        let (start, end) = match checked(stamps)? {
            Ok(ends) => ends,
            Err(error) => return Ok(Err(error)),
        };
        if end - start <= 0.0 {
            return Ok(Err(GridError::Step { start, step: 0.0 }));
        }
        let step = (end - start) / (stamps.count() - 1) as f64;
        let max_deviation = max_deviation_from_grid(stamps, start, step)?;
        if max_deviation <= GRID_ROUNDOFF && stated_step.is_none() {
            return Ok(Ok(Self::Even {
                start,
                step,
                issues: Vec::new(),
            }));
        }
        let digits = Digits::of(stamps)?;
        if has_lost_samples(stamps)? {
            return Ok(Ok(Self::Uneven(irregularities(stamps, &digits, unit)?)));
        }
        if let Some(grid) = uniform_grid(stamps, &digits, (start, step), stated_step)? {
            return Ok(Ok(grid.into_stamped(stamps.count(), unit)));
        }
        Ok(Ok(if max_deviation <= MAX_UNIFORM_DEVIATION {
            Self::Even {
                start,
                step,
                issues: Vec::new(),
            }
        } else {
            Self::Uneven(irregularities(stamps, &digits, unit)?)
        }))
    }
}

/// True where all steps are equal to the last digit except one or two, which are multiples. Rounded
/// stamps would also explain a few of these; three or more must be evenly spread for that.
fn has_lost_samples<S: Series>(stamps: &S) -> Result<bool, S::Fault> {
    let median = median_step(stamps)?;
    let (mut equal, mut long) = (true, 0);
    steps(stamps, |_, step| {
        let step_count = steps_between(step, median);
        equal &= step_count >= 1.0 && (step - step_count * median).abs() <= GRID_ROUNDOFF * median;
        long += usize::from(step_count > 1.0);
    })?;
    Ok(equal
        && (1..=MAX_LOST_SAMPLE_GAPS).contains(&long)
        && long as f64 <= MAX_GAP_SHARE * stamps.count() as f64)
}

/// Maximum deviation of a stamp from the uniform grid, in steps.
fn max_deviation_from_grid<S: Series>(stamps: &S, start: f64, step: f64) -> Result<f64, S::Fault> {
    let (mut max_deviation, mut k) = (0.0, 0.0);
    stamps.each(|t| {
        max_deviation = f64::max(max_deviation, ((t - start) / step - k).abs());
        k += 1.0;
    })?;
    Ok(max_deviation)
}

/// Returns the first and the last stamp, after a check that all are numbers and do not decrease.
fn checked<S: Series>(stamps: &S) -> Result<Result<(f64, f64), GridError>, S::Fault> {
    let count = stamps.count();
    if count < 2 {
        return Ok(Err(GridError::Few { count }));
    }
    let (mut number, mut first, mut previous) = (0, f64::NAN, f64::NAN);
    let (mut not_a_number, mut backwards) = (None, None);
    stamps.each(|value| {
        if number == 0 {
            first = value;
        }
        if !value.is_finite() {
            not_a_number = not_a_number.take().or(Some(GridError::NotANumber {
                sample: number,
                value,
            }));
        }
        if value < previous {
            backwards = backwards.take().or(Some(GridError::Backwards {
                sample: number,
                value,
                before: previous,
            }));
        }
        previous = value;
        number += 1;
    })?;
    Ok(not_a_number
        .or(backwards)
        .map_or(Ok((first, previous)), Err))
}
