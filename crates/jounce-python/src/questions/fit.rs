//! Fit of keys of a spec to measured features.

use crate::conversion::cancellable::cancellable;
use crate::conversion::failure::Failure;
use crate::input::spec::Spec;
use jounce::Features;
use jounce::parts::FitError;
use pyo3::prelude::*;
use std::path::PathBuf;

/// Result of a fit as JSON and the fitted spec, if there is one, and the error that ended it early.
type Fitted = PyResult<(Option<(String, Spec)>, Option<PyErr>)>;

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
    let outcome = cancellable(py, progress.as_ref(), |control| {
        let features = match &path {
            Some(path) => Features::read(path),
            None => Features::from_toml(text.unwrap_or_default())
                .map_err(|faults| FitError::Features { faults }),
        };
        let features = features.map_err(jounce::Error::from)?;
        Ok::<_, Failure>(spec.harvester.with_control(control).fit(&features)?)
    });
    match outcome {
        (Ok(result), interruption) => {
            let json = serde_json::to_string(&result)
                .map_err(|error| Failure::new("JounceError", error))?;
            let fitted = result.fitted.with_control(&jounce::Control::default());
            Ok((Some((json, Spec::of(fitted))), interruption))
        }
        (Err(_), Some(interruption)) => Ok((None, Some(interruption))),
        (Err(failure), None) => Err(failure.into_exception(py)),
    }
}
