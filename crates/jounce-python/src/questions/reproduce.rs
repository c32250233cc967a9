//! Reproduction of the paper.

use super::run::PythonResult;
use crate::conversion::cancellable::{cancellable, to_python_result};
use crate::conversion::flat;
use jounce::ReproduceOptions;
use pyo3::prelude::*;

/// Computes everything and writes the report into a folder; `options` are the fields of the options
/// of the library, as JSON.
#[pyfunction]
pub fn reproduce<'py>(
    py: Python<'py>,
    options: &str,
    progress: Option<Bound<'py, PyAny>>,
) -> PythonResult<'py> {
    let options: ReproduceOptions = flat::options(options)?;
    let outcome = cancellable(py, progress.as_ref(), |control| {
        Ok(jounce::reproduce(&options, control, &|_| ())?)
    });
    to_python_result(py, outcome, |result| {
        Ok(flat::dict_with_main(py, &result, "claims")?.dict())
    })
}
