//! Alignment in time of two sets of lines.

use jounce_linalg::c64;
use std::f64::consts::TAU;

/// Steps per drive cycle of the phase search before refinement.
const PHASE_STEPS: usize = 48;

/// Smallest sum of squares over all time shifts: by steps, then by the parabola through the best
/// one.
pub(super) fn least_distance(
    lines: &[c64],
    model: &[c64],
    orders: &[u32],
    common: u32,
    sign: f64,
) -> f64 {
    let sum = |shift: f64| {
        let term = |((x, c), j): ((&c64, &c64), &u32)| {
            let phasor = c64::cis(TAU * f64::from(*j) * shift / f64::from(common));
            (*x - *c * phasor * sign).norm_sqr()
        };
        lines.iter().zip(model).zip(orders).map(term).sum::<f64>()
    };
    let count = PHASE_STEPS * common as usize;
    let at = |k: usize| k as f64 / PHASE_STEPS as f64;
    let best_shift = (0..count)
        .map(|k| (sum(at(k)), at(k)))
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map_or(0.0, |result| result.1);
    let (mut low, mut high) = (
        best_shift - 1.0 / PHASE_STEPS as f64,
        best_shift + 1.0 / PHASE_STEPS as f64,
    );
    for _ in 0..30 {
        let (one, two) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if sum(one) < sum(two) {
            high = two
        } else {
            low = one
        }
    }
    sum(0.5 * (low + high))
}
