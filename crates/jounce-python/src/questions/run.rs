//! One run.

use crate::conversion::cancellable::{on_this_thread, to_python_result};
use crate::conversion::failure::Failure;
use crate::conversion::{flat, history};
use crate::input::spec::Spec;
use jounce::{RunOptions, RunResult, StartState};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Result of a long call, if there is one, and the error that ended it early.
pub type PythonResult<'py> = PyResult<(Option<Bound<'py, PyDict>>, Option<PyErr>)>;

/// Integrates one run; `options` are the fields of the options of the library, `start` is a state,
/// both as JSON.
#[pyfunction]
pub fn run<'py>(
    py: Python<'py>,
    spec: &Spec,
    options: &str,
    start: Option<&str>,
    progress: Option<Bound<'py, PyAny>>,
) -> PythonResult<'py> {
    let start = start.map(serde_json::from_str::<StartState>).transpose();
    let start = start.map_err(|error| Failure::new("StartError", format!("the start state is not one that a run has saved: {error}; give the `end` of another run")))?;
    let options = RunOptions {
        start,
        ..flat::options(options)?
    };
    let outcome = on_this_thread(py, progress.as_ref(), |control| {
        Ok(spec.harvester.with_control(control).run(&options)?)
    });
    let manifest = spec.manifest("run", &options)?;
    to_python_result(py, outcome, |result| into_python(py, result, manifest))
}

fn into_python(
    py: Python<'_>,
    mut result: RunResult,
    manifest: String,
) -> PyResult<Bound<'_, PyDict>> {
    let history = result.history.take();
    let end =
        serde_json::to_string(&result.end).map_err(|error| Failure::new("JounceError", error))?;
    let warnings: Vec<String> = result
        .warnings
        .drain(..)
        .map(|one| one.to_string())
        .collect();
    let dict = flat::dict(py, &result)?
        .with("warnings", warnings)?
        .with("end", end)?
        .with(
            "history",
            history
                .map(|history| history::dict(py, history))
                .transpose()?,
        )?
        .with("manifest", manifest)?;
    Ok(dict.dict())
}
