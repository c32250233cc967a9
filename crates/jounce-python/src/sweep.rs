//! Sweeps.

use crate::arrays::PythonDict;
use crate::cancellable::{cancellable, on_threads, to_python_result};
use crate::failure::Failure;
use crate::run::PythonResult;
use crate::spec::Spec;
use jounce_core::analysis::{Sweep, SweepOrder, SweepPoint};
use jounce_core::run::{ExceededLimit, WorstExcess};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Runs the model at every value of a key.
#[pyfunction]
#[expect(
    clippy::too_many_arguments,
    reason = "one argument per option of the Python method, which passes them by name"
)]
pub fn sweep<'py>(
    py: Python<'py>,
    spec: &Spec,
    key: &str,
    values: &str,
    direction: &str,
    fixed_duration: bool,
    tolerance: Option<f64>,
    threads: Option<usize>,
    progress: Option<Bound<'py, PyAny>>,
) -> PythonResult<'py> {
    let tightened = spec.with_tolerance(tolerance)?;
    let spec = tightened.as_ref().unwrap_or(spec);
    let range = spec.range(key, values)?;
    let order = match direction {
        "up" => SweepOrder::Up,
        "down" => SweepOrder::Down,
        "both" => SweepOrder::Both,
        "independent" => SweepOrder::Independent,
        _ => {
            let reason = format!(
                "direction is \"{direction}\"; it must be \"up\", \"down\", \"both\" or \"independent\""
            );
            return Err(Failure::new("ArgumentError", reason).into_exception(py));
        }
    };
    let study = Sweep {
        spec: spec.spec(),
        range: &range,
        direction: order,
        fixed_duration,
        folder: spec.folder(),
    };
    let outcome = cancellable(py, progress.as_ref(), |control| {
        on_threads(threads, || Ok(study.run(None, control, &|_| ())?))
    });
    let options = [
        ("over", format!("{key}={values}")),
        ("direction", direction.to_owned()),
        ("fixed_duration", fixed_duration.to_string()),
    ];
    let manifest = spec.manifest("sweep", &options);
    to_python_result(py, outcome, |points| {
        into_python(py, (key, &range.key().unit(), manifest), &points)
    })
}

fn into_python<'py>(
    py: Python<'py>,
    (key, unit, manifest): (&str, &str, String),
    points: &[SweepPoint],
) -> PyResult<Bound<'py, PyDict>> {
    let dict = PythonDict::new(py)
        .with("key", key)?
        .with("unit", unit)?
        .each("parameter", points, |p| p.parameter)?
        .with(
            "direction",
            points
                .iter()
                .map(|p| p.direction.name())
                .collect::<Vec<_>>(),
        )?
        .each("mean_power_w", points, |p| p.mean_power_w)?
        .each("voltage_rms_v", points, |p| p.voltage_rms_v)?
        .each("max_penetration_m", points, |p| p.max_penetration_m)?
        .each("contact_rate_hz", points, |p| p.contact_rate_hz)?
        .each("settled", points, |p| p.settled)?
        .each("period_cycles", points, |p| i64::from(p.period_cycles))?
        .each("energy_residual_relative", points, |p| {
            p.energy_residual_relative
        })?
        .each("simulated_time_s", points, |p| p.simulated_time_s)?
        .with("warnings", warnings(key, unit, points))?
        .with("manifest", manifest)?;
    Ok(dict.dict())
}

/// Returns warnings about exceeded limits of patches at points.
fn warnings(key: &str, unit: &str, points: &[SweepPoint]) -> Vec<String> {
    let exceeded: Vec<&[ExceededLimit]> = points
        .iter()
        .map(|point| point.exceeded.as_slice())
        .collect();
    WorstExcess::messages(&exceeded, "points", |index| {
        format!("{key} = {:.6} {unit}", points[index].parameter)
    })
}
