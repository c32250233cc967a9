//! Publications behind a spec.

use crate::conversion::failure::Failure;
use crate::input::spec::Spec;
use pyo3::prelude::*;

/// Lists the publications behind a spec, as JSON, with the origin of the list as JSON.
#[pyfunction]
pub fn cite(spec: &Spec) -> PyResult<(String, String)> {
    let citations = serde_json::to_string(&spec.harvester.cite());
    let citations = citations.map_err(|error| Failure::new("JounceError", error))?;
    Ok((citations, spec.manifest("cite", &())?))
}
