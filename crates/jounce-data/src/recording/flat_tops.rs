//! Flat tops of a clipped signal.

use super::{Issue, IssueKind, IssuePlace};

/// Minimum number of equal consecutive samples at an extreme that may be a flat top.
pub(super) const FLAT: usize = 3;
/// Minimum number of clipped samples at the end of a converter's range, each different from its
/// neighbours by more than this share of the range.
const AT_FULL_SCALE: usize = 2;
const APART: f64 = 0.1;
/// Average number of samples between flat tops below which a signal is a square wave.
const SQUARE: usize = 2;

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
    strokes: usize,
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
    before: Option<f64>,
    /// Flat runs at the ends so far, samples since the last of them, and samples between
    /// consecutive runs.
    runs: usize,
    since: usize,
    between: usize,
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
    pub(super) fn between(ends: [RangeEnd; 2], quantum: f64) -> Self {
        Self {
            ends,
            quantum,
            ..Self::default()
        }
    }

    pub(super) fn take(&mut self, x: f64) {
        if self.run > 0 && x != self.value {
            self.close(Some(x));
            (self.before, self.run) = (Some(self.value), 0);
        }
        self.value = x;
        self.run += 1;
        self.number += 1;
    }

    /// Evaluates the run that ends before the sample `next`.
    pub(super) fn close(&mut self, next: Option<f64>) {
        let (value, run) = (self.value, self.run);
        let beside = || [self.before, next].into_iter().flatten();
        let steep = beside().any(|beside| (value - beside).abs() > 2.0 * self.quantum);
        let stands_out = beside().all(|beside| (value - beside).abs() > APART * value.abs());
        let at_end = self.ends.iter_mut().find(|end| end.value == value);
        let is_long = run >= FLAT && at_end.is_some();
        if let Some(end) = at_end {
            end.samples += run;
            end.first = end.first.or(Some(self.number - run));
            end.is_flat |= is_long && steep && value != 0.0;
            end.strokes += if end.is_full_scale && stands_out {
                run
            } else {
                0
            };
        }
        if is_long {
            self.between += if self.runs > 0 { self.since } else { 0 };
            (self.runs, self.since) = (self.runs + 1, 0);
        } else {
            self.since += run;
        }
    }

    pub(super) fn finding(&self) -> Option<Issue> {
        let is_square = self.runs > 1 && self.between < SQUARE * (self.runs - 1);
        let clipped = |is: fn(&RangeEnd) -> bool, about: String| {
            let ends: Vec<&RangeEnd> = self.ends.iter().filter(|end| is(end)).collect();
            let first = ends.iter().filter_map(|end| end.first).min()?;
            Some(Issue::new(
                IssueKind::Clipping,
                ends.iter().map(|end| end.samples).sum(),
                Some(IssuePlace::Sample(first)),
                about,
            ))
        };
        let [low, high] = self.ends;
        if low.is_flat || high.is_flat {
            let about = format!(
                "flat tops at the ends of the range {} to {}: the signal was clipped",
                low.value, high.value
            );
            return clipped(
                |end| end.is_flat || end.is_full_scale && end.strokes > 0,
                about,
            )
            .filter(|_| !is_square);
        }
        let full = [low, high].into_iter().find(|end| end.strokes > 0)?;
        let about = format!(
            "samples are exactly at the end of a range of {}: the signal was probably clipped there",
            full.value.abs()
        );
        clipped(|end| end.strokes > 0, about)
            .filter(|_| low.strokes + high.strokes >= AT_FULL_SCALE)
    }
}
