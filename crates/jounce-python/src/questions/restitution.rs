//! Restitution estimated from materials.

use crate::conversion::failure::Failure;
use crate::conversion::flat;
use jounce::RestitutionOptions;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Estimates the coefficient of restitution; `options` are the fields of the options of the library,
/// as JSON.
#[pyfunction]
pub fn restitution<'py>(py: Python<'py>, options: &str) -> PyResult<Bound<'py, PyDict>> {
    let options: RestitutionOptions = flat::options(options)?;
    let result = jounce::restitution(&options);
    let result = result.map_err(|error| Failure::from(error).into_exception(py))?;
    Ok(flat::dict(py, &result)?.dict())
}
