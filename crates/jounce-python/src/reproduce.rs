//! Reproduction of the paper.

use crate::arrays::PythonDict;
use crate::cancellable::{cancellable, on_threads, to_python_result};
use crate::failure::Failure;
use crate::run::PythonResult;
use jounce_core::integrate::Control;
use jounce_core::reproduce::{Claim, Reproduction, Written, folders};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::{Path, PathBuf};

/// Computes everything and writes the report into a folder.
#[pyfunction]
pub fn reproduce<'py>(
    py: Python<'py>,
    out: PathBuf,
    threads: Option<usize>,
    progress: Option<Bound<'py, PyAny>>,
) -> PythonResult<'py> {
    let outcome = cancellable(py, progress.as_ref(), |control| {
        on_threads(threads, || write_report(&out, control))
    });
    to_python_result(py, outcome, |(files, claims)| {
        into_python(py, &files, &claims)
    })
}

fn write_report(out: &Path, control: &Control) -> Result<(Written, Vec<Claim>), Failure> {
    folders(out)?;
    let simulated = jounce_core::reproduce::reproduce(control, &|_| ())?;
    let chapters = jounce_measure::experiment::chapters(&simulated, control)?;
    let reproduction = chapters.into_iter().fold(simulated, Reproduction::with);
    Ok((reproduction.write(out)?, reproduction.claims))
}

fn into_python<'py>(
    py: Python<'py>,
    files: &Written,
    claims: &[Claim],
) -> PyResult<Bound<'py, PyDict>> {
    let dict = PythonDict::new(py)
        .with("report", &files.report)?
        .with("tables", &files.tables)?
        .with("figures", &files.figures)?
        .with(
            "claim",
            claims
                .iter()
                .map(|claim| claim.claim.clone())
                .collect::<Vec<_>>(),
        )?
        .each("holds", claims, |claim| claim.holds)?
        .with(
            "evidence",
            claims
                .iter()
                .map(|claim| claim.evidence.clone())
                .collect::<Vec<_>>(),
        )?;
    Ok(dict.dict())
}
