//! Sweeps.

use crate::arrays::Answer;
use crate::failure::Failure;
use crate::run::Handed;
use crate::spec::Spec;
use crate::watched::{handed, on_threads, watched};
use jounce::run::{Exceeded, Worst};
use jounce::study::{Direction, Sweep, SweepPoint};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Marches a run at every value of a key.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "one argument per option of the Python method, which calls by name")]
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
) -> Handed<'py> {
    let own = spec.with_tolerance(tolerance)?;
    let spec = own.as_ref().unwrap_or(spec);
    let range = spec.range(key, values)?;
    let order = match direction {
        "up" => Direction::Up,
        "down" => Direction::Down,
        "both" => Direction::Both,
        "independent" => Direction::Independent,
        _ => {
            let why = format!("direction is \"{direction}\"; it must be \"up\", \"down\", \"both\" or \"independent\"");
            return Err(Failure::new("ArgumentError", why).raised(py));
        }
    };
    let study = Sweep { spec: &spec.spec, range: &range, direction: order, fixed_duration, folder: spec.folder() };
    let found = watched(py, progress.as_ref(), |watch| on_threads(threads, || Ok(study.run(None, watch, &|_| ())?)));
    let options =
        [("over", format!("{key}={values}")), ("direction", direction.to_owned()), ("fixed_duration", fixed_duration.to_string())];
    let manifest = spec.manifest("sweep", &options);
    handed(py, found, |points| told(py, (key, &range.key().unit(), manifest), &points))
}

fn told<'py>(py: Python<'py>, (key, unit, manifest): (&str, &str, String), points: &[SweepPoint]) -> PyResult<Bound<'py, PyDict>> {
    let answer = Answer::new(py)
        .with("key", key)?
        .with("unit", unit)?
        .each("parameter", points, |p| p.parameter)?
        .with("direction", points.iter().map(|p| p.direction.name()).collect::<Vec<_>>())?
        .each("mean_power_w", points, |p| p.mean_power_w)?
        .each("voltage_rms_v", points, |p| p.voltage_rms_v)?
        .each("max_penetration_m", points, |p| p.max_penetration_m)?
        .each("contact_rate_hz", points, |p| p.contact_rate_hz)?
        .each("settled", points, |p| p.settled)?
        .each("period_cycles", points, |p| i64::from(p.period_cycles))?
        .each("energy_residual_relative", points, |p| p.energy_residual_relative)?
        .each("marched_s", points, |p| p.marched_s)?
        .with("warnings", warnings(key, unit, points))?
        .with("manifest", manifest)?;
    Ok(answer.dict())
}

/// Limits of patches that points pass.
fn warnings(key: &str, unit: &str, points: &[SweepPoint]) -> Vec<String> {
    let passed: Vec<&[Exceeded]> = points.iter().map(|point| point.exceeded.as_slice()).collect();
    Worst::told(&passed, "points", |place| format!("{key} = {:.6} {unit}", points[place].parameter))
}
