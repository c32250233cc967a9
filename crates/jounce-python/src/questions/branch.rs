//! Branches of periodic orbits.

use super::run::PythonResult;
use crate::conversion::cancellable::{cancellable, to_python_result};
use crate::conversion::failure::Failure;
use crate::conversion::flat;
use crate::input::spec::Spec;
use jounce::parts::Branch;
use jounce::{BranchOptions, BranchResult};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Continues every branch over a range of a key; `options` are the fields of the options of the
/// library, as JSON.
#[pyfunction]
pub fn branch<'py>(
    py: Python<'py>,
    spec: &Spec,
    options: &str,
    progress: Option<Bound<'py, PyAny>>,
) -> PythonResult<'py> {
    let options: BranchOptions = flat::options(options)?;
    let outcome = cancellable(py, progress.as_ref(), |control| {
        Ok(spec.harvester.with_control(control).branch(&options)?)
    });
    let manifest = spec.manifest("branch", &options)?;
    to_python_result(py, outcome, |result| into_python(py, result, manifest))
}

fn into_python(
    py: Python<'_>,
    mut result: BranchResult,
    manifest: String,
) -> PyResult<Bound<'_, PyDict>> {
    let (warnings, branches) = (result.warnings(), std::mem::take(&mut result.branches));
    let dict = flat::dict(py, &result)?
        .with("branches", branch_dicts(py, &branches)?)?
        .with("warnings", warnings)?
        .with("manifest", manifest)?;
    Ok(dict.dict())
}

/// Converts branches to dictionaries with an array for each quantity of their points.
pub fn branch_dicts<'py>(
    py: Python<'py>,
    branches: &[Branch],
) -> PyResult<Vec<Bound<'py, PyDict>>> {
    branches
        .iter()
        .map(|branch| Ok(flat::dict_with_main(py, branch, "points")?.dict()))
        .collect()
}

/// Formats a value as JSON.
pub fn json(value: &impl serde::Serialize) -> PyResult<String> {
    Ok(serde_json::to_string(value).map_err(|error| Failure::new("JounceError", error))?)
}
