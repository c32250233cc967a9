//! Commented templates of specs.

use crate::failure::Failure;
use jounce_core::starter::{STARTERS, Starter};
use pyo3::prelude::*;

/// Returns kind and summary of every template.
#[pyfunction]
pub fn starters() -> Vec<(&'static str, &'static str)> {
    STARTERS
        .iter()
        .map(|starter| (starter.kind, starter.summary))
        .collect()
}

/// Returns the text of the template of a kind.
#[pyfunction]
pub fn starter(kind: &str) -> Result<&'static str, Failure> {
    Ok(Starter::of(kind)?.spec)
}
