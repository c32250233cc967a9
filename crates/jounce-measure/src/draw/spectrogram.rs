//! Figures of spectra: over time, and averaged.

use jounce_core::picture::{DensityLine, Figure, TimeSpectrum, densities, spectrogram};

use crate::spectral::{Density, Spectrogram, density_unit};

/// Multiples of the drive frequency shown.
const SHOWN_ORDERS: f64 = 8.0;

/// Plots a spectrogram, up to eight times the drive frequency if known. Each spectrum covers the
/// time around the middle of its segment, each line the frequencies around it.
pub fn spectrogram_of(
    title: &str,
    quantity: &str,
    unit: &str,
    found: &Spectrogram,
    drive_hz: Option<f64>,
) -> Figure {
    let edges = |middles: &[f64], step: f64| {
        let first = middles.first().copied().unwrap_or(0.0) - 0.5 * step;
        (0..=middles.len())
            .map(|k| first + step * k as f64)
            .collect::<Vec<f64>>()
    };
    let highest_hz = drive_hz.map_or(f64::INFINITY, |f| (SHOWN_ORDERS + 0.5) * f);
    let kept = found
        .frequency_hz
        .iter()
        .take_while(|f| **f <= highest_hz)
        .count();
    let mut frequency_hz = edges(&found.frequency_hz[..kept], found.resolution_hz);
    if let Some(lowest) = frequency_hz.first_mut() {
        *lowest = 0.0;
    }
    let of = TimeSpectrum {
        quantity: quantity.to_owned(),
        unit: unit.to_owned(),
        time_s: edges(&found.time_s, found.step_s),
        frequency_hz,
        amplitude_peak: found
            .amplitude_peak
            .iter()
            .map(|spectrum| spectrum[..kept].to_vec())
            .collect(),
    };
    spectrogram(title, &of, drive_hz)
}

/// Plots a power spectral density.
pub fn densities_of(title: &str, quantity: &str, unit: &str, found: &Density) -> Figure {
    let unit = density_unit(unit);
    let line = DensityLine {
        quantity: quantity.to_owned(),
        unit,
        density: found.density.clone(),
        interval: [Vec::new(), Vec::new()],
    };
    densities(title, &found.frequency_hz, &[line])
}
