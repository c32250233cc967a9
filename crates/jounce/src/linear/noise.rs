//! Mean power under a random acceleration of the base, exact.
//!
//! With the one-sided power spectral density `S` (m^2 s^-4 per Hz) constant, the acceleration is white of intensity `S / 2`, and the
//! mean power of a resistor `R` with voltage row `c` is
//!
//! ```text
//! E[V^2] / R = (S / 2) b^T P b,       A^T P + P A = -c^T c / R          (Lyapunov)
//!            = integral_0^inf S |V(f) / a|^2 / R df                     (Wiener and Khinchin)
//! ```
//!
//! with `b` the column of the base acceleration. The first is a solve, the second a quadrature that also takes a band; they share no
//! step after the diagonal form. In terms of the two-sided density `Phi` per rad/s, `S = 4 pi Phi`.
//!
//! Validation: `tests/linear` holds both to each other and to the closed forms of Adhikari, Friswell and Inman, Smart Mater. Struct. 18
//! (2009) 115005, to 1e-8.

use super::quadrature::integral;
use crate::plant::{Meters, Plant, PlantError, dot};
use faer::c64;
use std::f64::consts::TAU;

/// Mean power of each load, W, under white acceleration of the base with the one-sided density `density_m2_s3`, m^2 s^-4 per Hz.
///
/// # Errors
/// [`PlantError::Undamped`] where an undamped mode carries power: its answer has no mean.
pub fn white_noise_powers_w(plant: &Plant, density_m2_s3: f64) -> Result<Vec<f64>, PlantError> {
    let column = plant.base_column();
    let meters = Meters::new(plant)?;
    Ok(meters.loads.iter().map(|meter| 0.5 * density_m2_s3 * meter.after_impulse_j(&column)).collect())
}

/// Mean power of each load, W, under acceleration of the base with the one-sided density `density_m2_s3` between two frequencies (Hz;
/// the upper one may be infinite) and none outside, to a relative error of about 1e-10.
///
/// # Errors
/// [`PlantError::UndampedResonance`] where an undamped mode lies in the band.
pub fn noise_powers_between_w(plant: &Plant, density_m2_s3: f64, band_hz: [f64; 2]) -> Result<Vec<f64>, PlantError> {
    let force: Vec<c64> = plant.system.modes.participation_sqrt_kg.iter().map(|p| c64::new(-p, 0.0)).collect();
    let [low_hz, high_hz] = band_hz;
    let mut cuts_hz: Vec<f64> = plant.diagonal.block.eigenvalues().iter().map(|value| value.norm() / TAU).collect();
    cuts_hz.retain(|cut_hz| *cut_hz > low_hz && *cut_hz < high_hz);
    cuts_hz.extend([low_hz, high_hz]);
    cuts_hz.sort_by(f64::total_cmp);
    cuts_hz.dedup_by(|one, other| (*one - *other).abs() <= 1e-12 * other.abs());
    (plant.system.loads.iter().enumerate())
        .map(|(index, load)| {
            let row = plant.load_voltage_row(index);
            let mut failed = None;
            let mut density_w = |frequency_hz: f64| match plant.steady_state(TAU * frequency_hz, &force) {
                Ok(state) => density_m2_s3 * dot(&row, &state).norm_sqr() / load.resistance_ohm,
                Err(error) => {
                    failed = Some(error);
                    0.0
                }
            };
            let power_w: f64 = cuts_hz.windows(2).map(|ends| integral(&mut density_w, ends[0], ends[1])).sum();
            failed.map_or(Ok(power_w), Err)
        })
        .collect()
}
