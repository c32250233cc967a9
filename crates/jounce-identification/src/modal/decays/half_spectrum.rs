//! Modes of decays, from their one-sided spectra.
//!
//! With samples `x_0 .. x_K` at the rate `r`, `T = 1/r`, the trapezoidal sum over the bins `w = 2
//! pi m r / K`
//!
//! ```text
//! S(w) = T [ x_0 / 2 + x_1 z + ... + x_K z^K / 2 ],   z = exp(-j w T),  z^K = 1
//! ```
//!
//! of `x_k = sum_r a_r exp(p_r k T)` is exactly, for any record length,
//!
//! ```text
//! S = sum_r R_r / (j W - P_r) + U,   W = 2/T tan(w T / 2),   P = 2/T tanh(p T / 2)
//! ```
//!
//! with a constant `U`: the form of a frequency response, at warped frequencies. The poles of
//! decays therefore satisfy the same equations as those of responses, without leakage or bias, and
//! are transformed back by `w = 2/T atan(W T / 2)`.
//!
//! Source: the identity is that of the bilinear transform, `coth(a - b) = (1 - tanh a tanh b) /
//! (tanh a - tanh b)`; one-sided spectra for modes after B. Cauberghe, Applied frequency-domain
//! system identification in the field of experimental and operational modal analysis (2004).

use jounce_linalg::c64;

/// Lines on both sides of a line over which the variance between blocks is averaged.
const NEIGHBOUR_LINES: usize = 4;

pub(super) fn truncate<T: Clone>(rows: &[Vec<T>], lines: usize) -> Vec<Vec<T>> {
    rows.iter().map(|values| values[..lines].to_vec()).collect()
}

/// Computes the trapezoidal one-sided spectrum of samples.
pub(super) fn half_spectrum(values: &[f64], rate_hz: f64) -> Vec<c64> {
    let last = values.len() - 1;
    let mut samples = values[..last].to_vec();
    // z^K = 1: the last sample coincides with the first.
    samples[0] = (values[0] + values[last]) / 2.0;
    let plan = jounce_fft::forward(last);
    let mut bins = plan.make_output_vec();
    plan.process(&mut samples, &mut bins)
        .expect("the plan made the length");
    bins.iter()
        .map(|bin| c64::new(bin.re, bin.im) / rate_hz)
        .collect()
}

/// Relative deviation of the magnitude of each line of the mean over blocks; empty without blocks.
pub(super) fn deviations(mean: &[Vec<c64>], blocks: &[Vec<Vec<c64>>]) -> Vec<Vec<f64>> {
    if blocks.len() < 2 {
        return Vec::new();
    }
    let count = blocks.len() as f64;
    let function_deviations = |(f, mean): (usize, &Vec<c64>)| {
        let line_variance = |k: usize| {
            blocks
                .iter()
                .map(|block| (block[f][k] - mean[k]).norm_sqr())
                .sum::<f64>()
                / (count * (count - 1.0))
        };
        let variance: Vec<f64> = (0..mean.len()).map(line_variance).collect();
        let smoothed = |k: usize| {
            let near = &variance
                [k.saturating_sub(NEIGHBOUR_LINES)..(k + NEIGHBOUR_LINES + 1).min(variance.len())];
            near.iter().sum::<f64>() / near.len() as f64
        };
        // Half of the variance lies along the line, as for a response.
        (0..mean.len())
            .map(|k| (smoothed(k) / 2.0).sqrt() / mean[k].norm().max(f64::MIN_POSITIVE))
            .collect()
    };
    mean.iter().enumerate().map(function_deviations).collect()
}
