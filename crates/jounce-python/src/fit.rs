//! Keys of a spec fitted to what was measured.

use crate::branch::json;
use crate::failure::Failure;
use crate::spec::Spec;
use jounce_measure::fit::{Features, FitError};
use pyo3::prelude::*;
use std::path::PathBuf;

/// Fits the free keys that a text of features names, or a file of that text; the answer as JSON.
#[pyfunction]
#[pyo3(signature = (spec, *, text = None, path = None))]
pub fn fit(py: Python<'_>, spec: &Spec, text: Option<&str>, path: Option<PathBuf>) -> PyResult<String> {
    let found = py.detach(|| {
        let features = match &path {
            Some(path) => Features::read(path)?,
            None => Features::from_toml(text.unwrap_or_default()).map_err(|faults| FitError::Features { faults })?,
        };
        Ok::<_, Failure>(jounce_measure::fit::fit(&spec.file(), &spec.spec, &features, &spec.folder(), &|| ())?.0)
    });
    json(&found.map_err(|failure| failure.raised(py))?)
}
