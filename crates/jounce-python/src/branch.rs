//! Branches of periodic orbits.

use crate::arrays::PythonDict;
use crate::cancellable::{cancellable, on_threads, to_python_result};
use crate::failure::Failure;
use crate::run::PythonResult;
use crate::spec::Spec;
use jounce_core::analysis::{
    AnalysisError, Bandwidth, BandwidthSearch, Bifurcation, Branch, BranchPoint, Model, Parameter,
};
use jounce_core::analysis::{BranchOptions, BranchSearch, OrbitMethodKind, QuantityLevel};
use jounce_core::plant::Plant;
use jounce_core::run::{ExceededLimit, Limits, WorstExcess};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Number of harmonics at the start of harmonic balance.
const HARMONICS: usize = 64;

/// Returns the method of computing orbits by its name.
fn method_of(name: &str, harmonics: Option<usize>) -> Result<OrbitMethodKind, Failure> {
    if let Some(harmonics) = harmonics.filter(|harmonics| !(4..=2048).contains(harmonics)) {
        let details = serde_json::json!({ "harmonics": harmonics, "least": 4, "most": 2048 });
        return Err(Failure::new(
            "ArgumentError",
            format!("harmonics is {harmonics}; it must be from 4 to 2048"),
        )
        .with(details));
    }
    match (name, harmonics) {
        ("shooting", None) => Ok(OrbitMethodKind::Shooting),
        ("shooting", Some(harmonics)) => {
            let reason = format!(
                "harmonics is {harmonics}; shooting has no harmonics: give method=\"harmonic-balance\" or leave harmonics out"
            );
            Err(Failure::new("ArgumentError", reason)
                .with(serde_json::json!({ "harmonics": harmonics, "method": name })))
        }
        ("harmonic-balance", harmonics) => Ok(OrbitMethodKind::HarmonicBalance {
            harmonics: harmonics.unwrap_or(HARMONICS),
        }),
        _ => Err(Failure::new(
            "ArgumentError",
            format!("method is \"{name}\"; it must be \"shooting\" or \"harmonic-balance\""),
        )),
    }
}

/// Checks a tolerance for orbits.
pub fn checked_tolerance(tolerance: f64) -> Result<f64, Failure> {
    let fits = (1e-14..1e-2).contains(&tolerance);
    if fits {
        Ok(tolerance)
    } else {
        let details = serde_json::json!({ "tolerance": tolerance, "least": 1e-14, "most": 0.01 });
        Err(Failure::new(
            "ArgumentError",
            format!("tolerance is {tolerance}; it must be from 1e-14 to 0.01"),
        )
        .with(details))
    }
}

/// Maximum number of values at which orbits are sought by integration.
const MAX_SEEDS: usize = 100_000;

/// Checks a number of seeds.
pub fn checked_seeds(seeds: usize) -> Result<usize, Failure> {
    if seeds <= MAX_SEEDS {
        return Ok(seeds);
    }
    let details = serde_json::json!({ "seeds": seeds, "least": 0, "most": MAX_SEEDS });
    Err(Failure::new(
        "ArgumentError",
        format!("seeds is {seeds}; it must be at most {MAX_SEEDS}"),
    )
    .with(details))
}

/// Reads levels of quantities of an orbit.
pub fn checked_levels(levels: &[String], plant: &Plant) -> Result<Vec<QuantityLevel>, Failure> {
    let read = |text: &String| {
        QuantityLevel::parse(text, plant)
            .map_err(|reason| Failure::new("ArgumentError", format!("levels: {reason}")))
    };
    levels.iter().map(read).collect()
}

fn checked_step(largest_step: f64) -> Result<f64, Failure> {
    if (1e-3..=1.0).contains(&largest_step) {
        return Ok(largest_step);
    }
    let details = serde_json::json!({ "largest_step": largest_step, "least": 1e-3, "most": 1.0 });
    Err(Failure::new(
        "ArgumentError",
        format!("largest_step is {largest_step}; it must be from 0.001 to 1"),
    )
    .with(details))
}

