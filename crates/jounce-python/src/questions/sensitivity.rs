//! Derivatives of the results of an orbit with respect to keys.

use crate::conversion::cancellable::cancellable;
use crate::conversion::failure::Failure;
use crate::conversion::flat;
use crate::input::spec::Spec;
use jounce::SensitivityOptions;
use pyo3::prelude::*;

/// Result as JSON, if there is one, and the error that ended the call early.
type Json = PyResult<(Option<String>, Option<PyErr>)>;

/// Computes the derivatives; `options` are the fields of the options of the library, as JSON.
#[pyfunction]
pub fn sensitivity<'py>(
    py: Python<'py>,
    spec: &Spec,
    options: &str,
    progress: Option<Bound<'py, PyAny>>,
) -> Json {
    let options: SensitivityOptions = flat::options(options)?;
    let outcome = cancellable(py, progress.as_ref(), |control| {
        Ok::<_, Failure>(spec.harvester.with_control(control).sensitivity(&options)?)
    });
    match outcome {
        (Ok(result), interruption) => {
            let json = serde_json::to_string(&result)
                .map_err(|error| Failure::new("JounceError", error))?;
            Ok((Some(json), interruption))
        }
        (Err(_), Some(interruption)) => Ok((None, Some(interruption))),
        (Err(failure), None) => Err(failure.into_exception(py)),
    }
}
