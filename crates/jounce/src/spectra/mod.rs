//! Spectra of a recorded channel.

mod options;
mod report;
mod result;

pub use options::SpectraOptions;
pub use result::{OrderPeak, SpectraResult};

use crate::error::Error;
use crate::recording::Recording;
use jounce_signal::spectral::{Spectra, signal, spectra_watched, spectrogram_watched};

/// Number of reported peaks, the highest first.
const REPORTED_PEAKS: usize = 5;

impl Recording {
    /// Computes the power spectral density (Welch) of a channel, its amplitudes at the multiples of
    /// a drive frequency, and its spectrogram.
    ///
    /// # Errors
    /// [`Error::Option`], [`Error::NoChannel`], [`Error::Spectral`] for a channel without a signal
    /// or segments that do not fit.
    ///
    /// ```
    /// use jounce::parts::{Grid, Over, RawChannel};
    /// use jounce::{Recording, SpectraOptions};
    /// let volts: Vec<f64> = (0..5120).map(|k| (0.1 * f64::from(k)).sin()).collect();
    /// let channels = vec![RawChannel::new("patch", "V", volts)];
    /// let grid = Grid::Even { start: 0.0, step: 1e-3, count: 5120 };
    /// let recording = Recording::from_arrays("test", Over::Time, grid, channels)?;
    /// let result = recording.spectra(&SpectraOptions::default())?;
    /// assert!((result.peaks[0].frequency_hz - 15.9).abs() < result.resolution_hz);
    /// # Ok::<(), jounce::Error>(())
    /// ```
    pub fn spectra(&self, options: &SpectraOptions) -> Result<SpectraResult, Error> {
        let record = self.load(options)?;
        let settings = options.settings(record.channels[0].values.len(), record.rate())?;
        let channel = &record.channels[0];
        let samples = signal(channel, record.rate())?;
        let spectra = spectra_watched(&samples, &settings, self.control())?;
        let spectrogram = match options.spectrogram {
            true => Some(spectrogram_watched(
                &samples,
                &spectra.segments,
                self.control(),
            )?),
            false => None,
        };
        let peaks = spectra.peaks(REPORTED_PEAKS);
        let seconds = |samples: usize| samples as f64 / record.rate();
        let Spectra {
            density,
            segments,
            orders,
            ..
        } = spectra;
        let segment_s = seconds(segments.length());
        Ok(SpectraResult {
            channel: channel.name.clone(),
            unit: channel.unit.clone(),
            convention: format!(
                "{} segments of {segment_s:.4} s, {} window, overlap {}: lines {:.4} Hz apart; amplitudes are zero to peak, densities one-sided, per Hz",
                density.segments,
                options.window.name(),
                options.overlap,
                density.resolution_hz
            ),
            window: options.window,
            overlap: options.overlap,
            segment_s,
            step_s: seconds(segments.step()),
            segments: density.segments,
            resolution_hz: density.resolution_hz,
            mean: density.mean,
            peaks,
            frequency_hz: density.frequency_hz,
            density: density.density,
            drive_hz: options.drive_hz,
            orders: orders.iter().map(OrderPeak::of).collect(),
            issues: record.issues,
            spectrogram,
        })
    }
}
