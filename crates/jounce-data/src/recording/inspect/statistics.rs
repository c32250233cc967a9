//! Statistics of the samples of a channel, from one pass, and the issues that they show.

use crate::recording::{Issue, IssueKind, IssuePlace};
use jounce_units::STANDARD_GRAVITY_M_S2;

/// Minimum number of leading or trailing zeros that are padding.
const MIN_PADDING_SAMPLES: usize = 10;

/// Resolutions of converters, bits.
const CONVERTER_BITS: [i32; 4] = [8, 12, 16, 24];

/// Tolerance on a multiple of the smallest step, in such steps.
const CODE_TOLERANCE: f64 = 1e-6;

/// Roundoff of a conversion to SI.
const ROUND_NUMBER_TOLERANCE: f64 = 1e-12;

/// Fewest samples among which one can be an outlier.
const MIN_OUTLIER_SAMPLES: usize = 100;

/// Share of the sum of all squares beyond which one sample is an outlier. The pulse of a single hit has
/// several samples.
const OUTLIER_SHARE: f64 = 0.999;

/// Size beyond which integers without unit are converter counts.
const MIN_COUNT_PEAK: f64 = 100.0;

/// Statistics from one pass over samples.
pub(super) struct ChannelStatistics {
    /// Samples so far.
    pub number: usize,
    first: f64,
    previous: f64,
    /// Count of samples that are not numbers, and the first of them.
    pub missing: usize,
    first_missing: Option<usize>,
    /// True while all samples equal the first one.
    is_constant: bool,
    /// Zeros at the beginning and, so far, at the end.
    leading: usize,
    trailing: usize,
    /// Minimum and maximum, and the smallest nonzero step between samples.
    pub low: f64,
    pub high: f64,
    pub quantum: f64,
    /// Run of equal samples: current and longest.
    run: usize,
    pub longest_run: usize,
    is_integer: bool,
    pub sum: f64,
    pub square_sum: f64,
    pub peak: f64,
    peak_index: usize,
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
            peak_index: 0,
        }
    }
}

impl ChannelStatistics {
    pub(super) fn add(&mut self, x: f64) {
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
            if x.abs() > self.peak {
                (self.peak, self.peak_index) = (x.abs(), self.number);
            }
        } else {
            self.missing += 1;
            self.first_missing = self.first_missing.or(Some(self.number));
        }
        self.number += 1;
    }

    pub(super) fn not_a_number(&self) -> Option<Issue> {
        let first = IssuePlace::Sample(self.first_missing?);
        Some(Issue::new(
            IssueKind::NotANumber,
            self.missing,
            Some(first),
            "samples are not numbers".to_owned(),
        ))
    }

    pub(super) fn constant(&self) -> Option<Issue> {
        let message = format!("all samples are {}; there is no signal", self.first);
        (self.is_constant && self.number > 1)
            .then(|| Issue::new(IssueKind::Constant, self.number, None, message))
    }

    pub(super) fn outlier(&self) -> Option<Issue> {
        let dominates = self.peak * self.peak > OUTLIER_SHARE * self.square_sum;
        let message = "one sample has more than 99.9 % of the sum of all squares; if it is a reading \
            error, remove it";
        (dominates && self.number >= MIN_OUTLIER_SAMPLES).then(|| {
            let place = Some(IssuePlace::Sample(self.peak_index));
            Issue::new(IssueKind::Outlier, 1, place, message.to_owned())
        })
    }

    pub(super) fn padding(&self) -> Option<Issue> {
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
    pub(super) fn is_full_scale(&self, value: f64) -> bool {
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

    pub(super) fn counts(&self) -> Option<Issue> {
        let message = "integers without unit: if they are converter counts, give the scale in the \
            notes of the file";
        (self.is_integer && self.peak > MIN_COUNT_PEAK)
            .then(|| Issue::new(IssueKind::RawCounts, self.number, None, message.to_owned()))
    }
}
