//! Detects uniform, rounded and missing stamps in a few passes.

use super::corridor::Corridor;
use super::digits::Digits;
use crate::recording::{GridError, Issue, IssueKind, IssuePlace, PIECE, Series};

/// Maximum deviation from the uniform grid, in steps, of stamps that are only rounded.
const MAX_UNIFORM_DEVIATION: f64 = 0.02;
/// A step longer than this many typical steps is a gap.
const GAP_STEP_RATIO: f64 = 1.9;
/// A step longer than this many typical steps is not a late sample.
const LONG_GAP_STEP_RATIO: f64 = 5.0;
/// A step shorter than this many typical steps is one step.
const MAX_SINGLE_STEP_RATIO: f64 = 1.5;
/// Share of long steps above which the stamps have too few digits for the rate, rather than samples
/// being lost.
const MAX_GAP_SHARE: f64 = 0.05;

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

/// Uniform grid that explains all stamps within their digits.
struct EvenStamps {
    start: f64,
    step: f64,
    /// Half the range of admissible steps.
    uncertain: f64,
    /// Maximum rounding error of a stamp.
    rounding: f64,
}

/// Finds the uniform grid of rounded stamps, if there is one. The step is `stated_step` if
/// admissible, else the mean step, else the middle of the admissible range.
fn uniform_grid<S: Series>(
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
    fn into_stamped(self, count: usize, unit: &str) -> Stamped {
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

/// Passes each step to `callback` with the index of the sample at its end.
fn steps<S: Series>(stamps: &S, mut callback: impl FnMut(usize, f64)) -> Result<(), S::Fault> {
    let (mut number, mut previous) = (0, 0.0);
    stamps.each(|t| {
        if number > 0 {
            callback(number, t - previous);
        }
        previous = t;
        number += 1;
    })
}

/// Median of all steps (at least one, none negative): gaps do not affect it. Nonnegative doubles
/// are ordered like their bits, so four counts of sixteen bits each find it without a copy.
fn median_step<S: Series>(stamps: &S) -> Result<f64, S::Fault> {
    let (mut rank, mut high) = (stamps.count().saturating_sub(1) / 2, 0);
    for shift in [48u32, 32, 16, 0] {
        let mut counts = vec![0usize; 1 << 16];
        steps(stamps, |_, step| {
            let bits = step.to_bits();
            if bits.checked_shr(shift + 16).unwrap_or(0) == high {
                counts[usize::from((bits >> shift) as u16)] += 1;
            }
        })?;
        let bin = counts.iter().position(|count| {
            let is_in_bin = rank < *count;
            rank -= if is_in_bin { 0 } else { *count };
            is_in_bin
        });
        high = high << 16 | bin.unwrap_or(0) as u64;
    }
    Ok(f64::from_bits(high))
}

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

    fn with_median<S: Series>(
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

/// Number of grid positions that a step spans.
fn steps_between(step: f64, near: f64) -> f64 {
    (step / near).round()
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

/// Mean of the steps below a length; NaN if there are none.
fn mean_below<S: Series>(stamps: &S, upper: f64) -> Result<f64, S::Fault> {
    let (mut sum, mut count) = (0.0, 0.0);
    steps(stamps, |_, step| {
        if step < upper {
            sum += step;
            count += 1.0;
        }
    })?;
    Ok(sum / count)
}

fn mean_step<S: Series>(stamps: &S, median: f64) -> Result<f64, S::Fault> {
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

/// Count and first sample.
#[derive(Default)]
struct StampTally(usize, Option<usize>);

impl StampTally {
    fn add(&mut self, is_affected: bool, sample: usize) {
        if is_affected {
            self.0 += 1;
            self.1 = self.1.or(Some(sample));
        }
    }

    fn issue(&self, kind: IssueKind, message: String) -> Issue {
        Issue::new(kind, self.0, self.1.map(IssuePlace::Sample), message)
    }
}

fn irregularities<S: Series>(
    stamps: &S,
    digits: &Digits,
    unit: &str,
) -> Result<Vec<Issue>, S::Fault> {
    let median = median_step(stamps)?;
    let (with_gaps, mean) = (
        StampsWithGaps::with_median(stamps, median, digits)?,
        mean_step(stamps, median)?,
    );
    let (mut uneven, mut gaps, mut repeated) = (
        StampTally::default(),
        StampTally::default(),
        StampTally::default(),
    );
    let (mut square_sum, mut regular_count, mut longest_step) = (0.0, 0usize, 0.0);
    steps(stamps, |sample, step| {
        if step < GAP_STEP_RATIO * median {
            square_sum += (step - mean).powi(2);
            regular_count += 1;
        }
        longest_step = f64::max(longest_step, step);
        uneven.add((step / median - 1.0).abs() > MAX_UNIFORM_DEVIATION, sample);
        gaps.add(step >= GAP_STEP_RATIO * median, sample);
        repeated.add(step == 0.0, sample);
    })?;
    if let Some(StampsWithGaps { step, missing }) = with_gaps {
        let message = format!(
            "samples are missing, {missing} in all: a step of up to {longest_step:.6e} {unit} where \
            {step:.6e} {unit} is usual; all others are uniform"
        );
        return Ok(vec![gaps.issue(IssueKind::Gap, message)]);
    }
    let deviation = (square_sum / regular_count.max(1) as f64).sqrt();
    let jitter = format!(
        "steps between stamps vary by {deviation:.2e} {unit}, {:.2} % of the mean step (standard deviation): median {median:.6e} {unit}, mean {mean:.6e} {unit}",
        100.0 * deviation / mean
    );
    let missing = format!(
        "samples are missing: a step of up to {longest_step:.6e} {unit} where {median:.6e} {unit} is usual"
    );
    let repeated_stamp = "the stamp equals the stamp of the previous sample".to_owned();
    let result = [
        (uneven, IssueKind::Jitter, jitter),
        (gaps, IssueKind::Gap, missing),
        (repeated, IssueKind::RepeatedStamp, repeated_stamp),
    ];
    let to_issue = |(tally, kind, message): (StampTally, IssueKind, String)| {
        (tally.0 > 0 || kind == IssueKind::Jitter).then(|| tally.issue(kind, message))
    };
    Ok(result.into_iter().filter_map(to_issue).collect())
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    /// Compares with sorting all steps.
    #[test]
    fn the_median_by_counts_is_that_of_sorted_steps() {
        let mut stamps = vec![0.0];
        for k in 0..9001u32 {
            let step = f64::from(k.wrapping_mul(2_654_435_761) % 1000)
                * 1e-3
                * 10f64.powi((k % 7) as i32 - 3);
            stamps.push(stamps[k as usize] + step);
        }
        let mut sorted: Vec<f64> = stamps.windows(2).map(|pair| pair[1] - pair[0]).collect();
        sorted.sort_by(f64::total_cmp);
        let Ok(median) = median_step(&stamps.as_slice());
        assert_eq!(median, sorted[sorted.len() / 2]);
    }
}
