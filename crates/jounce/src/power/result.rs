//! Result of the mean power of recorded voltages.

use jounce_data::recording::Issue;
use jounce_signal::spectral::MeanPower;
use jounce_signal::{OrderLine, Spectrum};
use serde::Serialize;

/// Mean power of each recorded voltage over its load.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PowerResult {
    /// Each recording.
    pub records: Vec<PowerRecord>,
    /// Frequency of the drive, Hz.
    #[serde(skip)]
    pub drive_hz: Option<f64>,
}

/// Mean power of a recorded voltage over its load.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PowerRecord {
    /// Name of the recording.
    pub name: String,
    /// Name of the channel of the voltage.
    pub channel: String,
    /// Resistance of the load, ohm.
    pub resistance_ohm: f64,
    /// Mean power and its interval.
    #[serde(flatten)]
    pub power: MeanPower,
    /// Mean square of the base acceleration about its mean, m^2/s^4; `None` without a base channel.
    pub mean_square_base_acceleration_m2_s4: Option<f64>,
    /// Mean power per mean square of the base acceleration, W s^4/m^2.
    pub mean_power_per_mean_square_w_s4_m2: Option<f64>,
    /// Amplitudes at the multiples of the drive frequency below half the sampling rate.
    pub orders: Vec<OrderAmplitude>,
    /// Data-quality issues of the channels, and the corrections made.
    pub issues: Vec<Issue>,
    /// Spectrum of the voltage, with a Hann window; `None` unless requested.
    #[serde(skip)]
    pub spectrum: Option<Spectrum>,
}

/// Voltage amplitude at a multiple of the drive frequency.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct OrderAmplitude {
    /// Multiple of the drive frequency.
    pub order: f64,
    /// Frequency, Hz.
    pub frequency_hz: f64,
    /// Amplitude, zero to peak, V.
    pub amplitude_peak_v: f64,
}

impl OrderAmplitude {
    pub(super) fn of(line: &OrderLine) -> Self {
        Self {
            order: line.order,
            frequency_hz: line.frequency_hz,
            amplitude_peak_v: line.amplitude_peak,
        }
    }
}
