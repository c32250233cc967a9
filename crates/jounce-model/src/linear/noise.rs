//! Stationary noise, and the mean power under noise by integrals over frequency.
//!
//! With the one-sided power spectral density `S` of a drive (unit^2 per Hz) the mean power of a
//! resistor `R` is
//!
//! ```text
//! E[V^2] / R = integral S |V(f) / u|^2 / R df                        (Wiener and Khinchin)
//!            = (S / 2) b^T P b,       A^T P + P A = -c^T c / R       (Lyapunov, S constant over all frequencies)
//! ```
//!
//! with `b` the column of the drive and `c` the row of the voltage. The first is a quadrature that
//! also takes a band, the second a linear solve. They share no step after the diagonal form. In
//! terms of the two-sided density `Phi` per rad/s, `S = 4 pi Phi`. For the Lyapunov equation of a
//! band see [`super::covariance()`].
//!
//! Validation: `crates/jounce-analysis/tests/linear` compares the two with each other and with the
//! closed forms of Adhikari, Friswell and Inman, Smart Mater. Struct. 18 (2009) 115005, to 1e-8.

use super::quadrature::integral;
use crate::plant::{Meters, Plant, PlantError, dot, driven};
use crate::structure::Modes;
use jounce_linalg::c64;
use jounce_spec::{DriveSignal, Spec};
use std::f64::consts::TAU;

/// A stationary Gaussian drive with a flat spectrum; different drives are independent.
#[derive(Debug, Clone, PartialEq)]
pub struct NoiseInput {
    /// Name of the drive.
    pub name: String,
    /// Base accelerated by the drive.
    pub base: Option<String>,
    /// Modal force per unit size.
    pub shape: Vec<f64>,
    /// One-sided power spectral density, N^2/Hz or (m/s^2)^2/Hz.
    pub density: f64,
    /// Limits of the band, Hz; the upper one may be infinite.
    pub band_hz: [f64; 2],
}

impl NoiseInput {
    /// Returns the noises among the drives of a spec.
    ///
    /// # Errors
    /// [`PlantError::UnknownName`].
    pub fn of_spec(spec: &Spec, modes: &Modes) -> Result<Vec<Self>, PlantError> {
        let mut noises = Vec::new();
        for (name, drive) in &spec.drive {
            if let DriveSignal::Noise {
                density,
                low_hz,
                high_hz,
                ..
            } = drive.signal
            {
                let shape = driven(modes, name, drive)?;
                noises.push(Self {
                    name: name.clone(),
                    base: drive.base().map(str::to_owned),
                    shape,
                    density,
                    band_hz: [low_hz, high_hz],
                });
            }
        }
        Ok(noises)
    }

    /// Returns a noise acceleration of the base.
    pub fn of_base(plant: &Plant, density_m2_s3: f64, band_hz: [f64; 2]) -> Self {
        let shape = plant
            .system
            .modes
            .participation_sqrt_kg
            .iter()
            .map(|p| -p)
            .collect();
        Self {
            name: "base".to_owned(),
            base: None,
            shape,
            density: density_m2_s3,
            band_hz,
        }
    }

    /// Returns the noise with its band extended to all frequencies.
    pub fn white(&self) -> Self {
        Self {
            band_hz: [0.0, f64::INFINITY],
            ..self.clone()
        }
    }

    /// Returns the density at a frequency.
    pub fn density_at(&self, frequency_hz: f64) -> f64 {
        let [low_hz, high_hz] = self.band_hz;
        if (low_hz..=high_hz).contains(&frequency_hz) {
            self.density
        } else {
            0.0
        }
    }
}

/// Returns the mean power of each load, W, under white acceleration of the base with the one-sided
/// density `density_m2_s3`, m^2 s^-4 per Hz.
///
/// # Errors
/// [`PlantError::Undamped`] where an undamped mode carries power: its response has no mean.
pub fn white_noise_powers_w(plant: &Plant, density_m2_s3: f64) -> Result<Vec<f64>, PlantError> {
    let column = plant.base_column();
    let meters = Meters::new(plant)?;
    let loads = meters.loads.iter().take(plant.system.loads.len());
    Ok(loads
        .map(|meter| 0.5 * density_m2_s3 * meter.after_impulse_j(&column))
        .collect())
}

