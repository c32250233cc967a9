//! Spectra of a channel: its density, and the lines of its drive.

use crate::{OrderLine, Samples, Window};
use jounce_control::Control;

use super::{Density, Segments};
use crate::spectral::SpectralError;

/// Multiples of the drive frequency whose amplitudes are reported.
const REPORTED_ORDERS: [f64; 10] = [1.0 / 3.0, 0.5, 2.0 / 3.0, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0];
/// Default number of segments of a record, without overlap.
const DEFAULT_SEGMENTS: usize = 32;
/// Default number of drive cycles of a segment: a third of the drive frequency is then eight lines
/// away from the next multiple.
const DEFAULT_SEGMENT_CYCLES: f64 = 24.0;
/// Samples of the shortest default segment.
const MIN_DEFAULT_SEGMENT: usize = 256;

/// Settings of the spectra.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpectraSettings {
    /// Drive frequency, Hz; without it no lines are reported.
    pub drive_hz: Option<f64>,
    /// Length of a segment, s; by default 24 drive cycles, or without a drive a thirty-second of
    /// the record.
    pub segment_s: Option<f64>,
    /// Overlap of consecutive segments, as a share.
    pub overlap: f64,
    /// Window of a segment.
    pub window: Window,
}

/// Spectra of a record.
#[derive(Debug, Clone)]
pub struct Spectra {
    /// One-sided power spectral density.
    pub density: Density,
    /// Segments of the average; [`super::spectrogram()`] of them contains as many numbers as the
    /// record, and more where they overlap.
    pub segments: Segments,
    /// Amplitudes at the multiples of the drive frequency below half the sampling rate.
    pub orders: Vec<OrderLine>,
    /// Largest density of a line by rounding alone, unit^2/Hz; a peak below it is none.
    pub roundoff_density: f64,
}

/// Computes density and order lines of a record, and its segments.
///
/// # Errors
/// A segment that does not fit the record, an overlap out of its range, a record too short to
/// resolve the lines of the drive.
pub fn spectra(
    samples: &Samples<'_>,
    settings: &SpectraSettings,
) -> Result<Spectra, SpectralError> {
    spectra_watched(samples, settings, &Control::default())
}

/// Computes spectra with a cancellation check.
///
/// # Errors
/// Those of [`spectra`], and [`SpectralError::Stopped`].
pub fn spectra_watched(
    samples: &Samples<'_>,
    settings: &SpectraSettings,
    control: &Control,
) -> Result<Spectra, SpectralError> {
    let (count, rate_hz) = (samples.values().len(), samples.rate_hz());
    let default_length = || {
        (count / DEFAULT_SEGMENTS)
            .max(MIN_DEFAULT_SEGMENT)
            .min(count)
    };
    let cycles_s = settings
        .drive_hz
        .map(|f| DEFAULT_SEGMENT_CYCLES / f)
        .filter(|s| s * rate_hz <= count as f64);
    let length = settings
        .segment_s
        .or(cycles_s)
        .map_or_else(default_length, |s| (s * rate_hz).round() as usize)
        / 2
        * 2;
    let segments = Segments::new(length, settings.overlap, settings.window)?;
    let orders = match settings.drive_hz {
        None => Vec::new(),
        Some(drive_hz) => {
            let orders_in_range: Vec<f64> = REPORTED_ORDERS
                .into_iter()
                .filter(|order| order * drive_hz < 0.5 * rate_hz)
                .collect();
            samples.orders(drive_hz, &orders_in_range)?.lines
        }
    };
    Ok(Spectra {
        density: Density::welch(samples, &segments, control)?,
        roundoff_density: segments.roundoff_density(samples.peak(), rate_hz),
        segments,
        orders,
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn settings() -> SpectraSettings {
        SpectraSettings {
            drive_hz: None,
            segment_s: None,
            overlap: 0.5,
            window: Window::Hann,
        }
    }

    /// 2 V at 12 Hz and 1 V at 6 Hz for 20 s at 1 kHz: a segment is 24 cycles of the drive, the order lines are the amplitudes, and the integral
    /// of the density is the variance, 2.5 V^2.
    #[test]
    fn a_tone_shows_its_lines_and_its_variance() {
        let value =
            |k: i32| 2.0 * (TAU * 0.012 * f64::from(k)).sin() + (TAU * 0.006 * f64::from(k)).sin();
        let values: Vec<f64> = (0..20_000).map(value).collect();
        let samples = Samples::new(&values, 1000.0).unwrap();
        let result = spectra(
            &samples,
            &SpectraSettings {
                drive_hz: Some(12.0),
                ..settings()
            },
        )
        .unwrap();
        assert_eq!(
            (result.segments.length(), result.segments.step()),
            (2000, 1000)
        );
        for line in &result.orders {
            let expected = if line.order == 1.0 {
                2.0
            } else {
                f64::from(u8::from(line.order == 0.5))
            };
            assert!((line.amplitude_peak - expected).abs() < 1e-9, "{line:?}");
        }
        let variance = result.density.density.iter().sum::<f64>() * result.density.resolution_hz;
        assert!((variance - 2.5).abs() < 0.01);
        let without_drive = spectra(&samples, &settings()).unwrap();
        assert!(without_drive.orders.is_empty() && without_drive.segments.length() == 624);
    }

    #[test]
    fn segments_that_do_not_fit_are_errors() {
        let values = [1.0; 300];
        let samples = Samples::new(&values, 100.0).unwrap();
        assert!(matches!(
            spectra(
                &samples,
                &SpectraSettings {
                    segment_s: Some(4.0),
                    ..settings()
                }
            ),
            Err(SpectralError::Segment { .. })
        ));
        assert!(matches!(
            spectra(
                &samples,
                &SpectraSettings {
                    overlap: 1.0,
                    ..settings()
                }
            ),
            Err(SpectralError::Overlap { .. })
        ));
    }
}
