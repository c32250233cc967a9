//! Exact covariance of the state under noise in a band: the frequency-limited Gramian.
//!
//! Noise with the one-sided density `S` between `f_1` and `f_2` on the column `b` gives the state
//! `y` the covariance `P`,
//!
//! ```text
//! A P + P A^T = -(S / 2) (F b b^T + b b^T F^T),     F = (1 / 2 pi) integral over w_1 < |w| < w_2 of (i w I - A)^-1 dw
//! ```
//!
//! `F` is a function of `A`. On the eigenvalue `l` it is
//! `-i / (2 pi) [log(i w - l) - log(-i w - l)]` between `w_1` and `w_2`, and 1/2 for white noise.
//! No numerical integration is needed. Mean
//! squares and products of outputs `c` are `c P c^T`.
//!
//! Limits: far from every resonance, the response in a band is a difference of numbers as large as
//! the white response. The error is about 1e-15 of the white response.
//!
//! Validation: `crates/jounce-analysis/tests/linear` compares with quadrature over frequency and
//! with closed forms.
//!
//! Source: W. Gawronski, J.-N. Juang, Int. J. Systems Sci. 21 (1990) 349.

use super::NoiseInput;
use crate::plant::{BlockDiagonal, BlockPair, LyapunovSide, Plant, lyapunov};
use jounce_linalg::{Mat, c64};
use std::f64::consts::{PI, TAU};

/// Relative part of a drive on the charge of an open patch, below which it is roundoff.
const COVARIANCE_ROUNDOFF: f64 = 1e-9;

/// Returns the covariance of the block coordinates under independent noises.
///
/// # Errors
/// The drive and the frequency, Hz, of an excited mode without damping or restoring force.
pub fn covariance(plant: &Plant, noises: &[NoiseInput]) -> Result<Mat<f64>, (String, f64)> {
    let block = &plant.diagonal.block;
    let mut sum = Mat::zeros(block.len(), block.len());
    for noise in noises {
        let mut column = plant.force_column(&noise.shape);
        let largest = column.iter().fold(0.0_f64, |max, b| max.max(b.abs()));
        for (b, free) in column.iter_mut().zip(block.free()) {
            if free && b.abs() > COVARIANCE_ROUNDOFF * largest {
                return Err((noise.name.clone(), 0.0));
            } else if free {
                *b = 0.0;
            }
        }
        let band_column = filtered(block, &column, noise.band_hz.map(|end_hz| TAU * end_hz));
        let source = |i: usize, j: usize| {
            0.5 * noise.density * (band_column[i] * column[j] + column[i] * band_column[j])
        };
        sum += lyapunov(block, LyapunovSide::Columns, source)
            .map_err(|mode_hz| (noise.name.clone(), mode_hz))?;
    }
    Ok(sum)
}

/// Returns `c P d^T`.
pub fn product(covariance: &Mat<f64>, c: &[f64], d: &[f64]) -> f64 {
    c.iter()
        .enumerate()
        .map(|(i, c)| {
            c * d
                .iter()
                .enumerate()
                .map(|(j, d)| covariance[(i, j)] * d)
                .sum::<f64>()
        })
        .sum()
}

/// Returns `F b`.
fn filtered(block: &BlockDiagonal, column: &[f64], band_rad_s: [f64; 2]) -> Vec<f64> {
    let mut out = Vec::with_capacity(column.len());
    for (pair, b) in block.pairs.iter().zip(column.chunks_exact(2)) {
        if b == [0.0, 0.0] {
            out.extend([0.0, 0.0]);
            continue;
        }
        match *pair {
            BlockPair::Oscillatory { .. } => {
                let transformed = share(pair.eigenvalue(), band_rad_s) * c64::new(b[0], b[1]);
                out.extend([transformed.re, transformed.im]);
            }
            BlockPair::Jordan { rate } => {
                let [f, slope] = [
                    share(pair.eigenvalue(), band_rad_s).re,
                    share_slope(rate, band_rad_s),
                ];
                out.extend([f * b[0] + slope * b[1], f * b[1]]);
            }
            // No band makes the displacement of a free body steady.
            BlockPair::FreeBody { .. } => out.extend([f64::INFINITY; 2]),
        }
    }
    let single = &column[2 * block.pairs.len()..];
    let real_part = |(rate, b): (&f64, &f64)| {
        if *b == 0.0 {
            0.0
        } else {
            share(c64::new(*rate, 0.0), band_rad_s).re * b
        }
    };
    out.extend(block.reals.iter().zip(single).map(real_part));
    out
}

/// Returns `F` on an eigenvalue.
fn share(eigenvalue: c64, [low, high]: [f64; 2]) -> c64 {
    let below = |w: f64| match w.is_infinite() {
        true => c64::new(0.0, PI),
        false => (c64::new(0.0, w) - eigenvalue).ln() - (c64::new(0.0, -w) - eigenvalue).ln(),
    };
    c64::new(0.0, -1.0 / TAU) * (below(high) - below(low))
}

/// Returns the derivative of `F` on a real eigenvalue, s.
fn share_slope(rate: f64, [low, high]: [f64; 2]) -> f64 {
    let below = |w: f64| {
        if w.is_infinite() {
            0.0
        } else {
            w / (PI * (w * w + rate * rate))
        }
    };
    below(high) - below(low)
}