/// Returns the mean power of each load, W, under band-limited acceleration of the base. The
/// one-sided density is `density_m2_s3` between two frequencies (Hz; the upper one may be infinite)
/// and zero outside. The relative error is about 1e-10.
///
/// # Errors
/// [`PlantError::UndampedResonance`] where an undamped mode lies in the band.
pub fn noise_powers_between_w(
    plant: &Plant,
    density_m2_s3: f64,
    band_hz: [f64; 2],
) -> Result<Vec<f64>, PlantError> {
    let noise = [NoiseInput::of_base(plant, density_m2_s3, band_hz)];
    (plant.system.loads.iter().enumerate())
        .map(|(index, load)| {
            Ok(
                spectral_moment(plant, &noise, &plant.load_voltage_row(index), 1)?
                    / load.resistance_ohm,
            )
        })
        .collect()
}

/// Returns the one-sided power spectral density of an output under noises at a frequency,
/// unit^2/Hz.
///
/// # Errors
/// [`PlantError::UndampedResonance`].
pub fn density(
    plant: &Plant,
    noises: &[NoiseInput],
    row: &[f64],
    frequency_hz: f64,
) -> Result<f64, PlantError> {
    let mut sum = 0.0;
    for noise in noises {
        let size = noise.density_at(frequency_hz);
        if size > 0.0 {
            sum += size * gain(plant, noise, row, frequency_hz)?;
        }
    }
    Ok(sum)
}

/// Returns `|H|^2` of an output per unit of a noise.
pub(super) fn gain(
    plant: &Plant,
    noise: &NoiseInput,
    row: &[f64],
    frequency_hz: f64,
) -> Result<f64, PlantError> {
    let force: Vec<c64> = noise.shape.iter().map(|s| c64::new(*s, 0.0)).collect();
    Ok(dot(row, &plant.steady_state(TAU * frequency_hz, &force)?).norm_sqr())
}

/// Returns `integral G^power df` of the density `G` of an output, by quadrature to a relative error
/// of about 1e-10; the mean square for `power` 1.
///
/// # Errors
/// [`PlantError::UndampedResonance`] where an undamped mode lies in a band.
pub fn spectral_moment(
    plant: &Plant,
    noises: &[NoiseInput],
    row: &[f64],
    power: i32,
) -> Result<f64, PlantError> {
    let ends = noises.iter().flat_map(|noise| noise.band_hz);
    let (low_hz, high_hz) = ends
        .clone()
        .fold((f64::INFINITY, 0.0_f64), |(low, high), end| {
            (low.min(end), high.max(end))
        });
    let mut cuts_hz: Vec<f64> = plant
        .diagonal
        .block
        .eigenvalues()
        .iter()
        .map(|value| value.norm() / TAU)
        .collect();
    cuts_hz.retain(|cut_hz| *cut_hz > low_hz && *cut_hz < high_hz);
    cuts_hz.extend(ends);
    cuts_hz.sort_by(f64::total_cmp);
    cuts_hz.dedup_by(|one, other| (*one - *other).abs() <= 1e-12 * other.abs());
    let (mut moment, mut failed) = (0.0, None);
    for piece in cuts_hz.windows(2) {
        let middle_hz = if piece[1].is_finite() {
            0.5 * (piece[0] + piece[1])
        } else {
            2.0 * piece[0]
        };
        // Pieces end where bands end: a drive covers a piece completely or not at all.
        let driving: Vec<NoiseInput> = noises
            .iter()
            .filter(|noise| noise.density_at(middle_hz) > 0.0)
            .map(NoiseInput::white)
            .collect();
        if driving.is_empty() {
            continue;
        }
        let of = |frequency_hz: f64| match density(plant, &driving, row, frequency_hz) {
            Ok(density) => density.powi(power),
            Err(error) => {
                failed = Some(error);
                0.0
            }
        };
        moment += integral(of, piece[0], piece[1]);
    }
    failed.map_or(Ok(moment), Err)
}
