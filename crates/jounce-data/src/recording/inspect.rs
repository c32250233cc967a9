//! Inspects the samples of a channel for data-quality issues.

use super::flat_tops::{FLAT, FlatTops, RangeEnd};
use super::{Channel, Issue, IssueKind, IssuePlace, Quantity, Series};

/// Minimum number of leading or trailing zeros that are padding.
const PADDING: usize = 10;
/// Resolutions of converters, bits.
const BITS: [i32; 4] = [8, 12, 16, 24];
/// Tolerance on a multiple of the smallest step, in such steps.
const OFF_CODE: f64 = 1e-6;
/// Roundoff of a conversion to SI, and 1 g, m/s^2.
const ROUND: f64 = 1e-12;
const GRAVITY: f64 = 9.80665;
/// Size beyond which integers without unit are converter counts.
const COUNTS: f64 = 100.0;

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
        let Ok((_, sizes)) = inspected(&samples, false);
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
    let Ok((found, _)) = inspected(&channel.values.as_slice(), counts);
    found
        .into_iter()
        .map(|finding| finding.of(&channel.name))
        .collect()
}

/// True where the samples of a channel may be counts of a converter.
pub(crate) fn may_be_counts(quantity: Quantity, complex: bool) -> bool {
    quantity == Quantity::Unknown && !complex
}

/// Returns issues and sizes of samples, without channel name. Needs one pass, and a second one
/// where a long run of equal samples may be a flat top.
pub(crate) fn inspected<S: Series>(
    samples: &S,
    may_be_counts: bool,
) -> Result<(Vec<Issue>, Sizes), S::Fault> {
    let mut look = ChannelStatistics::default();
    samples.each(|x| look.take(x))?;
    let ends = [look.low, look.high].map(|value| RangeEnd::at(value, look.is_full_scale(value)));
    let mut tops = FlatTops::between(ends, look.quantum);
    if look.low < look.high && (look.longest >= FLAT || ends.iter().any(RangeEnd::is_full_scale)) {
        samples.each(|x| tops.take(x))?;
        tops.close(None);
    }
    let found = [
        look.not_a_number(),
        look.constant(),
        look.padding(),
        tops.finding(),
        look.counts().filter(|_| may_be_counts),
    ];
    let numbers = f64::max((look.number - look.missing) as f64, 1.0);
    Ok((
        found.into_iter().flatten().collect(),
        Sizes {
            rms: f64::sqrt(look.squares / numbers),
            peak: look.peak,
            mean: look.sum / numbers,
        },
    ))
}

/// Statistics from one pass over samples.
struct ChannelStatistics {
    /// Samples so far.
    number: usize,
    first: f64,
    before: f64,
    /// Count of samples that are not numbers, and the first of them.
    missing: usize,
    first_missing: Option<usize>,
    /// True while all samples equal the first one.
    same: bool,
    /// Zeros at the beginning and, so far, at the end.
    leading: usize,
    trailing: usize,
    /// Minimum and maximum, and the smallest nonzero step between samples.
    low: f64,
    high: f64,
    quantum: f64,
    /// Run of equal samples: current and longest.
    run: usize,
    longest: usize,
    whole: bool,
    sum: f64,
    squares: f64,
    peak: f64,
}

impl Default for ChannelStatistics {
    fn default() -> Self {
        Self {
            number: 0,
            first: f64::NAN,
            before: f64::NAN,
            missing: 0,
            first_missing: None,
            same: true,
            leading: 0,
            trailing: 0,
            low: f64::INFINITY,
            high: f64::NEG_INFINITY,
            quantum: f64::INFINITY,
            run: 0,
            longest: 0,
            whole: true,
            sum: 0.0,
            squares: 0.0,
            peak: 0.0,
        }
    }
}

