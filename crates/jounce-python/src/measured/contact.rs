//! Force pulses of a hammer and the contact laws fitted to them.

use super::recording::{RecordingInput, issues};
use crate::conversion::failure::Failure;
use crate::conversion::flat;
use crate::questions::branch::json;
use jounce::ContactOptions;
use jounce::parts::PulseFigure;
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Returns every hit of a record with its fitted law, or the reason why no law could be fitted;
/// `options` are the fields of the options of the library, as JSON.
#[pyfunction]
pub fn contact<'py>(
    py: Python<'py>,
    recording: RecordingInput<'py>,
    options: &str,
) -> PyResult<Bound<'py, PyDict>> {
    let recording = recording.recording()?;
    let options: ContactOptions = flat::options(options)?;
    let result = py
        .detach(|| recording.contact(&options))
        .map_err(|error| Failure::from(error).into_exception(py))?;
    let row = |values: &[f64]| PyArray1::from_slice(py, values);
    let pulse = |pulse: &PulseFigure| {
        let (time_s, force_n) = &pulse.law;
        (
            row(&pulse.time_s),
            row(&pulse.force_n),
            row(time_s),
            row(force_n),
        )
    };
    let warnings: Vec<_> = result.hits.iter().map(|hit| &hit.warnings).collect();
    let dict = flat::dict_with_main(py, &result, "hits")?
        .with("warnings", json(&warnings)?)?
        .with(
            "pulses",
            result.pulses.iter().map(pulse).collect::<Vec<_>>(),
        )?
        .with("issues", issues(&result.issues)?)?;
    Ok(dict.dict())
}
