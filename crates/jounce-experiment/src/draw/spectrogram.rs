//! Figures of spectra: over time, and averaged.

use jounce_plot::{DensityLine, Figure, TimeSpectrum, densities, spectrogram};

use jounce_signal::spectral::{Density, Spectrogram, density_unit};

/// Multiples of the drive frequency shown.
const SHOWN_ORDERS: f64 = 8.0;

/// Plots a spectrogram, up to eight times the drive frequency if known. Each spectrum covers the
/// time around the middle of its segment, each line the frequencies around it.
pub fn spectrogram_of(
    title: &str,
    quantity: &str,
    unit: &str,
    result: &Spectrogram,
    drive_hz: Option<f64>,
) -> Figure {
    let edges = |centres: &[f64], step: f64| {
        let first = centres.first().copied().unwrap_or(0.0) - 0.5 * step;
        (0..=centres.len())
            .map(|k| first + step * k as f64)
            .collect::<Vec<f64>>()
    };
    let highest_hz = drive_hz.map_or(f64::INFINITY, |f| (SHOWN_ORDERS + 0.5) * f);
    let retained = result
        .frequency_hz
        .iter()
        .take_while(|f| **f <= highest_hz)
        .count();
    let mut frequency_hz = edges(&result.frequency_hz[..retained], result.resolution_hz);
    if let Some(lowest) = frequency_hz.first_mut() {
        *lowest = 0.0;
    }
    let time_spectrum = TimeSpectrum {
        quantity: quantity.to_owned(),
        unit: unit.to_owned(),
        time_s: edges(&result.time_s, result.step_s),
        frequency_hz,
        amplitude_peak: result
            .amplitude_peak
            .iter()
            .map(|spectrum| spectrum[..retained].to_vec())
            .collect(),
    };
    spectrogram(title, &time_spectrum, drive_hz)
}

/// Plots a power spectral density.
pub fn densities_of(title: &str, quantity: &str, unit: &str, result: &Density) -> Figure {
    let unit = density_unit(unit);
    let line = DensityLine {
        quantity: quantity.to_owned(),
        unit,
        density: result.density.clone(),
        interval: [Vec::new(), Vec::new()],
    };
    densities(title, &result.frequency_hz, &[line])
}
