//! Detects uniform, rounded and missing stamps in a few passes.

use super::corridor::Corridor;
use super::digits::Digits;
use super::{GridError, Issue, IssueKind, IssuePlace, PIECE, Series};

/// Maximum deviation from the uniform grid, in steps, of stamps that are only rounded.
const ROUNDED: f64 = 0.02;
/// A step longer than this many typical steps is a gap.
const GAP: f64 = 1.9;
/// A step longer than this many typical steps is not a late sample.
const LONG_GAP: f64 = 5.0;
/// A step shorter than this many typical steps is one step.
const ONE_STEP: f64 = 1.5;
/// Share of long steps above which the stamps have too few digits for the rate, rather than samples
/// being lost.
const RARE: f64 = 0.05;

/// Maximum number of long steps between equal ones that are read as lost samples, though rounded
/// stamps would show them too.
const FEW: usize = 2;

/// Maximum deviation from the uniform grid, in steps, that is roundoff.
const EXACT: f64 = 1e-6;

/// Result for stamps.
pub(crate) enum Stamped {
    /// Uniform grid, with issues: all stamps agree within their printed digits, or within 2 % of a
    /// step.
    Even {
        start: f64,
        step: f64,
        noticed: Vec<Issue>,
    },
    /// Uneven stamps, with issues.
    Uneven(Vec<Issue>),
}

impl Stamped {
    /// Analyses stamps, in s or Hz by `unit`. Among steps that explain all stamps, `told` from a
    /// header is preferred. The inner error concerns the stamps, the outer one their storage.
    pub(crate) fn of<S: Series>(
        stamps: &S,
        told: Option<f64>,
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
        let off = farthest_off(stamps, start, step)?;
        if off <= EXACT && told.is_none() {
            return Ok(Ok(Self::Even {
                start,
                step,
                noticed: Vec::new(),
            }));
        }
        let digits = Digits::of(stamps)?;
        if has_lost_samples(stamps)? {
            return Ok(Ok(Self::Uneven(oddities(stamps, &digits, unit)?)));
        }
        if let Some(places) = even_places(stamps, &digits, (start, step), told)? {
            return Ok(Ok(places.stamped(stamps.count(), unit)));
        }
        Ok(Ok(if off <= ROUNDED {
            Self::Even {
                start,
                step,
                noticed: Vec::new(),
            }
        } else {
            Self::Uneven(oddities(stamps, &digits, unit)?)
        }))
    }
}

/// True where all steps are equal to the last digit except one or two, which are multiples. Rounded
/// stamps would also explain a few of these; three or more must be evenly spread for that.
fn has_lost_samples<S: Series>(stamps: &S) -> Result<bool, S::Fault> {
    let usual = median_step(stamps)?;
    let (mut equal, mut long) = (true, 0);
    steps(stamps, |_, step| {
        let passed = places_passed(step, usual);
        equal &= passed >= 1.0 && (step - passed * usual).abs() <= EXACT * usual;
        long += usize::from(passed > 1.0);
    })?;
    Ok(equal && (1..=FEW).contains(&long) && long as f64 <= RARE * stamps.count() as f64)
}

