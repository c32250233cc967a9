//! Reports what keeps stamps from being uniform.

use super::digits::Digits;
use super::gaps::{StampsWithGaps, mean_step};
use super::steps::{MAX_UNIFORM_DEVIATION, median_step, steps};
use crate::recording::{Issue, IssueKind, IssuePlace, Series};

/// A step longer than this many typical steps is a gap.
const GAP_STEP_RATIO: f64 = 1.9;

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

/// Reports missing samples, or else uneven steps, gaps and repeated stamps.
pub(super) fn irregularities<S: Series>(
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
