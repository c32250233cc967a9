//! Segmentation of a long record into steady-state responses.

use super::recording::{RecordingInput, issues};
use crate::conversion::cancellable::{cancellable, to_python_result};
use crate::conversion::flat;
use crate::input::spec::Spec;
use crate::questions::branch::json;
use crate::questions::run::PythonResult;
use jounce::{SegmentsOptions, SegmentsResult};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Cuts a record into segments of one attractor each, and matches them with those of a model;
/// `options` are the fields of the options of the library, as JSON.
#[pyfunction]
pub fn segments<'py>(
    py: Python<'py>,
    recording: RecordingInput<'py>,
    options: &str,
    model: Option<&Spec>,
) -> PythonResult<'py> {
    let recording = recording.recording()?;
    let options: SegmentsOptions = flat::options(options)?;
    let outcome = cancellable(py, None, move |control| {
        let model = model.map(|model| &model.harvester);
        Ok(recording.with_control(control).segments(model, &options)?)
    });
    to_python_result(py, outcome, |result| into_python(py, result))
}

fn into_python(py: Python<'_>, result: SegmentsResult) -> PyResult<Bound<'_, PyDict>> {
    let candidates: Vec<_> = result.segments.iter().map(|one| &one.candidates).collect();
    let dict = flat::dict_with_main(py, &result, "segments")?
        .with("candidates", json(&candidates)?)?
        .with("issues", issues(&result.issues)?)?
        .array("time_s", result.time_s)?
        .array("values", result.values)?;
    Ok(dict.dict())
}
