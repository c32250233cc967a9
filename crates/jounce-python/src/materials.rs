//! The library of materials.

use crate::failure::Failure;
use jounce_core::material::LIBRARY;
use pyo3::prelude::*;

/// Returns every material as JSON, with SI units in the names.
#[pyfunction]
pub fn materials() -> PyResult<String> {
    Ok(serde_json::to_string(LIBRARY).map_err(|error| Failure::new("JounceError", error))?)
}
