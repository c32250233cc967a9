//! Spectra of a recorded channel.

use super::recording::{RecordingInput, findings};
use crate::arrays::PythonDict;
use crate::cancellable::{detached, to_python_result};
use crate::failure::Failure;
use crate::run::PythonResult;
use jounce_core::signal::Window;
use jounce_measure::recording::{Channel, Issue, Quantity};
use jounce_measure::spectral::{
    Spectra, SpectraSettings, Spectrogram, first_varying, signal, spectra_watched,
    spectrogram_watched,
};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Number of reported peaks of a density, the highest first.
const PEAKS: usize = 5;

/// Options of the segments of a record.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct SegmentOptions {
    drive_hz: Option<f64>,
    segment_s: Option<f64>,
    overlap: f64,
    window: String,
}

impl SegmentOptions {
    fn settings(&self) -> Result<SpectraSettings, Failure> {
        let window = match self.window.as_str() {
            "hann" => Window::Hann,
            "flat-top" => Window::FlatTop,
            "rectangular" => Window::Rectangular,
            name => {
                let reason = format!(
                    "window is \"{name}\"; it must be \"hann\", \"flat-top\" or \"rectangular\""
                );
                return Err(Failure::new("ArgumentError", reason));
            }
        };
        Ok(SpectraSettings {
            drive_hz: self.drive_hz,
            segment_s: self.segment_s,
            overlap: self.overlap,
            window,
        })
    }
}

/// Computes power spectral density, spectrogram and order lines of a channel; by default of the
/// first varying one in volts, else of the first varying one.
#[pyfunction]
pub fn measured_spectra<'py>(
    py: Python<'py>,
    recording: RecordingInput<'py>,
    channel: Option<String>,
    segment_options: SegmentOptions,
) -> PythonResult<'py> {
    let (record, settings) = (recording.even()?, segment_options.settings()?);
    let outcome = detached(py, move |control| {
        let channel = match &channel {
            Some(name) => record.channel(name)?,
            None => first_varying(&record, Quantity::Voltage).ok_or_else(|| {
                Failure::new("RecordingError", format!("{} has no channel", record.name))
            })?,
        };
        let samples = signal(channel, record.rate())?;
        let spectra = spectra_watched(&samples, &settings, control)?;
        let spectrogram = spectrogram_watched(&samples, &spectra.segments, control)?;
        Ok::<_, Failure>((channel.clone(), record.findings, spectra, spectrogram))
    });
    to_python_result(py, outcome, |data| into_python(py, data))
}

fn into_python<'py>(
    py: Python<'py>,
    (channel, issues, spectra, spectrogram): (Channel, Vec<Issue>, Spectra, Spectrogram),
) -> PyResult<Bound<'py, PyDict>> {
    let peaks = spectra.peaks(PEAKS);
    let (density, lines) = (spectra.density, spectra.orders);
    let width = spectrogram.frequency_hz.len();
    let dict = PythonDict::new(py)
        .with("channel", channel.name)?
        .with("unit", channel.unit)?
        .with("mean", density.mean)?
        .with("segment_s", spectrogram.segment_s)?
        .with("step_s", spectrogram.step_s)?
        .with("resolution_hz", spectrogram.resolution_hz)?
        .array("frequency_hz", density.frequency_hz)?
        .array("density", density.density)?
        .each("peak_frequency_hz", &peaks, |peak| peak.frequency_hz)?
        .each("peak_density", &peaks, |peak| peak.density)?
        .array("time_s", spectrogram.time_s)?
        .rows("amplitude_peak", &spectrogram.amplitude_peak, width)?
        .each("order", &lines, |line| line.order)?
        .each("order_frequency_hz", &lines, |line| line.frequency_hz)?
        .each("order_amplitude_peak", &lines, |line| line.amplitude_peak)?
        .with("findings", findings(&issues)?)?;
    Ok(dict.dict())
}
