//! Flat tops of a clipped signal.

use crate::recording::{Issue, IssueKind, IssuePlace};

/// Minimum number of equal consecutive samples at an extreme that may be a flat top.
pub(super) const MIN_FLAT_SAMPLES: usize = 3;
/// Minimum number of clipped samples at the end of a converter's range, each different from its
/// neighbours by more than this share of the range.
const MIN_FULL_SCALE_SAMPLES: usize = 2;
const MIN_ISOLATION_RATIO: f64 = 0.1;
/// Average number of samples between flat tops below which a signal is a square wave.
const MAX_SQUARE_WAVE_SAMPLES: usize = 2;

/// One end of the range of a channel.
#[derive(Clone, Copy, Default)]
pub(super) struct RangeEnd {
    value: f64,
    /// True where a converter has its limit there.
    is_full_scale: bool,
    /// Count of samples at the end, and the first of them.
    samples: usize,
    first: Option<usize>,
    /// True once a flat top was entered or left by a jump.
    is_flat: bool,
    /// Samples at the end that differ from their neighbours.
    full_scale_samples: usize,
}

/// Flat tops of a channel with known range and smallest step.
#[derive(Default)]
pub(super) struct FlatTops {
    ends: [RangeEnd; 2],
    quantum: f64,
    /// Samples so far.
    number: usize,
    /// Current run of equal samples: its value, its length, and the sample before it.
    value: f64,
    run: usize,
    previous: Option<f64>,
    /// Flat runs at the ends so far, samples since the last of them, and samples between
    /// consecutive runs.
    runs: usize,
    samples_since_run: usize,
    samples_between_runs: usize,
}

impl RangeEnd {
    /// Returns an end without samples; `is_full_scale` marks a limit of a converter.
    pub(super) fn at(value: f64, is_full_scale: bool) -> Self {
        Self {
            value,
            is_full_scale,
            ..Self::default()
        }
    }

    /// True where a converter has its limit there.
    pub(super) fn is_full_scale(&self) -> bool {
        self.is_full_scale
    }
}

impl FlatTops {
    /// Returns the flat tops of a channel between two ends, with smallest step `quantum`.
    pub(super) fn new(ends: [RangeEnd; 2], quantum: f64) -> Self {
        Self {
            ends,
            quantum,
            ..Self::default()
        }
    }

    pub(super) fn add(&mut self, x: f64) {
        if self.run > 0 && x != self.value {
            self.close(Some(x));
            (self.previous, self.run) = (Some(self.value), 0);
        }
        self.value = x;
        self.run += 1;
        self.number += 1;
    }

    /// Evaluates the run that ends before the sample `next`.
    pub(super) fn close(&mut self, next: Option<f64>) {
        let (value, run) = (self.value, self.run);
        let neighbours = || [self.previous, next].into_iter().flatten();
        let is_steep =
            neighbours().any(|neighbours| (value - neighbours).abs() > 2.0 * self.quantum);
        let is_isolated = neighbours()
            .all(|neighbours| (value - neighbours).abs() > MIN_ISOLATION_RATIO * value.abs());
        let at_end = self.ends.iter_mut().find(|end| end.value == value);
        let is_long = run >= MIN_FLAT_SAMPLES && at_end.is_some();
        if let Some(end) = at_end {
            end.samples += run;
            end.first = end.first.or(Some(self.number - run));
            end.is_flat |= is_long && is_steep && value != 0.0;
            end.full_scale_samples += if end.is_full_scale && is_isolated {
                run
            } else {
                0
            };
        }
        if is_long {
            self.samples_between_runs += if self.runs > 0 {
                self.samples_since_run
            } else {
                0
            };
            (self.runs, self.samples_since_run) = (self.runs + 1, 0);
        } else {
            self.samples_since_run += run;
        }
    }

    pub(super) fn issue(&self) -> Option<Issue> {
        let is_square =
            self.runs > 1 && self.samples_between_runs < MAX_SQUARE_WAVE_SAMPLES * (self.runs - 1);
        let clipped = |has_property: fn(&RangeEnd) -> bool, message: String| {
            let ends: Vec<&RangeEnd> = self.ends.iter().filter(|end| has_property(end)).collect();
            let first = ends.iter().filter_map(|end| end.first).min()?;
            Some(Issue::new(
                IssueKind::Clipping,
                ends.iter().map(|end| end.samples).sum(),
                Some(IssuePlace::Sample(first)),
                message,
            ))
        };
        let [low, high] = self.ends;
        if low.is_flat || high.is_flat {
            let message = format!(
                "flat tops at the ends of the range {} to {}: the signal was clipped",
                low.value, high.value
            );
            return clipped(
                |end| end.is_flat || end.is_full_scale && end.full_scale_samples > 0,
                message,
            )
            .filter(|_| !is_square);
        }
        let full_scale_end = [low, high]
            .into_iter()
            .find(|end| end.full_scale_samples > 0)?;
        let message = format!(
            "samples are exactly at the end of a range of {}: the signal was probably clipped there",
            full_scale_end.value.abs()
        );
        clipped(|end| end.full_scale_samples > 0, message)
            .filter(|_| low.full_scale_samples + high.full_scale_samples >= MIN_FULL_SCALE_SAMPLES)
    }
}
