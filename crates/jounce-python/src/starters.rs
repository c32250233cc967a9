//! Commented specs to start from.

use crate::failure::Failure;
use jounce::starter::{STARTERS, Starter};
use pyo3::prelude::*;

/// Kind and summary of every starter.
#[pyfunction]
pub fn starters() -> Vec<(&'static str, &'static str)> {
    STARTERS
        .iter()
        .map(|starter| (starter.kind, starter.summary))
        .collect()
}

/// The text of the starter of a kind.
#[pyfunction]
pub fn starter(kind: &str) -> Result<&'static str, Failure> {
    Ok(Starter::of(kind)?.spec)
}
