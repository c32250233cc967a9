//! Frequency responses of a hammer or shaker test.

use super::recording::{RecordingInput, issues, recordings};
use crate::conversion::arrays::PythonDict;
use crate::conversion::failure::Failure;
use crate::conversion::flat;
use jounce::{MeasuredFrfOptions, MeasuredFrfResult, Recording};
use numpy::{Complex64, PyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Computes the frequency responses of a hammer or shaker test; `options` are the fields of the
/// options of the library, as JSON.
#[pyfunction]
pub fn measured_frf<'py>(
    py: Python<'py>,
    inputs: Vec<RecordingInput<'py>>,
    options: &str,
) -> PyResult<Bound<'py, PyDict>> {
    let options: MeasuredFrfOptions = flat::options(options)?;
    let recordings = recordings(&inputs)?;
    let result = py
        .detach(|| Recording::measured_frf(&recordings, &options))
        .map_err(|error| Failure::from(error).into_exception(py))?;
    into_python(py, &result)
}

/// Converts responses for Python.
pub fn into_python<'py>(
    py: Python<'py>,
    result: &MeasuredFrfResult,
) -> PyResult<Bound<'py, PyDict>> {
    let (responses, per_g) = (PyDict::new(py), PyDict::new(py));
    for response in &result.responses {
        let value = complex(py, &response.re, &response.im);
        let coherence = PyArray1::from_slice(py, &response.coherence);
        responses.set_item(&response.name, (value, &response.unit, coherence))?;
        if let Some(factor) = &response.per_g {
            per_g.set_item(&response.name, (factor.factor, &factor.unit))?;
        }
    }
    let dict = PythonDict::new(py)
        .array("frequency_hz", result.frequency_hz.clone())?
        .with("responses", responses)?
        .with("input", &result.input)?
        .with("per_g", per_g)?
        .with("output", &result.outputs)?
        .with("reference", &result.references)?
        .with("hits", flat::object(py, &serde_json::json!(result.hits))?)?
        .with("block_s", result.block_s)?
        .with("window_decay_per_s", result.window_decay_per_s)?
        .with("issues", issues(&result.issues)?)?;
    Ok(dict.dict())
}

/// Converts complex numbers to an array.
pub fn complex<'py>(py: Python<'py>, re: &[f64], im: &[f64]) -> Bound<'py, PyArray1<Complex64>> {
    let values = re.iter().zip(im).map(|(re, im)| Complex64::new(*re, *im));
    PyArray1::from_vec(py, values.collect())
}
