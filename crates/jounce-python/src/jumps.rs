//! Bifurcation curves in two keys.

use crate::arrays::PythonDict;
use crate::branch::{checked_levels, checked_seeds, checked_tolerance};
use crate::cancellable::{cancellable, on_threads, to_python_result};
use crate::failure::Failure;
use crate::run::PythonResult;
use crate::spec::Spec;
use jounce_core::analysis::{
    BifurcationCurve, BifurcationCurvePoint, BifurcationSearch, BranchOptions,
};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Continues folds, period doublings, tori, grazings and levels in two keys.
#[pyfunction]
#[expect(
    clippy::too_many_arguments,
    reason = "one argument per option of the Python method, which passes them by name"
)]
pub fn jumps<'py>(
    py: Python<'py>,
    spec: &Spec,
    keys: (String, String),
    over: (String, String),
    against: (String, String),
    tolerance: f64,
    seeds: usize,
    longest_period: u32,
    peaks: bool,
    levels: Vec<String>,
    threads: Option<usize>,
    progress: Option<Bound<'py, PyAny>>,
) -> PythonResult<'py> {
    let (tolerance, seeds) = (checked_tolerance(tolerance)?, checked_seeds(seeds)?);
    if keys.0 == keys.1 {
        return Err(Failure::new(
            "ArgumentError",
            format!("both keys are {}; give two different ones", keys.0),
        )
        .into_exception(py));
    }
    let range_text = |key: &str, (from, to): &(String, String)| format!("{key}={from}:{to}");
    let options = [
        ("over", range_text(&keys.0, &over)),
        ("against", range_text(&keys.1, &against)),
        ("tolerance", tolerance.to_string()),
    ];
    let manifest = spec.manifest("jumps", &options);
    let ((key, range), (key_2, range_2)) = (
        spec.value_range(&keys.0, over)?,
        spec.value_range(&keys.1, against)?,
    );
    let outcome = cancellable(py, progress.as_ref(), |control| {
        let base = spec.model(control)?;
        let search = BifurcationSearch {
            base: &base,
            keys: [&key, &key_2],
            ranges: [range, range_2],
            tolerance,
            seeds,
            longest_period,
            peaks,
        };
        let options = BranchOptions {
            levels: checked_levels(&levels, &base.kernel.plant)?,
            ..BranchOptions::default()
        };
        on_threads(threads, || Ok(search.run_with(&options)?))
    });
    to_python_result(py, outcome, |curves| {
        let curve_dicts = curves
            .iter()
            .map(|curve| curve_dict(py, curve))
            .collect::<PyResult<Vec<_>>>()?;
        let dict = PythonDict::new(py)
            .with("keys", keys)?
            .with("units", (key.unit(), key_2.unit()))?
            .with("curves", curve_dicts)?;
        Ok(dict.with("manifest", manifest)?.dict())
    })
}

/// Stability where it is not computed: on all curves except peaks.
const UNKNOWN: i64 = -1;

fn curve_dict<'py>(py: Python<'py>, curve: &BifurcationCurve) -> PyResult<Bound<'py, PyDict>> {
    let points: &[BifurcationCurvePoint] = &curve.points;
    let dict = PythonDict::new(py)
        .with("kind", curve.kind.name())?
        .with("level", curve.level.clone())?
        .with("period_cycles", curve.period_cycles)?
        .each("parameter", points, |p| p.parameter)?
        .each("parameter_2", points, |p| p.parameter_2)?
        .each("mean_power_w", points, |p| p.mean_power_w)?
        .each("stable", points, |p| p.stable.map_or(UNKNOWN, i64::from))?
        .with("failures", curve.failures.clone())?;
    Ok(dict.dict())
}
