//! Bifurcation diagrams.

use super::branch::branch_dicts;
use super::run::PythonResult;
use crate::conversion::cancellable::{cancellable, to_python_result};
use crate::conversion::flat;
use crate::input::spec::Spec;
use jounce::parts::SectionPoint;
use jounce::{DiagramOptions, DiagramResult};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Computes the state at the start of each drive cycle, over a key; `options` are the fields of the
/// options of the library, as JSON.
#[pyfunction]
pub fn diagram<'py>(
    py: Python<'py>,
    spec: &Spec,
    options: &str,
    progress: Option<Bound<'py, PyAny>>,
) -> PythonResult<'py> {
    let options: DiagramOptions = flat::options(options)?;
    let outcome = cancellable(py, progress.as_ref(), |control| {
        Ok(spec.harvester.with_control(control).diagram(&options)?)
    });
    let manifest = spec.manifest("diagram", &options)?;
    to_python_result(py, outcome, |result| into_python(py, &result, manifest))
}

fn into_python<'py>(
    py: Python<'py>,
    result: &DiagramResult,
    manifest: String,
) -> PyResult<Bound<'py, PyDict>> {
    let points = result.points.iter().enumerate();
    let section: Vec<(i64, &SectionPoint)> = points
        .flat_map(|(run, point)| point.section.iter().map(move |point| (run as i64, point)))
        .collect();
    let dict = flat::dict_with_main(py, result, "points")?
        .each("section_point", &section, |(run, _)| *run)?
        .each("section_displacement_m", &section, |(_, point)| {
            point.displacement_m
        })?
        .each("section_velocity_m_s", &section, |(_, point)| {
            point.velocity_m_s
        })?
        .each("section_voltage_v", &section, |(_, point)| point.voltage_v)?
        .with("branches", branch_dicts(py, &result.branches)?)?
        .with("warnings", result.warnings())?
        .with("manifest", manifest)?;
    Ok(dict.dict())
}
