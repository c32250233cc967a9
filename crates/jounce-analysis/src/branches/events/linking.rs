//! Multipliers of two neighbouring points, linked by extrapolation with their derivatives, in the
//! logarithm, where the pair of a mode rotates uniformly.

use super::pairing::paired;
use super::spectrum::StepEnd;
use jounce_linalg::c64;
use std::f64::consts::TAU;

/// Multiplier with its extrapolation to the other end of the step.
struct LinkedMultiplier {
    value: c64,
    log: c64,
    /// Half of its relative change over the step.
    half: c64,
}

impl LinkedMultiplier {
    fn all(end: StepEnd) -> Vec<Self> {
        let led = |i: usize| Self {
            value: end.value(i),
            log: end.value(i).ln(),
            half: 0.5 * end.change(i) / end.value(i),
        };
        (0..end.count()).map(led).collect()
    }

    /// Returns the squared distance between two multipliers, each extrapolated towards the other
    /// end of the step.
    fn squared_distance(&self, to: &Self) -> f64 {
        let size = self.value.norm_sqr().max(to.value.norm_sqr());
        let distance = (to.value - self.value).norm_sqr();
        if size == 0.0 {
            return 0.0;
        }
        let log_error = to.log - self.log - (self.half + to.half);
        let turns = log_error.im - TAU * (log_error.im / TAU).round();
        let off = size * (log_error.re * log_error.re + turns * turns);
        // Where two real multipliers meet, their derivatives are unbounded.
        let is_real = self.value.im == 0.0 || to.value.im == 0.0;
        let off = if is_real { off.min(distance) } else { off };
        if off.is_finite() { off } else { distance }
    }
}

/// Returns each multiplier by its indices at the two ends.
pub(super) fn linked_pairs([a, b]: [StepEnd; 2]) -> Vec<(usize, usize)> {
    let (from, to) = (LinkedMultiplier::all(a), LinkedMultiplier::all(b));
    paired(from.len(), to.len(), |i, j| {
        from[i].squared_distance(&to[j])
    })
}
