//! Attractors and how likely each is.

use super::run::PythonResult;
use crate::conversion::cancellable::{cancellable, to_python_result};
use crate::conversion::flat;
use crate::input::spec::Spec;
use jounce::parts::StartPoint;
use jounce::{BasinsOptions, BasinsResult};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Number of the attractor of a start without one.
const NONE: i64 = -1;

/// Integrates a cloud or a grid of starts until the attractor of each is recognised; `options` are
/// the fields of the options of the library, as JSON.
#[pyfunction]
pub fn basins<'py>(
    py: Python<'py>,
    spec: &Spec,
    options: &str,
    progress: Option<Bound<'py, PyAny>>,
) -> PythonResult<'py> {
    let options: BasinsOptions = flat::options(options)?;
    let outcome = cancellable(py, progress.as_ref(), |control| {
        Ok(spec.harvester.with_control(control).basins(&options)?)
    });
    let manifest = spec.manifest("basins", &options)?;
    to_python_result(py, outcome, |result| into_python(py, &result, manifest))
}

fn into_python<'py>(
    py: Python<'py>,
    result: &BasinsResult,
    manifest: String,
) -> PyResult<Bound<'py, PyDict>> {
    let points: &[StartPoint] = &result.points;
    let number = |point: &StartPoint| point.attractor.map_or(NONE, |number| number as i64);
    let dict = flat::dict_with_main(py, result, "attractors")?
        .with("warnings", result.warnings())?
        .each("attractor_index", points, number)?
        .each("start_displacement_m", points, |point| point.displacement_m)?
        .each("start_velocity_m_s", points, |point| point.velocity_m_s)?
        .each("start_voltage_v", points, |point| point.voltage_v)?
        .with("manifest", manifest)?;
    Ok(dict.dict())
}
