//! Fit of keys of a spec to measured features.

use crate::branch::json;
use crate::cancellable::cancellable;
use crate::failure::Failure;
use crate::spec::Spec;
use jounce_core::integrate::Control;
use jounce_measure::fit::{Features, FitError, FitResult};
use pyo3::prelude::*;
use std::path::PathBuf;

/// Result of a fit as JSON, if there is one, and the error that ended it early.
type Fitted = PyResult<(Option<String>, Option<PyErr>)>;

/// Fits the free keys of a text of features, or of a file with that text.
#[pyfunction]
#[pyo3(signature = (spec, *, text = None, path = None, progress = None))]
pub fn fit<'py>(
    py: Python<'py>,
    spec: &Spec,
    text: Option<&str>,
    path: Option<PathBuf>,
    progress: Option<Bound<'py, PyAny>>,
) -> Fitted {
    match cancellable(py, progress.as_ref(), |control| {
        fitted(spec, text, path, control)
    }) {
        (Ok(result), interruption) => Ok((Some(json(&result)?), interruption)),
        (Err(_), Some(interruption)) => Ok((None, Some(interruption))),
        (Err(failure), None) => Err(failure.into_exception(py)),
    }
}

fn fitted(
    spec: &Spec,
    text: Option<&str>,
    path: Option<PathBuf>,
    control: &Control,
) -> Result<FitResult, Failure> {
    let features = match &path {
        Some(path) => Features::read(path)?,
        None => Features::from_toml(text.unwrap_or_default())
            .map_err(|faults| FitError::Features { faults })?,
    };
    Ok(jounce_measure::fit::fit(
        &spec.file(),
        spec.spec(),
        &features,
        &spec.folder(),
        control,
    )?
    .0)
}
