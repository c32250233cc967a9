//! Frequency response functions without contact.

use super::run::PythonResult;
use crate::conversion::arrays::PythonDict;
use crate::conversion::cancellable::{cancellable, to_python_result};
use crate::conversion::flat;
use crate::input::spec::Spec;
use jounce::parts::FrfResponse;
use jounce::{FrfOptions, FrfResult};
use numpy::{Complex64, PyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Computes acceleration of every point and voltage of every patch and circuit per newton on a
/// point; or, for an acceleration of the base, displacement and voltages per m/s^2. `options` are
/// the fields of the options of the library, as JSON.
#[pyfunction]
pub fn frf<'py>(py: Python<'py>, spec: &Spec, options: &str) -> PythonResult<'py> {
    let options: FrfOptions = flat::options(options)?;
    let outcome = cancellable(py, None, |control| {
        Ok(spec.harvester.with_control(control).frf(&options)?)
    });
    let manifest = spec.manifest("frf", &options)?;
    to_python_result(py, outcome, |result| into_python(py, result, manifest))
}

fn into_python(py: Python<'_>, result: FrfResult, manifest: String) -> PyResult<Bound<'_, PyDict>> {
    let responses = PyDict::new(py);
    for FrfResponse { name, re, im, unit } in result.responses {
        let parts = re.into_iter().zip(im);
        let values: Vec<Complex64> = parts.map(|(re, im)| Complex64::new(re, im)).collect();
        responses.set_item(name, (PyArray1::from_vec(py, values), unit))?;
    }
    let dict = PythonDict::new(py)
        .with("input", result.input)?
        .with("held", result.held)?
        .with("responses", responses)?
        .with("manifest", manifest)?;
    Ok(dict.array("frequency_hz", result.frequency_hz)?.dict())
}
