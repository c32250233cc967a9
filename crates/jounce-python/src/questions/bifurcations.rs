//! Bifurcation curves in two keys.

use super::run::PythonResult;
use crate::conversion::cancellable::{cancellable, to_python_result};
use crate::conversion::flat;
use crate::input::spec::Spec;
use jounce::parts::BifurcationCurve;
use jounce::{BifurcationsOptions, BifurcationsResult};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Stability where it is not computed: on all curves except peaks.
const UNKNOWN: i64 = -1;

/// Continues folds, period doublings, tori, grazings, levels and peaks in two keys; `options` are
/// the fields of the options of the library, as JSON.
#[pyfunction]
pub fn bifurcations<'py>(
    py: Python<'py>,
    spec: &Spec,
    options: &str,
    progress: Option<Bound<'py, PyAny>>,
) -> PythonResult<'py> {
    let options: BifurcationsOptions = flat::options(options)?;
    let outcome = cancellable(py, progress.as_ref(), |control| {
        Ok(spec
            .harvester
            .with_control(control)
            .bifurcations(&options)?)
    });
    let manifest = spec.manifest("bifurcations", &options)?;
    to_python_result(py, outcome, |result| into_python(py, result, manifest))
}

fn into_python(
    py: Python<'_>,
    mut result: BifurcationsResult,
    manifest: String,
) -> PyResult<Bound<'_, PyDict>> {
    let (warnings, curves) = (result.warnings(), std::mem::take(&mut result.curves));
    let curves = curves.iter().map(|curve| curve_dict(py, curve));
    let dict = flat::dict(py, &result)?
        .with("curves", curves.collect::<PyResult<Vec<_>>>()?)?
        .with("warnings", warnings)?
        .with("manifest", manifest)?;
    Ok(dict.dict())
}

fn curve_dict<'py>(py: Python<'py>, curve: &BifurcationCurve) -> PyResult<Bound<'py, PyDict>> {
    let dict = flat::dict_with_main(py, curve, "points")?
        .each("stable", &curve.points, |point| {
            point.stable.map_or(UNKNOWN, i64::from)
        })?
        .with("failures", curve.failures.clone())?;
    Ok(dict.dict())
}
