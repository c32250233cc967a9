//! Design: values of keys with the largest power within limits.

use crate::conversion::cancellable::cancellable;
use crate::conversion::failure::Failure;
use crate::conversion::flat;
use crate::input::spec::Spec;
use jounce::{Control, Design, DesignOptions};
use pyo3::prelude::*;
use std::path::PathBuf;

/// Result of a design as JSON and the best spec, if there is one, and the error that ended it early.
type Designed = PyResult<(Option<(String, Spec)>, Option<PyErr>)>;

/// Searches the best design for the text of a design file in a folder, `None` without a file;
/// `options` are the fields of the options of the library, as JSON.
#[pyfunction]
pub fn design<'py>(
    py: Python<'py>,
    spec: &Spec,
    text: &str,
    folder: Option<PathBuf>,
    options: &str,
    progress: Option<Bound<'py, PyAny>>,
) -> Designed {
    let options: DesignOptions = flat::options(options)?;
    let outcome = cancellable(py, progress.as_ref(), |control| {
        let folder = folder.as_deref().unwrap_or(spec.harvester.folder());
        let design: Design = spec.harvester.design_in(text, folder)?;
        Ok::<_, Failure>(design.with_control(control).run(&options)?)
    });
    match outcome {
        (Ok(result), interruption) => {
            let json = serde_json::to_string(&result)
                .map_err(|error| Failure::new("JounceError", error))?;
            let best = result.harvester.with_control(&Control::default());
            Ok((Some((json, Spec::of(best))), interruption))
        }
        (Err(_), Some(interruption)) => Ok((None, Some(interruption))),
        (Err(failure), None) => Err(failure.into_exception(py)),
    }
}
