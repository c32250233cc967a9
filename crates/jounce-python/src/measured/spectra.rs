//! Spectra of a recorded channel.

use super::recording::{GivenRecording, findings};
use crate::arrays::PythonDict;
use crate::cancellable::{left_alone, to_python_result};
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
            other => {
                let why = format!(
                    "window is \"{other}\"; it must be \"hann\", \"flat-top\" or \"rectangular\""
                );
                return Err(Failure::new("ArgumentError", why));
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
    given: GivenRecording<'py>,
    channel: Option<String>,
    cut: SegmentOptions,
) -> PythonResult<'py> {
    let (record, settings) = (given.even()?, cut.settings()?);
    let found = left_alone(py, move |control| {
        let channel = match &channel {
            Some(name) => record.channel(name)?,
            None => first_varying(&record, Quantity::Voltage).ok_or_else(|| {
                Failure::new("RecordingError", format!("{} has no channel", record.name))
            })?,
        };
        let samples = signal(channel, record.rate())?;
        let found = spectra_watched(&samples, &settings, control)?;
        let over_time = spectrogram_watched(&samples, &found.segments, control)?;
        Ok::<_, Failure>((channel.clone(), record.findings, found, over_time))
    });
    to_python_result(py, found, |found| into_python(py, found))
}

fn into_python<'py>(
    py: Python<'py>,
    (channel, told_of, found, spectrogram): (Channel, Vec<Issue>, Spectra, Spectrogram),
) -> PyResult<Bound<'py, PyDict>> {
    let peaks = found.peaks(PEAKS);
    let (density, lines) = (found.density, found.orders);
    let width = spectrogram.frequency_hz.len();
    let answer = PythonDict::new(py)
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
        .with("findings", findings(&told_of)?)?;
    Ok(answer.dict())
}
