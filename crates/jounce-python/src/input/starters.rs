//! Commented starter specs.

use crate::conversion::failure::Failure;
use pyo3::prelude::*;

/// Returns kind and summary of every starter.
#[pyfunction]
pub fn starters() -> Vec<(&'static str, &'static str)> {
    let starters = jounce::starters().iter();
    starters
        .map(|starter| (starter.kind, starter.summary))
        .collect()
}

/// Returns the text of the starter of a kind.
#[pyfunction]
pub fn starter(kind: &str) -> Result<&'static str, Failure> {
    Ok(jounce::starter(kind)?.spec)
}
