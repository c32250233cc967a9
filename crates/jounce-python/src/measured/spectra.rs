//! Spectra of a recorded channel.

use super::recording::{RecordingInput, issues};
use crate::conversion::cancellable::{detached, to_python_result};
use crate::conversion::flat;
use crate::questions::run::PythonResult;
use jounce::{SpectraOptions, SpectraResult};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Computes power spectral density, spectrogram and order lines of a channel; `options` are the
/// fields of the options of the library, as JSON.
#[pyfunction]
pub fn spectra<'py>(
    py: Python<'py>,
    input: RecordingInput<'py>,
    options: &str,
) -> PythonResult<'py> {
    let recording = input.recording()?;
    let options = SpectraOptions {
        spectrogram: true,
        ..flat::options(options)?
    };
    let outcome = detached(py, move |control| {
        Ok(recording.with_control(control).spectra(&options)?)
    });
    to_python_result(py, outcome, |result| into_python(py, result))
}

fn into_python(py: Python<'_>, result: SpectraResult) -> PyResult<Bound<'_, PyDict>> {
    let dict = flat::dict(py, &result)?.with("issues", issues(&result.issues)?)?;
    let dict = match result.spectrogram {
        None => dict,
        Some(spectrogram) => {
            let width = spectrogram.frequency_hz.len();
            dict.array("time_s", spectrogram.time_s)?.rows(
                "amplitude_peak",
                &spectrogram.amplitude_peak,
                width,
            )?
        }
    };
    Ok(dict.dict())
}
