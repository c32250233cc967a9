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

use jounce_linalg::c64;

use crate::modal::Band;
use jounce_signal::spectral::FrequencyResponse;

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
pub(in crate::modal) fn variance(function: &FrequencyResponse) -> Vec<f64> {
    let power: Vec<f64> = function.value.iter().map(|h| h.norm_sqr()).collect();
    // A relative deviation concerns only the magnitude, half of the variance.
    let line_variance = |k: usize| 2.0 * (function.relative_deviation(k).powi(2) * power[k]);
    let raw: Vec<f64> = (0..power.len())
        .map(|k| {
            if power[k] > 0.0 {
                line_variance(k)
            } else {
                0.0
            }
        })
        .collect();
    smoothed(&raw, &power, NEIGHBOUR_LINES)
}

/// Variance of each line of each response of a band, from the residuals of a fit and the leverage.
pub(super) fn residual_variance(
    band: &Band,
    model: &[Vec<c64>],
    leverage: &[Vec<f64>],
) -> Vec<Vec<f64>> {
    let response_variance = |o: usize| {
        // In the measured quantity: sensor noise of an acceleration is smooth there, not in the
        // displacement.
        let to_measured = |k: usize| band.as_measured(o, k).norm_sqr();
        let free = |k: usize| (1.0 - leverage[o][k]).max(MIN_FREE_SHARE);
        let raw: Vec<f64> = (0..leverage[o].len())
            .map(|k| (band.response[o][k] - model[o][k]).norm_sqr() * to_measured(k) / free(k))
            .collect();
        let power: Vec<f64> = (0..raw.len())
            .map(|k| model[o][k].norm_sqr() * to_measured(k))
            .collect();
        if raw.iter().chain(&power).all(|value| *value == 0.0) {
            return vec![1.0; raw.len()];
        }
        smoothed(&raw, &power, NEIGHBOUR_LINES_SINGLE)
            .iter()
            .enumerate()
            .map(|(k, v)| v / to_measured(k))
            .collect()
    };
    (0..band.response.len()).map(response_variance).collect()
}

/// `a + b |H|^2` at each line, from the variances `raw` of the lines, with so many lines on both
/// sides.
fn smoothed(raw: &[f64], power: &[f64], half_window: usize) -> Vec<f64> {
    let neighbours = |k: usize| k.saturating_sub(half_window)..(k + half_window + 1).min(raw.len());
    let mean = |k: usize| raw[neighbours(k)].iter().sum::<f64>() / neighbours(k).len() as f64;
    let mut smooth: Vec<f64> = (0..raw.len()).map(mean).collect();
    for _ in 0..WEIGHTED_FITS {
        let floor: Vec<f64> = power
            .iter()
            .map(|power| MIN_RELATIVE_DEVIATION * MIN_RELATIVE_DEVIATION * power)
            .collect();
        let weight: Vec<f64> = smooth
            .iter()
            .zip(&floor)
            .map(|(v, floor)| v.max(*floor).max(f64::MIN_POSITIVE).recip())
            .collect();
        smooth = (0..raw.len())
            .map(|k| local_fit(raw, power, &weight, neighbours(k), power[k]))
            .collect();
    }
    smooth
        .iter()
        .zip(power)
        .map(|(v, power)| v.max(2.0 * MIN_RELATIVE_DEVIATION * MIN_RELATIVE_DEVIATION * power))
        .collect()
}

/// `a + b |H|^2` at a line. `weight` is the reciprocal deviation of each line's own variance.
fn local_fit(
    raw: &[f64],
    power: &[f64],
    weight: &[f64],
    lines: std::ops::Range<usize>,
    line_power: f64,
) -> f64 {
    let [mut one, mut h, mut hh, mut v, mut hv] = [0.0; 5];
    for k in lines {
        let (w, hw) = (weight[k], weight[k] * power[k]);
        one += w * w;
        h += w * hw;
        hh += hw * hw;
        v += w * (w * raw[k]);
        hv += hw * (w * raw[k]);
    }
    let determinant = one * hh - h * h;
    let (a, b) = (
        (hh * v - h * hv) / determinant,
        (one * hv - h * v) / determinant,
    );
    match () {
        () if a >= 0.0 && b >= 0.0 => a + b * line_power,
        () if b < 0.0 || hh <= 0.0 => v / one,
        () => hv / hh * line_power,
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use jounce_linalg::c64;
    use jounce_signal::RandomStream;
    use jounce_signal::spectral::{Estimator, SpectrumAverages, WindowBias};

    /// Five blocks of a response with a sharp peak, noise of the response and of the force: the
    /// shared variance matches theory within 25 % (rms), where the lines' own are 50 % off.
    #[test]
    fn smoothed_variance_is_that_of_the_noise() {
        let mut stream = RandomStream::new(3, 0);
        let lines = 400;
        let exact_response = |k: usize| 1.0 / c64::new(1.0 - (k as f64 / 200.0).powi(2), 0.02);
        let (response_noise, force_noise): (f64, f64) = (0.5, 0.01);
        let mut draw = |scale: f64| {
            let [re, im] = stream.normal_pair();
            c64::new(re, im) * (scale / 2f64.sqrt())
        };
        let mut averages = SpectrumAverages::new(lines);
        for _ in 0..5 {
            let force: Vec<c64> = (0..lines).map(|_| 1.0 + draw(force_noise)).collect();
            let response: Vec<c64> = (0..lines)
                .map(|k| exact_response(k) + draw(response_noise))
                .collect();
            averages.add(&force, &response).unwrap();
        }
        let result = averages
            .response(vec![0.0; lines], Estimator::H1, WindowBias::Whole)
            .unwrap();
        let relative_error = |variances: &[f64]| {
            let truth = |k: usize| {
                (response_noise.powi(2) + (force_noise * exact_response(k).norm()).powi(2)) / 5.0
            };
            ((0..lines)
                .map(|k| (variances[k] / truth(k) - 1.0).powi(2))
                .sum::<f64>()
                / lines as f64)
                .sqrt()
        };
        let raw: Vec<f64> = (0..lines)
            .map(|k| 2.0 * (result.relative_deviation(k) * result.value[k].norm()).powi(2))
            .collect();
        let (raw, smoothed) = (relative_error(&raw), relative_error(&variance(&result)));
        eprintln!("lines alone {raw:.2}, shared {smoothed:.2} off");
        assert!(raw > 0.4 && smoothed < 0.25, "{raw} {smoothed}");
    }
}
