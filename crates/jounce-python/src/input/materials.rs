//! The libraries of materials and of chips.

use crate::conversion::failure::Failure;
use pyo3::prelude::*;

/// Returns every material as JSON, with SI units in the names.
#[pyfunction]
pub fn materials() -> PyResult<String> {
    let materials = serde_json::to_string(jounce::materials());
    Ok(materials.map_err(|error| Failure::new("JounceError", error))?)
}

/// Returns every chip of a regulator as JSON, with SI units in the names.
#[pyfunction]
pub fn chips() -> PyResult<String> {
    let chips = serde_json::to_string(jounce::chips());
    Ok(chips.map_err(|error| Failure::new("JounceError", error))?)
}
