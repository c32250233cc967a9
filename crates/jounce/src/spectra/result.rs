//! Result of spectra.

use jounce_data::recording::Issue;
use jounce_signal::spectral::{DensityPeak, Spectrogram};
use jounce_signal::{OrderLine, Window};
use serde::Serialize;

/// Power spectral density, order lines and spectrogram of a channel.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SpectraResult {
    /// Name of the channel.
    pub channel: String,
    /// Unit of the channel.
    pub unit: String,
    /// Segments, window and amplitudes in words.
    pub convention: String,
    /// Weights of a segment.
    pub window: Window,
    /// Overlap of adjacent segments, as a share of a segment.
    pub overlap: f64,
    /// Length of a segment, s.
    pub segment_s: f64,
    /// Time between the starts of adjacent segments, s.
    pub step_s: f64,
    /// Number of segments.
    pub segments: usize,
    /// Distance of the lines, Hz.
    pub resolution_hz: f64,
    /// Mean of the record, which was subtracted before the density, in the unit of the channel.
    pub mean: f64,
    /// Highest peaks of the density, the highest first, without side lobes of the window.
    pub peaks: Vec<DensityPeak>,
    /// Frequencies of the lines, Hz.
    pub frequency_hz: Vec<f64>,
    /// One-sided power spectral density, in the unit of the channel squared per hertz.
    pub density: Vec<f64>,
    /// Frequency of the drive, Hz.
    pub drive_hz: Option<f64>,
    /// Amplitudes at the multiples of the drive frequency below half the sampling rate.
    pub orders: Vec<OrderPeak>,
    /// Data-quality issues of the channel, and the corrections made.
    pub issues: Vec<Issue>,
    /// Amplitudes over time and frequency; `None` unless requested.
    #[serde(skip)]
    pub spectrogram: Option<Spectrogram>,
}

/// Amplitude at a multiple of the drive frequency.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct OrderPeak {
    /// Multiple of the drive frequency.
    pub order: f64,
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// Amplitude, zero to peak, in the unit of the channel.
    pub amplitude_peak: f64,
}

impl OrderPeak {
    pub(super) fn of(line: &OrderLine) -> Self {
        Self {
            order: line.order,
            frequency_hz: line.frequency_hz,
            amplitude_peak: line.amplitude_peak,
        }
    }
}
