//! Sweeps.

use super::run::PythonResult;
use crate::conversion::cancellable::{cancellable, to_python_result};
use crate::conversion::flat;
use crate::input::spec::Spec;
use jounce::SweepOptions;
use pyo3::prelude::*;

/// Runs the model at every value of a key; `options` are the fields of the options of the library,
/// as JSON.
#[pyfunction]
pub fn sweep<'py>(
    py: Python<'py>,
    spec: &Spec,
    options: &str,
    progress: Option<Bound<'py, PyAny>>,
) -> PythonResult<'py> {
    let options: SweepOptions = flat::options(options)?;
    let outcome = cancellable(py, progress.as_ref(), |control| {
        Ok(spec.harvester.with_control(control).sweep(&options)?)
    });
    let manifest = spec.manifest("sweep", &options)?;
    to_python_result(py, outcome, |result| {
        let dict = flat::dict_with_main(py, &result, "points")?
            .with("warnings", result.warnings())?
            .with("manifest", manifest)?;
        Ok(dict.dict())
    })
}
