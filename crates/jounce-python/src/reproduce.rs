//! The paper computed again.

use crate::arrays::Answer;
use crate::failure::Failure;
use crate::run::Handed;
use crate::watched::{handed, on_threads, watched};
use jounce::march::Watch;
use jounce::reproduce::{Claim, Reproduction, Written, folders};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::{Path, PathBuf};

/// Computes everything and writes the report into a folder.
#[pyfunction]
pub fn reproduce<'py>(py: Python<'py>, out: PathBuf, threads: Option<usize>, progress: Option<Bound<'py, PyAny>>) -> Handed<'py> {
    let found = watched(py, progress.as_ref(), |watch| on_threads(threads, || written(&out, watch)));
    handed(py, found, |(written, claims)| told(py, &written, &claims))
}

fn written(out: &Path, watch: &Watch) -> Result<(Written, Vec<Claim>), Failure> {
    folders(out)?;
    let simulated = jounce::reproduce::reproduce(watch, &|_| ())?;
    let chapters = jounce_measure::experiment::chapters(&simulated, watch)?;
    let reproduction = chapters.into_iter().fold(simulated, Reproduction::with);
    Ok((reproduction.write(out)?, reproduction.claims))
}

fn told<'py>(py: Python<'py>, written: &Written, claims: &[Claim]) -> PyResult<Bound<'py, PyDict>> {
    let answer = Answer::new(py)
        .with("report", &written.report)?
        .with("tables", &written.tables)?
        .with("figures", &written.figures)?
        .with("claim", claims.iter().map(|claim| claim.claim.clone()).collect::<Vec<_>>())?
        .each("holds", claims, |claim| claim.holds)?
        .with("evidence", claims.iter().map(|claim| claim.evidence.clone()).collect::<Vec<_>>())?;
    Ok(answer.dict())
}
