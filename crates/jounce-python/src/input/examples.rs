//! Specs of the examples, included in the module.

use pyo3::prelude::*;

/// System, file and text.
const EXAMPLES: &[(&str, &str, &str)] = include!(concat!(env!("OUT_DIR"), "/examples.rs"));

/// Returns system, file and text of every example.
#[pyfunction]
pub fn examples() -> Vec<(&'static str, &'static str, &'static str)> {
    EXAMPLES.to_vec()
}
