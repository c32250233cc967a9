//! Variance of the lines of a response, from the scatter of its blocks or from the residuals of a
//! fit.
//!
//! Each line has a variance estimate `v = |H|^2 (1 - c) / ((n - 1) c)` from `n` blocks of coherence
//! `c`. For few blocks this is one draw from a broad distribution, and weights from it would favour
//! lines that agree by chance. Noise of the sensors varies smoothly over the lines, for the
//! response directly and for the force times `H`, so that around each line
//!
//! ```text
//! v = a + b |H|^2,   a, b >= 0
//! ```
//!
//! is fitted to the neighbouring lines by least squares, each weighted by the reciprocal of its
//! squared variance. Without blocks, the residual of a line is one draw from its variance, and more
//! lines are combined.

use faer::c64;

use super::Band;
use crate::spectral::FrequencyResponse;

/// Lines on both sides of a line that are fitted together.
const NEIGHBOUR_LINES: usize = 12;
/// Lines on both sides where each line is a single draw.
const NEIGHBOUR_LINES_SINGLE: usize = 100;
/// Minimum relative deviation of a line.
const MIN_RELATIVE_DEVIATION: f64 = 1e-6;
/// Number of weighted fits.
const WEIGHTED_FITS: usize = 3;
/// Number of fits weighted by the residuals of the previous one.
pub(super) const RESIDUAL_FITS: usize = 2;
/// Minimum share of a line that is attributed to the residual.
pub(super) const MIN_FREE_SHARE: f64 = 0.05;

/// Variance of each line of a response of several blocks, real and imaginary part together.
pub(super) fn variance(function: &FrequencyResponse) -> Vec<f64> {
    let square: Vec<f64> = function.value.iter().map(|h| h.norm_sqr()).collect();
    // A relative deviation concerns only the magnitude, half of the variance.
    let told = |k: usize| 2.0 * (function.relative_deviation(k).powi(2) * square[k]);
    let own: Vec<f64> = (0..square.len())
        .map(|k| if square[k] > 0.0 { told(k) } else { 0.0 })
        .collect();
    shared(&own, &square, NEIGHBOUR_LINES)
}

/// Variance of each line of each response of a band, from the residuals of a fit and the leverage.
pub(super) fn of_what_is_left(
    band: &Band,
    model: &[Vec<c64>],
    taken: &[Vec<f64>],
) -> Vec<Vec<f64>> {
    let of = |o: usize| {
        // In the measured quantity: sensor noise of an acceleration is smooth there, not in the
        // displacement.
        let turn = |k: usize| band.as_measured(o, k).norm_sqr();
        let free = |k: usize| (1.0 - taken[o][k]).max(MIN_FREE_SHARE);
        let own: Vec<f64> = (0..taken[o].len())
            .map(|k| (band.response[o][k] - model[o][k]).norm_sqr() * turn(k) / free(k))
            .collect();
        let square: Vec<f64> = (0..own.len())
            .map(|k| model[o][k].norm_sqr() * turn(k))
            .collect();
        if own.iter().chain(&square).all(|size| *size == 0.0) {
            return vec![1.0; own.len()];
        }
        shared(&own, &square, NEIGHBOUR_LINES_SINGLE)
            .iter()
            .enumerate()
            .map(|(k, v)| v / turn(k))
            .collect()
    };
    (0..band.response.len()).map(of).collect()
}

/// `a + b |H|^2` at each line, from the variances `own` of the lines, with so many lines on both
/// sides.
fn shared(own: &[f64], square: &[f64], beside: usize) -> Vec<f64> {
    let near = |k: usize| k.saturating_sub(beside)..(k + beside + 1).min(own.len());
    let mean = |k: usize| own[near(k)].iter().sum::<f64>() / near(k).len() as f64;
    let mut smooth: Vec<f64> = (0..own.len()).map(mean).collect();
    for _ in 0..WEIGHTED_FITS {
        let least: Vec<f64> = square
            .iter()
            .map(|square| MIN_RELATIVE_DEVIATION * MIN_RELATIVE_DEVIATION * square)
            .collect();
        let weight: Vec<f64> = smooth
            .iter()
            .zip(&least)
            .map(|(v, least)| v.max(*least).max(f64::MIN_POSITIVE).recip())
            .collect();
        smooth = (0..own.len())
            .map(|k| around(own, square, &weight, near(k), square[k]))
            .collect();
    }
    smooth
        .iter()
        .zip(square)
        .map(|(v, square)| v.max(2.0 * MIN_RELATIVE_DEVIATION * MIN_RELATIVE_DEVIATION * square))
        .collect()
}

/// `a + b |H|^2` at a line. `weight` is the reciprocal deviation of each line's own variance.
fn around(
    own: &[f64],
    square: &[f64],
    weight: &[f64],
    near: std::ops::Range<usize>,
    here: f64,
) -> f64 {
    let [mut one, mut h, mut hh, mut v, mut hv] = [0.0; 5];
    for k in near {
        let (w, hw) = (weight[k], weight[k] * square[k]);
        one += w * w;
        h += w * hw;
        hh += hw * hw;
        v += w * (w * own[k]);
        hv += hw * (w * own[k]);
    }
    let determinant = one * hh - h * h;
    let (a, b) = (
        (hh * v - h * hv) / determinant,
        (one * hv - h * v) / determinant,
    );
    match () {
        () if a >= 0.0 && b >= 0.0 => a + b * here,
        () if b < 0.0 || hh <= 0.0 => v / one,
        () => hv / hh * here,
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::spectral::{Estimator, SpectrumAverages, WindowBias};
    use faer::c64;
    use jounce_core::drive::RandomStream;

    /// Five blocks of a response with a sharp peak, noise of the response and of the force: the
    /// shared variance matches theory within 25 % (rms), where the lines' own are 50 % off.
    #[test]
    fn the_shared_variance_is_that_of_the_noise() {
        let mut stream = RandomStream::new(3, 0);
        let lines = 400;
        let exact = |k: usize| 1.0 / c64::new(1.0 - (k as f64 / 200.0).powi(2), 0.02);
        let (of_response, of_force): (f64, f64) = (0.5, 0.01);
        let mut draw = |size: f64| {
            let [re, im] = stream.normal_pair();
            c64::new(re, im) * (size / 2f64.sqrt())
        };
        let mut averages = SpectrumAverages::new(lines);
        for _ in 0..5 {
            let force: Vec<c64> = (0..lines).map(|_| 1.0 + draw(of_force)).collect();
            let response: Vec<c64> = (0..lines).map(|k| exact(k) + draw(of_response)).collect();
            averages.add(&force, &response).unwrap();
        }
        let found = averages
            .response(vec![0.0; lines], Estimator::H1, WindowBias::Whole)
            .unwrap();
        let off = |of: &[f64]| {
            let truth =
                |k: usize| (of_response.powi(2) + (of_force * exact(k).norm()).powi(2)) / 5.0;
            ((0..lines)
                .map(|k| (of[k] / truth(k) - 1.0).powi(2))
                .sum::<f64>()
                / lines as f64)
                .sqrt()
        };
        let own: Vec<f64> = (0..lines)
            .map(|k| 2.0 * (found.relative_deviation(k) * found.value[k].norm()).powi(2))
            .collect();
        let (own, shared) = (off(&own), off(&variance(&found)));
        eprintln!("lines alone {own:.2}, shared {shared:.2} off");
        assert!(own > 0.4 && shared < 0.25, "{own} {shared}");
    }
}
