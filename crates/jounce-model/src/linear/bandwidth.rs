//! Bandwidths of a response to noise.
//!
//! ```text
//! noise bandwidth        integral_0^inf |H|^2 df / max |H|^2  band of a flat filter of equal power
//! statistical bandwidth  (integral G df)^2 / integral G^2 df  of the response with the density G
//! ```
//!
//! An oscillator has the noise bandwidth `pi zeta f_n` for its velocity and
//! `pi zeta (1 - zeta^2) f_n` for its displacement. The statistical bandwidth of a flat band of
//! noise is its width. Source: J. S. Bendat, A. G. Piersol, Random Data, 4th ed. (2010), sections
//! 8.2 and 8.5.

use super::covariance::{covariance, product};
use super::noise::{NoiseInput, gain, spectral_moment};
use super::random::RandomError;
use crate::plant::Plant;
use std::f64::consts::TAU;

/// Search points on each side of a resonance, in units of its decay rate.
const SEARCH_DISTANCES: [f64; 5] = [0.1, 0.3, 1.0, 3.0, 10.0];

/// Relative width of the bracket of a maximum at which the search ends: the error of `|H|^2` is of
/// the order of its square.
const MAX_BRACKET_WIDTH: f64 = 1e-8;

/// Returns the noise bandwidth of an output per unit of a noise, Hz; 0 where the noise does not
/// excite it.
///
/// # Errors
/// [`RandomError::Unsteady`], [`RandomError::Plant`].
pub fn noise_bandwidth_hz(
    plant: &Plant,
    noise: &NoiseInput,
    row: &[f64],
) -> Result<f64, RandomError> {
    let unit = NoiseInput {
        density: 1.0,
        ..noise.white()
    };
    let total = product(
        &covariance(plant, std::slice::from_ref(&unit)).map_err(RandomError::unsteady)?,
        row,
        row,
    );
    let highest = largest_gain(plant, &unit, row)?;
    Ok(if highest > 0.0 { total / highest } else { 0.0 })
}

/// Returns the statistical bandwidth of an output under noises, Hz; 0 where no noise excites it.
///
/// # Errors
/// [`RandomError::Plant`].
pub fn statistical_bandwidth_hz(
    plant: &Plant,
    noises: &[NoiseInput],
    row: &[f64],
) -> Result<f64, RandomError> {
    let (first, second) = (
        spectral_moment(plant, noises, row, 1)?,
        spectral_moment(plant, noises, row, 2)?,
    );
    Ok(if second > 0.0 {
        first * first / second
    } else {
        0.0
    })
}

/// Returns frequencies at which responses may be large, Hz, ascending: around every resonance, and
/// a few between.
pub(super) fn sampling_frequencies_hz(plant: &Plant) -> Vec<f64> {
    let mut all = Vec::new();
    for value in plant
        .diagonal
        .block
        .eigenvalues()
        .into_iter()
        .filter(|value| value.im >= 0.0 && value.norm() > 0.0)
    {
        all.extend([value.im, value.norm()]);
        all.extend(
            SEARCH_DISTANCES
                .iter()
                .flat_map(|k| [value.im - k * value.re, value.im + k * value.re]),
        );
        all.extend([0.3, 0.6, 0.9, 1.1, 1.6].map(|k| k * value.norm()));
    }
    all.retain(|w| *w > 0.0);
    all.sort_by(f64::total_cmp);
    all.dedup();
    all.into_iter().map(|w| w / TAU).collect()
}

/// Returns the largest `|H|^2` over all frequencies: the best of many points, then golden section
/// between its neighbours.
fn largest_gain(plant: &Plant, noise: &NoiseInput, row: &[f64]) -> Result<f64, RandomError> {
    let at = |frequency_hz: f64| gain(plant, noise, row, frequency_hz);
    let frequencies = sampling_frequencies_hz(plant);
    let sizes = frequencies
        .iter()
        .map(|frequency| at(*frequency))
        .collect::<Result<Vec<f64>, _>>()?;
    let Some(best) = (0..sizes.len()).max_by(|i, j| sizes[*i].total_cmp(&sizes[*j])) else {
        return Ok(0.0);
    };
    let mut low = if best == 0 {
        0.0
    } else {
        frequencies[best - 1]
    };
    let mut high = frequencies
        .get(best + 1)
        .copied()
        .unwrap_or(2.0 * frequencies[best]);
    let golden = (5f64.sqrt() - 1.0) / 2.0;
    let mut highest = sizes[best];
    while high - low > MAX_BRACKET_WIDTH * high {
        let (one, two) = (high - golden * (high - low), low + golden * (high - low));
        let (first, second) = (at(one)?, at(two)?);
        highest = highest.max(first).max(second);
        if first > second {
            high = two
        } else {
            low = one
        }
    }
    Ok(highest)
}
