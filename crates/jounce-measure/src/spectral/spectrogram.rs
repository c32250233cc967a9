//! Amplitude spectra over time.

use jounce::signal::Samples;

use super::{Segments, SpectralError};

/// Amplitude spectra of overlapping segments.
#[derive(Debug, Clone, PartialEq)]
pub struct Spectrogram {
    /// Middle of each segment, s from the first sample.
    pub time_s: Vec<f64>,
    /// Frequency of each line, Hz.
    pub frequency_hz: Vec<f64>,
    /// Peak amplitude of each line for each segment.
    pub amplitude_peak: Vec<Vec<f64>>,
}

/// The spectrogram of a record; the mean stays, at 0 Hz.
///
/// # Errors
/// A segment longer than the record.
pub fn spectrogram(samples: &Samples<'_>, segments: &Segments) -> Result<Spectrogram, SpectralError> {
    let gain = segments.gain();
    let starts: Vec<usize> = segments.starts(samples.values().len())?.collect();
    let spectrum = |start: &usize| -> Vec<f64> {
        let bins = segments.transform(samples, *start, 0.0);
        bins.iter().enumerate().map(|(k, bin)| segments.sides(k) * bin.norm() / gain).collect()
    };
    let middle = |start: &usize| (*start as f64 + segments.length() as f64 / 2.0) / samples.rate_hz();
    Ok(Spectrogram {
        time_s: starts.iter().map(middle).collect(),
        frequency_hz: segments.frequency_hz(samples.rate_hz()),
        amplitude_peak: starts.iter().map(spectrum).collect(),
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use jounce::signal::Window;
    use std::f64::consts::TAU;

    /// A tone that changes its frequency in the middle is seen at each, with its amplitude.
    #[test]
    fn a_tone_is_seen_where_and_when_it_is() {
        let tone = |k: i32| if k < 5_000 { 2.0 * (TAU * 0.05 * f64::from(k)).sin() } else { 3.0 * (TAU * 0.2 * f64::from(k)).sin() };
        let values: Vec<f64> = (0..10_000).map(tone).collect();
        let found = spectrogram(&Samples::new(&values, 1000.0).unwrap(), &Segments::new(400, 0.5, Window::FlatTop).unwrap()).unwrap();
        for (time, spectrum) in found.time_s.iter().zip(&found.amplitude_peak).filter(|(t, _)| (**t - 5.0).abs() > 0.4) {
            let (line, peak) = if *time < 5.0 { (20, 2.0) } else { (80, 3.0) };
            assert!((spectrum[line] - peak).abs() < 1e-3, "{time}: {}", spectrum[line]);
        }
    }
}
