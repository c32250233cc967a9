//! Inspects the samples of a channel for data-quality issues.

pub(super) mod complex_sizes;
mod flat_tops;
mod statistics;

use self::flat_tops::{FlatTops, MIN_FLAT_SAMPLES, RangeEnd};
use self::statistics::ChannelStatistics;
use crate::recording::{Channel, Issue, Quantity, Series};

/// RMS, peak and mean of a channel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sizes {
    /// RMS of the samples that are numbers.
    pub rms: f64,
    /// Maximum absolute value.
    pub peak: f64,
    /// Mean.
    pub mean: f64,
}

impl Sizes {
    /// Computes the sizes of samples.
    pub fn of(samples: &[f64]) -> Self {
        let Ok((_, sizes)) = inspect_samples(&samples, false);
        sizes
    }
}

/// Returns all data-quality issues of the samples of a channel.
///
/// A flat top differs from a slow maximum of a coarsely quantised signal by a jump at its beginning
/// of more than two of the smallest steps of the channel. A square wave has flat tops without
/// clipping.
pub fn inspect(channel: &Channel) -> Vec<Issue> {
    let counts = may_be_counts(channel.quantity, channel.imaginary.is_some());
    let Ok((found, _)) = inspect_samples(&channel.values.as_slice(), counts);
    found
        .into_iter()
        .map(|issue| issue.of(&channel.name))
        .collect()
}

/// True where the samples of a channel may be counts of a converter.
pub(crate) fn may_be_counts(quantity: Quantity, complex: bool) -> bool {
    quantity == Quantity::Unknown && !complex
}

