//! Inspects the samples of a channel for data-quality issues.

pub(super) mod complex_sizes;
mod flat_tops;

use self::flat_tops::{FlatTops, MIN_FLAT_SAMPLES, RangeEnd};
use crate::recording::{Channel, Issue, IssueKind, IssuePlace, Quantity, Series};

/// Minimum number of leading or trailing zeros that are padding.
const MIN_PADDING_SAMPLES: usize = 10;
/// Resolutions of converters, bits.
const CONVERTER_BITS: [i32; 4] = [8, 12, 16, 24];
/// Tolerance on a multiple of the smallest step, in such steps.
const CODE_TOLERANCE: f64 = 1e-6;
/// Roundoff of a conversion to SI, and 1 g, m/s^2.
const ROUND_NUMBER_TOLERANCE: f64 = 1e-12;
const STANDARD_GRAVITY_M_S2: f64 = 9.80665;
/// Size beyond which integers without unit are converter counts.
const MIN_COUNT_PEAK: f64 = 100.0;

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

/// Statistics from one pass over samples.
struct ChannelStatistics {
    /// Samples so far.
    number: usize,
    first: f64,
    previous: f64,
    /// Count of samples that are not numbers, and the first of them.
    missing: usize,
    first_missing: Option<usize>,
    /// True while all samples equal the first one.
    is_constant: bool,
    /// Zeros at the beginning and, so far, at the end.
    leading: usize,
    trailing: usize,
    /// Minimum and maximum, and the smallest nonzero step between samples.
    low: f64,
    high: f64,
    quantum: f64,
    /// Run of equal samples: current and longest.
    run: usize,
    longest_run: usize,
    is_integer: bool,
    sum: f64,
    square_sum: f64,
    peak: f64,
}

impl Default for ChannelStatistics {
    fn default() -> Self {
        Self {
            number: 0,
            first: f64::NAN,
            previous: f64::NAN,
            missing: 0,
            first_missing: None,
            is_constant: true,
            leading: 0,
            trailing: 0,
            low: f64::INFINITY,
            high: f64::NEG_INFINITY,
            quantum: f64::INFINITY,
            run: 0,
            longest_run: 0,
            is_integer: true,
            sum: 0.0,
            square_sum: 0.0,
            peak: 0.0,
        }
    }
}

impl ChannelStatistics {
    fn add(&mut self, x: f64) {
        if self.number == 0 {
            self.first = x;
        }
        self.is_constant &= x == self.first;
        if x == 0.0 {
            self.leading += usize::from(self.leading == self.number);
            self.trailing += 1;
        } else {
            self.trailing = 0;
        }
        self.run = if x == self.previous { self.run + 1 } else { 1 };
        self.longest_run = self.longest_run.max(self.run);
        let step = (x - self.previous).abs();
        if step > 0.0 {
            self.quantum = self.quantum.min(step);
        }
        self.previous = x;
        if x.is_finite() {
            self.low = self.low.min(x);
            self.high = self.high.max(x);
            self.is_integer &= x.fract() == 0.0;
            self.sum += x;
            self.square_sum += x * x;
            self.peak = self.peak.max(x.abs());
        } else {
            self.missing += 1;
            self.first_missing = self.first_missing.or(Some(self.number));
        }
        self.number += 1;
    }

    fn not_a_number(&self) -> Option<Issue> {
        let first = IssuePlace::Sample(self.first_missing?);
        Some(Issue::new(
            IssueKind::NotANumber,
            self.missing,
            Some(first),
            "samples are not numbers".to_owned(),
        ))
    }

    fn constant(&self) -> Option<Issue> {
        let message = format!("all samples are {}; there is no signal", self.first);
        (self.is_constant && self.number > 1)
            .then(|| Issue::new(IssueKind::Constant, self.number, None, message))
    }

    fn padding(&self) -> Option<Issue> {
        if self.leading == self.number || self.leading.max(self.trailing) < MIN_PADDING_SAMPLES {
            return None;
        }
        let long_padding = |zeros: usize| {
            if zeros < MIN_PADDING_SAMPLES {
                0
            } else {
                zeros
            }
        };
        let (leading, trailing) = (long_padding(self.leading), long_padding(self.trailing));
        let first = if leading > 0 {
            0
        } else {
            self.number - trailing
        };
        let message = format!("{leading} exact zeros precede the signal and {trailing} follow it");
        Some(Issue::new(
            IssueKind::ZeroPadding,
            leading + trailing,
            Some(IssuePlace::Sample(first)),
            message,
        ))
    }

    /// True for a limit of a converter: a power of 2 from 2 on, in SI or in g, or the last code of
    /// 8, 12, 16 or 24 bits, in counts or in the smallest steps of the channel.
    fn is_full_scale(&self, value: f64) -> bool {
        let is_round = |magnitude: f64| {
            magnitude > 1.5
                && (magnitude / magnitude.log2().round().exp2() - 1.0).abs()
                    < ROUND_NUMBER_TOLERANCE
        };
        // The limits of a range differ by one code; for a slow signal the smallest step between
        // samples is one code.
        let steps = if self.is_integer {
            [1.0; 2]
        } else {
            [self.quantum, (self.low + self.high).abs()]
        };
        let is_last = |step: &f64| {
            let code = (value / step).round();
            let last = |bits: &i32| {
                let half_range = f64::from(bits - 1).exp2();
                [
                    half_range - 1.0,
                    2.0 * half_range - 1.0,
                    -half_range,
                    1.0 - half_range,
                ]
                .contains(&code)
            };
            (value / step - code).abs() < CODE_TOLERANCE && CONVERTER_BITS.iter().any(last)
        };
        let by_size = value.abs() == self.peak
            && (is_round(self.peak) || is_round(self.peak / STANDARD_GRAVITY_M_S2));
        by_size || steps.iter().any(is_last)
    }

    fn counts(&self) -> Option<Issue> {
        let message = "integers without unit: if they are converter counts, give the scale in the \
            notes of the file";
        (self.is_integer && self.peak > MIN_COUNT_PEAK)
            .then(|| Issue::new(IssueKind::RawCounts, self.number, None, message.to_owned()))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
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
    fn clean_sine_has_no_issues_even_if_coarse() {
        assert_eq!(found(sine(1.0, 1000)), []);
        assert_eq!(
            found(sine(20.0, 1000).into_iter().map(f64::round).collect()),
            []
        );
    }

    #[test]
    fn each_issue_is_found_at_its_position_with_its_count() {
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
        // Converter codes, at one sample in five, in counts and in volts; all of them are counted.
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