/// Maximum deviation of a stamp from the uniform grid, in steps.
fn farthest_off<S: Series>(stamps: &S, start: f64, step: f64) -> Result<f64, S::Fault> {
    let (mut off, mut k) = (0.0, 0.0);
    stamps.each(|t| {
        off = f64::max(off, ((t - start) / step - k).abs());
        k += 1.0;
    })?;
    Ok(off)
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

/// Finds the uniform grid of rounded stamps, if there is one. The step is `told` if admissible,
/// else the mean step, else the middle of the admissible range.
fn even_places<S: Series>(
    stamps: &S,
    digits: &Digits,
    mean: (f64, f64),
    told: Option<f64>,
) -> Result<Option<EvenStamps>, S::Fault> {
    // Deviations from the grid of the mean step retain their digits.
    let (start, step) = mean;
    let (mut corridor, mut rounding, mut k) = (Corridor::default(), 0.0, 0.0);
    stamps.each(|t| {
        let (off, reach) = (t - (start + k * step), digits.rounding(t));
        corridor.take(k, off - reach, off + reach);
        rounding = f64::max(rounding, reach);
        k += 1.0;
    })?;
    let Some((low, high)) = corridor.slopes() else {
        return Ok(None);
    };
    let wanted = told
        .map(|told| told - step)
        .filter(|slope| (low..=high).contains(slope));
    let slope = wanted
        .or((low..=high).contains(&0.0).then_some(0.0))
        .unwrap_or(0.5 * (low + high));
    let (mut least, mut most, mut k) = (f64::NEG_INFINITY, f64::INFINITY, 0.0);
    stamps.each(|t| {
        let (off, reach) = (t - (start + k * step) - k * slope, digits.rounding(t));
        least = f64::max(least, off - reach);
        most = f64::min(most, off + reach);
        k += 1.0;
    })?;
    // Leave the first stamp unchanged if admissible.
    let shift = if (least..=most).contains(&0.0) {
        0.0
    } else {
        0.5 * (least + most)
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
    fn stamped(self, count: usize, unit: &str) -> Stamped {
        let Self {
            start,
            step,
            uncertain,
            rounding,
        } = self;
        let share = 200.0 * rounding / step;
        let about = format!(
            "the stamps are rounded to {:.1e} {unit}, {share:.3} % of a step; a uniform grid \
            explains them all: a step of {step:.9e} {unit}, within {:.1e}",
            2.0 * rounding,
            uncertain / step
        );
        let coarse = rounding > ROUNDED * step;
        let noticed = coarse
            .then(|| Issue::new(IssueKind::RoundedStamps, count, None, about))
            .into_iter()
            .collect();
        Stamped::Even {
            start,
            step,
            noticed,
        }
    }
}

/// Returns the first and the last stamp, after a check that all are numbers and do not decrease.
fn checked<S: Series>(stamps: &S) -> Result<Result<(f64, f64), GridError>, S::Fault> {
    let count = stamps.count();
    if count < 2 {
        return Ok(Err(GridError::Few { count }));
    }
    let (mut number, mut first, mut before) = (0, f64::NAN, f64::NAN);
    let (mut none, mut back) = (None, None);
    stamps.each(|value| {
        if number == 0 {
            first = value;
        }
        if !value.is_finite() {
            none = none.take().or(Some(GridError::NotANumber {
                sample: number,
                value,
            }));
        }
        if value < before {
            back = back.take().or(Some(GridError::Backwards {
                sample: number,
                value,
                before,
            }));
        }
        before = value;
        number += 1;
    })?;
    Ok(none.or(back).map_or(Ok((first, before)), Err))
}

/// Passes each step to `take` with the index of the sample at its end.
fn steps<S: Series>(stamps: &S, mut take: impl FnMut(usize, f64)) -> Result<(), S::Fault> {
    let (mut number, mut before) = (0, 0.0);
    stamps.each(|t| {
        if number > 0 {
            take(number, t - before);
        }
        before = t;
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
            let inside = rank < *count;
            rank -= if inside { 0 } else { *count };
            inside
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
        Self::about(stamps, median_step(stamps)?, &Digits::of(stamps)?)
    }

    fn about<S: Series>(
        stamps: &S,
        median: f64,
        digits: &Digits,
    ) -> Result<Option<Self>, S::Fault> {
        let near = mean_below(stamps, ONE_STEP * median)?;
        let (mut total, mut places, mut long, mut apart) = (0.0, 0.0, 0.0, true);
        steps(stamps, |_, step| {
            let passed = places_passed(step, near);
            total += step;
            places += passed;
            long += f64::from(passed > 1.0);
            apart &= passed >= 1.0;
        })?;
        let step = total / places;
        let (mut at, mut place, mut inside) = (0.0, 0.0, true);
        let last = stamps
            .piece(stamps.count().saturating_sub(1) / PIECE)?
            .last()
            .copied()
            .unwrap_or(0.0);
        // The first and the last stamp are rounded too.
        let rounding = 2.0 * digits.rounding(last);
        steps(stamps, |_, passed| {
            at += passed;
            place += places_passed(passed, near);
            inside &= (at - place * step).abs() <= f64::max(ROUNDED * step, rounding);
        })?;
        let count = stamps.count() as f64 - 1.0;
        let missing = places - count;
        Ok((apart && inside && long <= RARE * count).then_some(Self {
            step,
            missing: missing as usize,
        }))
    }
}

/// Number of grid positions that a step spans.
fn places_passed(step: f64, near: f64) -> f64 {
    (step / near).round()
}

/// Step of the uniform grid that contains all stamps; without one, the mean step without long gaps.
/// A median would follow the digits of coarse stamps.
pub(crate) fn usual_step<S: Series>(stamps: &S) -> Result<f64, S::Fault> {
    let median = median_step(stamps)?;
    match StampsWithGaps::about(stamps, median, &Digits::of(stamps)?)? {
        Some(holed) => Ok(holed.step),
        None => mean_step(stamps, median),
    }
}

/// Mean of the steps below a length; NaN if there are none.
fn mean_below<S: Series>(stamps: &S, most: f64) -> Result<f64, S::Fault> {
    let (mut sum, mut count) = (0.0, 0.0);
    steps(stamps, |_, step| {
        if step < most {
            sum += step;
            count += 1.0;
        }
    })?;
    Ok(sum / count)
}

fn mean_step<S: Series>(stamps: &S, median: f64) -> Result<f64, S::Fault> {
    let usual = mean_below(stamps, LONG_GAP * median)?;
    if usual.is_finite() {
        return Ok(usual);
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
    fn add(&mut self, is: bool, sample: usize) {
        if is {
            self.0 += 1;
            self.1 = self.1.or(Some(sample));
        }
    }

    fn finding(&self, kind: IssueKind, about: String) -> Issue {
        Issue::new(kind, self.0, self.1.map(IssuePlace::Sample), about)
    }
}

fn oddities<S: Series>(stamps: &S, digits: &Digits, unit: &str) -> Result<Vec<Issue>, S::Fault> {
    let usual = median_step(stamps)?;
    let (holed, mean) = (
        StampsWithGaps::about(stamps, usual, digits)?,
        mean_step(stamps, usual)?,
    );
    let (mut uneven, mut gaps, mut repeated) = (
        StampTally::default(),
        StampTally::default(),
        StampTally::default(),
    );
    let (mut squares, mut even, mut longest) = (0.0, 0usize, 0.0);
    steps(stamps, |sample, step| {
        if step < GAP * usual {
            squares += (step - mean).powi(2);
            even += 1;
        }
        longest = f64::max(longest, step);
        uneven.add((step / usual - 1.0).abs() > ROUNDED, sample);
        gaps.add(step >= GAP * usual, sample);
        repeated.add(step == 0.0, sample);
    })?;
    if let Some(StampsWithGaps { step, missing }) = holed {
        let about = format!(
            "samples are missing, {missing} in all: a step of up to {longest:.6e} {unit} where \
            {step:.6e} {unit} is usual; all others are uniform"
        );
        return Ok(vec![gaps.finding(IssueKind::Gap, about)]);
    }
    let deviation = (squares / even.max(1) as f64).sqrt();
    let jitter = format!(
        "steps between stamps vary by {deviation:.2e} {unit}, {:.2} % of the mean step (standard deviation): median {usual:.6e} {unit}, mean {mean:.6e} {unit}",
        100.0 * deviation / mean
    );
    let missing = format!(
        "samples are missing: a step of up to {longest:.6e} {unit} where {usual:.6e} {unit} is usual"
    );
    let again = "the stamp equals the stamp of the previous sample".to_owned();
    let found = [
        (uneven, IssueKind::Jitter, jitter),
        (gaps, IssueKind::Gap, missing),
        (repeated, IssueKind::RepeatedStamp, again),
    ];
    let told = |(tally, kind, about): (StampTally, IssueKind, String)| {
        (tally.0 > 0 || kind == IssueKind::Jitter).then(|| tally.finding(kind, about))
    };
    Ok(found.into_iter().filter_map(told).collect())
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