/// Continues every branch over a range of a key.
#[pyfunction]
#[expect(
    clippy::too_many_arguments,
    reason = "one argument per option of the Python method, which passes them by name"
)]
pub fn branch<'py>(
    py: Python<'py>,
    spec: &Spec,
    key: &str,
    range: (String, String),
    method: &str,
    harmonics: Option<usize>,
    tolerance: f64,
    seeds: usize,
    longest_period: u32,
    levels: Vec<String>,
    step_and_budget: (f64, usize),
    threads: Option<usize>,
    progress: Option<Bound<'py, PyAny>>,
) -> PythonResult<'py> {
    let (method_kind, tolerance, seeds) = (
        method_of(method, harmonics)?,
        checked_tolerance(tolerance)?,
        checked_seeds(seeds)?,
    );
    let range_text = format!("{key}={}:{}", range.0, range.1);
    let (numeric_key, range) = spec.value_range(key, range)?;
    let outcome = cancellable(py, progress.as_ref(), |control| {
        let base = spec.model(control)?;
        let parameter = Parameter::new(&base, &numeric_key, range.1 - range.0);
        let search = BranchSearch {
            base: &base,
            parameter: &parameter,
            range,
            method: method_kind,
            tolerance,
            seeds,
            longest_period,
        };
        let levels = checked_levels(&levels, &base.kernel.plant)?;
        let options = BranchOptions {
            levels,
            largest_step: checked_step(step_and_budget.0)?,
            budget: step_and_budget.1,
        };
        let width = BandwidthSearch {
            base: &base,
            parameter: &parameter,
            range,
            tolerance,
        };
        on_threads(threads, || {
            let branches = search.run_with(&options)?;
            let warnings = match warnings(&base, &parameter, &branches, tolerance) {
                // The branches found so far are returned without their warnings.
                Err(_) if control.is_stopped() => Vec::new(),
                warnings => warnings?,
            };
            Ok((width.run(&branches), branches, warnings))
        })
    });
    let options = [
        ("over", range_text),
        ("method", method.to_owned()),
        ("tolerance", tolerance.to_string()),
        ("seeds", seeds.to_string()),
    ];
    let manifest = spec.manifest("branch", &options);
    to_python_result(py, outcome, |(widths, branches, warnings)| {
        let branches_with_widths = branches.iter().zip(&widths.branches);
        let branch_dicts = branches_with_widths
            .map(|(branch, width)| branch_dict(py, branch, width.as_ref()))
            .collect::<PyResult<Vec<_>>>()?;
        let dict = PythonDict::new(py)
            .with("key", key)?
            .with("unit", numeric_key.unit())?
            .with("branches", branch_dicts)?;
        let dict = dict
            .with("warnings", warnings)?
            .with("half_power", json(&widths.together.as_ref())?)?;
        Ok(dict.with("manifest", manifest)?.dict())
    })
}

/// Returns warnings about exceeded limits of patches at points of branches.
fn warnings(
    base: &Model,
    parameter: &Parameter<'_>,
    branches: &[Branch],
    tolerance: f64,
) -> Result<Vec<String>, Failure> {
    let limits = Limits::of(&base.spec, &base.kernel.plant);
    let exceeded = branches
        .iter()
        .map(|branch| branch.exceeded(parameter, &limits, tolerance))
        .collect::<Result<Vec<_>, AnalysisError>>()?;
    let all_exceeded: Vec<&[ExceededLimit]> =
        exceeded.iter().flatten().map(Vec::as_slice).collect();
    let values: Vec<f64> = branches
        .iter()
        .flat_map(|branch| &branch.points)
        .map(|point| point.parameter)
        .collect();
    let (path, unit) = (parameter.key().path(), parameter.key().unit());
    Ok(WorstExcess::messages(&all_exceeded, "points", |index| {
        format!("{path} = {:.6} {unit}", values[index])
    }))
}

/// Formats a value as JSON.
pub fn json(value: &impl serde::Serialize) -> PyResult<String> {
    Ok(serde_json::to_string(value).map_err(|error| Failure::new("JounceError", error))?)
}

/// Converts one branch to a dictionary.
pub fn branch_dict<'py>(
    py: Python<'py>,
    branch: &Branch,
    width: Option<&Bandwidth>,
) -> PyResult<Bound<'py, PyDict>> {
    let points: &[BranchPoint] = &branch.points;
    let bifurcations: &[Bifurcation] = &branch.bifurcations;
    let dict = PythonDict::new(py)
        .with("period_cycles", branch.period_cycles)?
        .each("parameter", points, |p| p.parameter)?
        .each("mean_power_w", points, |p| p.orbit.mean_power_w)?
        .each("voltage_rms_v", points, |p| p.orbit.voltage_rms_v)?
        .each("stable", points, |p| p.orbit.is_stable())?
        .each("stability_undecided", points, |p| {
            p.orbit.is_stability_undecided()
        })?
        .each("floquet_max_abs", points, |p| p.orbit.floquet_max_abs())?
        .each("contacts_per_period", points, |p| p.orbit.contacts as i64)?
        .each("max_penetration_m", points, |p| p.orbit.max_penetration_m)?
        .each("displacement_peak_m", points, |p| {
            p.orbit.displacement_peak_m
        })?
        .each("error_estimate", points, |p| p.orbit.error_estimate)?
        .with(
            "bifurcation_kind",
            bifurcations
                .iter()
                .map(|bifurcation| bifurcation.kind.name())
                .collect::<Vec<_>>(),
        )?
        .with(
            "bifurcation_name",
            bifurcations
                .iter()
                .map(|bifurcation| bifurcation.level.clone().or(bifurcation.stop.clone()))
                .collect::<Vec<_>>(),
        )?
        .each("bifurcation_parameter", bifurcations, |bifurcation| {
            bifurcation.at.parameter
        })?
        .each("bifurcation_power_w", bifurcations, |bifurcation| {
            bifurcation.at.orbit.mean_power_w
        })?
        .each(
            "bifurcation_displacement_peak_m",
            bifurcations,
            |bifurcation| bifurcation.at.orbit.displacement_peak_m,
        )?
        .with("not_proved", json(&branch.not_proved)?)?
        .with("not_followed", branch.not_followed)?
        .with("endings", json(&branch.endings)?)?
        .with("half_power", json(&width)?)?;
    Ok(dict.dict())
}
