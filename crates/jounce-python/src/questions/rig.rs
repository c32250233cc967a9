//! Virtual test: simulated sensor recordings of a harvester.

use super::run::PythonResult;
use crate::conversion::cancellable::{cancellable, to_python_result};
use crate::conversion::flat;
use crate::input::spec::Spec;
use crate::measured::recording::{RecordingInput, into_python};
use jounce::RigOptions;
use pyo3::prelude::*;

/// Simulates the sensor recordings of a test; `options` are the fields of the options of the
/// library, as JSON, `base` is a recording that moves the base.
#[pyfunction]
pub fn rig<'py>(
    py: Python<'py>,
    spec: &Spec,
    options: &str,
    base: Option<RecordingInput<'py>>,
) -> PythonResult<'py> {
    let options = RigOptions {
        base: base.map(|base| base.recording()).transpose()?,
        ..flat::options(options)?
    };
    let outcome = cancellable(py, None, |control| {
        Ok(spec.harvester.with_control(control).rig(&options)?)
    });
    to_python_result(py, outcome, |result| into_python(py, result.recording))
}