/// Returns issues and sizes of samples, without channel name. Needs one pass, and a second one
/// where a long run of equal samples may be a flat top.
pub(crate) fn inspect_samples<S: Series>(
    samples: &S,
    may_be_counts: bool,
) -> Result<(Vec<Issue>, Sizes), S::Fault> {
    let mut statistics = ChannelStatistics::default();
    samples.each(|x| statistics.add(x))?;
    let ends = [statistics.low, statistics.high]
        .map(|value| RangeEnd::at(value, statistics.is_full_scale(value)));
    let mut flat_tops = FlatTops::new(ends, statistics.quantum);
    if statistics.low < statistics.high
        && (statistics.longest_run >= MIN_FLAT_SAMPLES || ends.iter().any(RangeEnd::is_full_scale))
    {
        samples.each(|x| flat_tops.add(x))?;
        flat_tops.close(None);
    }
    let found = [
        statistics.not_a_number(),
        statistics.constant(),
        statistics.outlier(),
        statistics.padding(),
        flat_tops.issue(),
        statistics.counts().filter(|_| may_be_counts),
    ];
    let numbers = f64::max((statistics.number - statistics.missing) as f64, 1.0);
    Ok((
        found.into_iter().flatten().collect(),
        Sizes {
            rms: f64::sqrt(statistics.square_sum / numbers),
            peak: statistics.peak,
            mean: statistics.sum / numbers,
        },
    ))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::recording::{IssueKind, IssuePlace};
    use std::f64::consts::TAU;

    fn found(values: Vec<f64>) -> Vec<(IssueKind, usize, Option<IssuePlace>)> {
        let quantity = Quantity::Acceleration;
        inspect(&Channel::new("a", quantity, "m/s^2", values))
            .into_iter()
            .map(|f| (f.kind, f.count, f.first))
            .collect()
    }

    fn sine(peak: f64, count: usize) -> Vec<f64> {
        (0..count)
            .map(|k| peak * (TAU * k as f64 / 100.0 + 0.1).sin())
            .collect()
    }

    #[test]
    fn a_square_wave_and_a_step_are_not_clipped() {
        let square_wave = |k: u32| {
            if (k / 25).is_multiple_of(2) {
                5.0
            } else {
                -5.0
            }
        };
        assert_eq!(found((0..1000).map(square_wave).collect()), []);
        assert_eq!(
            found(
                (0..1000)
                    .map(|k| if k % 25 == 0 { 0.4 } else { square_wave(k) })
                    .collect()
            ),
            []
        );
        assert_eq!(
            found((0..1000).map(|k| if k < 400 { 1.5 } else { 3.3 }).collect()),
            []
        );
        assert_eq!(
            found(
                (0..1000)
                    .map(|k| if k == 400 { 3.0 } else { 3.3 })
                    .collect()
            ),
            []
        );
        let Sizes { rms, peak, mean } = Sizes::of(&[3.0, -1.0, f64::NAN]);
        assert_eq!((rms, peak, mean), (5f64.sqrt(), 3.0, 1.0));
    }

    #[test]
    fn a_sample_that_dominates_all_others_is_found() {
        let with = |value: f64| {
            let mut values = sine(1.0, 1000);
            values[700] = value;
            found(values)
        };
        let expected = (IssueKind::Outlier, 1, Some(IssuePlace::Sample(700)));
        assert_eq!(with(1e30), [expected]);
        assert_eq!(with(100.3), []);
    }

    #[test]
    fn clean_sine_has_no_issues_even_if_coarse() {
        assert_eq!(found(sine(1.0, 1000)), []);
        assert_eq!(
            found(sine(20.0, 1000).into_iter().map(f64::round).collect()),
            []
        );
    }

    #[test]
    fn clipping_is_found_at_its_first_sample_with_its_count() {
        let clipped: Vec<f64> = sine(1.0, 1000).into_iter().map(|x| x.min(0.9)).collect();
        let flat = clipped.iter().filter(|x| **x == 0.9).count();
        let first = clipped.iter().position(|x| *x == 0.9).unwrap();
        assert_eq!(
            found(clipped),
            [(IssueKind::Clipping, flat, Some(IssuePlace::Sample(first)))]
        );
        // Two single samples at the end of a range of 8, where the strokes are steep, are clipped.
        // At 7.9, or smooth as a sine's peaks of 8, they are not.
        let full_scale_issue = |end: f64| {
            let mut values = sine(1.0, 1000);
            (values[200], values[700]) = (-end, -end);
            values
        };
        assert_eq!(
            found(full_scale_issue(8.0)),
            [(IssueKind::Clipping, 2, Some(IssuePlace::Sample(200)))]
        );
        assert_eq!(found(full_scale_issue(7.9)), []);
        assert_eq!(
            found(
                (0..1000)
                    .map(|k| [0.0, 5.0, 7.6, 8.0, 7.6, 5.0][k % 6])
                    .collect()
            ),
            []
        );
    }

    /// Converter codes, at one sample in five, in counts and in volts; all of them are counted.
    #[test]
    fn every_converter_code_at_its_limit_is_clipped() {
        for (bits, scale) in [
            (8, 1.0),
            (12, 1.0),
            (16, 1.0),
            (24, 1.0),
            (12, 10.0 / 4096.0),
            (16, 1e-4),
        ] {
            let half_range = f64::from(bits - 1).exp2();
            let over = |k: u32| {
                (1.3 * half_range * (TAU * 0.2013 * f64::from(k)).sin())
                    .round()
                    .clamp(-half_range, half_range - 1.0)
                    * scale
            };
            let values: Vec<f64> = (0..997).map(over).collect();
            let ends = values
                .iter()
                .filter(|x| **x == -half_range * scale || **x == (half_range - 1.0) * scale)
                .count();
            let clipped = found(values);
            assert!(
                ends > 100
                    && clipped.len() == 1
                    && clipped[0].0 == IssueKind::Clipping
                    && clipped[0].1 == ends,
                "{bits} bits: {clipped:?}"
            );
        }
    }

    #[test]
    fn padding_missing_samples_constants_and_counts_are_found() {
        let padded = [vec![0.0; 40], sine(1.0, 300), vec![0.0; 3]].concat();
        assert_eq!(
            found(padded),
            [(IssueKind::ZeroPadding, 40, Some(IssuePlace::Sample(0)))]
        );
        let mut with_missing = sine(1.0, 300);
        (with_missing[7], with_missing[9]) = (f64::NAN, f64::INFINITY);
        assert_eq!(
            found(with_missing),
            [(IssueKind::NotANumber, 2, Some(IssuePlace::Sample(7)))]
        );
        assert_eq!(found(vec![3.0; 50]), [(IssueKind::Constant, 50, None)]);
        let counts = Channel::new(
            "a",
            Quantity::Unknown,
            "",
            sine(16_000.0, 300).into_iter().map(f64::round).collect(),
        );
        assert!(
            inspect(&counts)
                .iter()
                .any(|issue| issue.kind == IssueKind::RawCounts)
        );
    }
}