impl ChannelStatistics {
    fn take(&mut self, x: f64) {
        if self.number == 0 {
            self.first = x;
        }
        self.same &= x == self.first;
        if x == 0.0 {
            self.leading += usize::from(self.leading == self.number);
            self.trailing += 1;
        } else {
            self.trailing = 0;
        }
        self.run = if x == self.before { self.run + 1 } else { 1 };
        self.longest = self.longest.max(self.run);
        let step = (x - self.before).abs();
        if step > 0.0 {
            self.quantum = self.quantum.min(step);
        }
        self.before = x;
        if x.is_finite() {
            self.low = self.low.min(x);
            self.high = self.high.max(x);
            self.whole &= x.fract() == 0.0;
            self.sum += x;
            self.squares += x * x;
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
        let about = format!("all samples are {}; there is no signal", self.first);
        (self.same && self.number > 1)
            .then(|| Issue::new(IssueKind::Constant, self.number, None, about))
    }

    fn padding(&self) -> Option<Issue> {
        if self.leading == self.number || self.leading.max(self.trailing) < PADDING {
            return None;
        }
        let counted = |zeros: usize| if zeros < PADDING { 0 } else { zeros };
        let (leading, trailing) = (counted(self.leading), counted(self.trailing));
        let first = if leading > 0 {
            0
        } else {
            self.number - trailing
        };
        let about = format!("{leading} exact zeros precede the signal and {trailing} follow it");
        Some(Issue::new(
            IssueKind::ZeroPadding,
            leading + trailing,
            Some(IssuePlace::Sample(first)),
            about,
        ))
    }

    /// True for a limit of a converter: a power of 2 from 2 on, in SI or in g, or the last code of
    /// 8, 12, 16 or 24 bits, in counts or in the smallest steps of the channel.
    fn is_full_scale(&self, value: f64) -> bool {
        let is_round =
            |size: f64| size > 1.5 && (size / size.log2().round().exp2() - 1.0).abs() < ROUND;
        // The limits of a range differ by one code; for a slow signal the smallest step between
        // samples is one code.
        let steps = if self.whole {
            [1.0; 2]
        } else {
            [self.quantum, (self.low + self.high).abs()]
        };
        let is_last = |step: &f64| {
            let code = (value / step).round();
            let last = |bits: &i32| {
                let half = f64::from(bits - 1).exp2();
                [half - 1.0, 2.0 * half - 1.0, -half, 1.0 - half].contains(&code)
            };
            (value / step - code).abs() < OFF_CODE && BITS.iter().any(last)
        };
        let by_size =
            value.abs() == self.peak && (is_round(self.peak) || is_round(self.peak / GRAVITY));
        by_size || steps.iter().any(is_last)
    }

    fn counts(&self) -> Option<Issue> {
        let about = "integers without unit: if they are converter counts, give the scale in the \
            notes of the file";
        (self.whole && self.peak > COUNTS)
            .then(|| Issue::new(IssueKind::RawCounts, self.number, None, about.to_owned()))
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
        let square = |k: u32| {
            if (k / 25).is_multiple_of(2) {
                5.0
            } else {
                -5.0
            }
        };
        assert_eq!(found((0..1000).map(square).collect()), []);
        assert_eq!(
            found(
                (0..1000)
                    .map(|k| if k % 25 == 0 { 0.4 } else { square(k) })
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
    fn a_clean_sine_has_no_findings_not_even_when_coarse() {
        assert_eq!(found(sine(1.0, 1000)), []);
        assert_eq!(
            found(sine(20.0, 1000).into_iter().map(f64::round).collect()),
            []
        );
    }

    #[test]
    fn each_fault_is_found_at_its_place_with_its_count() {
        let clipped: Vec<f64> = sine(1.0, 1000).into_iter().map(|x| x.min(0.9)).collect();
        let flat = clipped.iter().filter(|x| **x == 0.9).count();
        let first = clipped.iter().position(|x| *x == 0.9).unwrap();
        assert_eq!(
            found(clipped),
            [(IssueKind::Clipping, flat, Some(IssuePlace::Sample(first)))]
        );
        // Two single samples at the end of a range of 8, where the strokes are steep, are clipped.
        // At 7.9, or smooth as a sine's peaks of 8, they are not.
        let strokes = |end: f64| {
            let mut values = sine(1.0, 1000);
            (values[200], values[700]) = (-end, -end);
            values
        };
        assert_eq!(
            found(strokes(8.0)),
            [(IssueKind::Clipping, 2, Some(IssuePlace::Sample(200)))]
        );
        assert_eq!(found(strokes(7.9)), []);
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
            let half = f64::from(bits - 1).exp2();
            let over = |k: u32| {
                (1.3 * half * (TAU * 0.2013 * f64::from(k)).sin())
                    .round()
                    .clamp(-half, half - 1.0)
                    * scale
            };
            let values: Vec<f64> = (0..997).map(over).collect();
            let ends = values
                .iter()
                .filter(|x| **x == -half * scale || **x == (half - 1.0) * scale)
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
        let mut holed = sine(1.0, 300);
        (holed[7], holed[9]) = (f64::NAN, f64::INFINITY);
        assert_eq!(
            found(holed),
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
                .any(|finding| finding.kind == IssueKind::RawCounts)
        );
    }
}
