//! Options of spectra.

use crate::error::Error;
use crate::options::{check_drive, defaults, frequency_hz, time_s};
use crate::recording::{ChannelList, ChosenChannel, UsesChannels};
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use jounce_data::recording::Quantity;
use jounce_signal::Window;
use jounce_signal::spectral::{MIN_SEGMENT_SAMPLES, SpectraSettings};
use jounce_spec::Quantity as Time;
use serde::{Deserialize, Serialize};

/// Options of [`crate::Recording::spectra`].
#[derive(Debug, Clone, PartialEq, clap::Args, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SpectraOptions {
    /// Channel to transform; by default the first varying one in volts, else the first varying one.
    #[arg(long, value_name = "CHANNEL")]
    pub channel: Option<String>,
    /// Frequency of the drive, as in 13Hz: amplitudes at its multiples are reported and marked.
    #[arg(long = "drive", value_name = "FREQUENCY", value_parser = frequency_hz)]
    pub drive_hz: Option<f64>,
    /// Length of a segment, as in 2s; by default 24 cycles of the drive, or without a drive a
    /// thirty-second of the record.
    #[arg(long = "segment", value_name = "TIME", value_parser = time_s)]
    pub segment_s: Option<f64>,
    /// Overlap of adjacent segments, as a share of a segment.
    #[arg(long, default_value_t = 0.5)]
    pub overlap: f64,
    /// Weights of a segment.
    #[arg(long, value_parser = window_parser(), default_value = "hann")]
    pub window: Window,
    /// Also computes the spectrogram, which has as many numbers as the record.
    #[arg(skip)]
    #[serde(skip)]
    pub spectrogram: bool,
}

/// Returns the reader of a window by its name.
fn window_parser() -> impl TypedValueParser<Value = Window> {
    let value = |window: Window| PossibleValue::new(window.name()).help(window_help(window));
    PossibleValuesParser::new(Window::ALL.map(value)).try_map(|name| {
        let mut windows = Window::ALL.into_iter();
        let window = windows.find(|window| window.name() == name);
        window.ok_or_else(|| format!("{name} is no window"))
    })
}

/// Returns the help on a window.
fn window_help(window: Window) -> &'static str {
    match window {
        Window::Hann => {
            "Finest frequency resolution: a line is four bins wide; a sinusoid between two bins shows up to 15 % less"
        }
        Window::FlatTop => {
            "Accurate amplitudes: a line is ten bins wide; a sinusoid between two bins shows at most 0.1 % less"
        }
        Window::Rectangular => "No weights, for complete periods only",
    }
}

impl Default for SpectraOptions {
    fn default() -> Self {
        defaults()
    }
}

/// Returns the length of a segment, s, if it has enough samples and fits into the record.
fn check_segment(segment_s: f64, samples: usize, rate_hz: f64) -> Result<f64, Error> {
    let length = (segment_s * rate_hz).round();
    let least = MIN_SEGMENT_SAMPLES.min(samples) as f64;
    if (least..=samples as f64).contains(&length) {
        return Ok(segment_s);
    }
    let [given, least_text, most] = [segment_s, least / rate_hz, samples as f64 / rate_hz]
        .map(|time_s| Time::Time.write(time_s));
    let expected = format!(
        "it must be from {least_text}, which is {least} samples, to {most}, the length of the record"
    );
    Err(Error::option("segment", given, expected))
}

impl UsesChannels for SpectraOptions {
    fn channels(&self, list: &ChannelList) -> Result<Vec<ChosenChannel>, Error> {
        Ok(vec![match &self.channel {
            Some(name) => list.find(name)?,
            None => list.first_varying(Quantity::Voltage)?,
        }])
    }
}

impl SpectraOptions {
    /// Returns the settings for a record of so many samples at a rate, Hz.
    pub(super) fn settings(&self, samples: usize, rate_hz: f64) -> Result<SpectraSettings, Error> {
        let drive = |drive_hz| check_drive(drive_hz, rate_hz, (0.5, "half"));
        let segment = |segment_s| check_segment(segment_s, samples, rate_hz);
        Ok(SpectraSettings {
            drive_hz: self.drive_hz.map(drive).transpose()?,
            segment_s: self.segment_s.map(segment).transpose()?,
            overlap: self.overlap,
            window: self.window,
        })
    }
}
