//! One run.

use crate::arrays::Answer;
use crate::failure::Failure;
use crate::history::History;
use crate::spec::Spec;
use crate::watched::{handed, watched};
use jounce::march::{Kernel, Trajectory, Watch};
use jounce::material::named;
use jounce::run::{RunAnswer, RunPlan, Settlement, StartState, exceeded, simulate};
use jounce::spec::Patch;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// What a call answers: the answer, if there is one, and what ended it early.
pub type Handed<'py> = PyResult<(Option<Bound<'py, PyDict>>, Option<PyErr>)>;

/// Most samples of a record.
const MOST_SAMPLES: f64 = 1e8;

/// Options of a run.
struct Options {
    tolerance: Option<f64>,
    start: Option<String>,
    record_s: f64,
    sample_rate_hz: f64,
}

/// What was marched.
struct Marched {
    plan: RunPlan,
    answer: RunAnswer,
    history: Option<History>,
    /// Limits of patches that the run has passed, in words.
    warnings: Vec<String>,
}

/// Marches one run; `start` is a state as JSON.
#[pyfunction]
pub fn run<'py>(
    py: Python<'py>,
    spec: &Spec,
    tolerance: Option<f64>,
    start: Option<String>,
    record_s: f64,
    sample_rate_hz: f64,
) -> Handed<'py> {
    let own = spec.with_tolerance(tolerance)?;
    let options = Options { tolerance, start, record_s, sample_rate_hz };
    let found = watched(py, None, |watch| marched(spec, &options, watch));
    handed(py, found, |marched| told(py, own.as_ref().unwrap_or(spec), marched))
}

fn marched(spec: &Spec, options: &Options, watch: &Watch) -> Result<Marched, Failure> {
    let prepared = spec.prepared(watch)?;
    let start = match &options.start {
        Some(json) => serde_json::from_str::<StartState>(json).map_err(|error| Failure::new("StartError", error))?,
        None => prepared.start(&spec.folder())?,
    };
    let kernel = prepared.from_state(&start)?;
    let run = &prepared.spec.run;
    let plan = RunPlan {
        duration_s: run.duration_s,
        average_over_s: run.average_over_s,
        tolerance: options.tolerance.unwrap_or(run.tolerance),
        record_s: options.record_s,
    };
    if options.record_s > run.duration_s {
        let why = format!("record is {} s; it must not be longer than run.duration = {} s", options.record_s, run.duration_s);
        return Err(Failure::new("ArgumentError", why));
    }
    let samples = options.record_s * options.sample_rate_hz;
    if samples > MOST_SAMPLES {
        let why = format!("record times sample_rate makes {samples:e} samples; at most {MOST_SAMPLES:e} are kept");
        return Err(Failure::new("ArgumentError", why));
    }
    let answer = simulate(&kernel, &start, &plan)?;
    let history = (options.record_s > 0.0).then(|| History::new(&kernel, &answer, &plan, options.sample_rate_hz));
    let warnings = warnings(&prepared.spec, &kernel, &answer.trajectory);
    Ok(Marched { plan, answer, history, warnings })
}

/// Limits that the record passes. It is looked at thousands of times, so that patches that bear anything are left alone.
fn warnings(spec: &jounce::spec::Spec, kernel: &Kernel, trajectory: &Trajectory) -> Vec<String> {
    let bears_all = |patch: &Patch| patch.strain_limit.is_none() && named(&patch.material).is_none_or(|own| own.voltage_limits_v.is_none());
    match spec.patch.values().all(bears_all) {
        true => Vec::new(),
        false => exceeded(spec, kernel, trajectory).iter().map(ToString::to_string).collect(),
    }
}

fn told<'py>(py: Python<'py>, spec: &Spec, marched: Marched) -> PyResult<Bound<'py, PyDict>> {
    let Marched { plan, answer, history, warnings } = marched;
    let settlement = answer.settlement;
    let settled = |value: fn(Settlement) -> f64| settlement.map_or(f64::NAN, value);
    let energies = &answer.energies;
    let state = serde_json::to_string(&answer.end).map_err(|error| Failure::new("JounceError", error))?;
    let work = serde_json::to_string(&answer.work).map_err(|error| Failure::new("JounceError", error))?;
    let (loads, stops) = (&answer.loads, &answer.stops);
    let flows = Answer::new(py)
        .with("input_j", energies.input_j)?
        .with("loads_j", energies.loads_j.iter().sum::<f64>())?
        .with("damping_j", energies.damping_j)?
        .with("contact_loss_j", energies.contact_loss_j)?
        .with("stored_j", energies.stored_j)?
        .dict();
    let answer = Answer::new(py)
        .with("mean_power_w", answer.mean_power_w)?
        .with("load", loads.iter().map(|load| load.name.clone()).collect::<Vec<_>>())?
        .each("load_power_w", loads, |load| load.mean_power_w)?
        .each("load_voltage_rms_v", loads, |load| load.voltage_rms_v)?
        .with("stop", stops.iter().map(|stop| stop.name.clone()).collect::<Vec<_>>())?
        .each("stop_contacts", stops, |stop| stop.contacts as i64)?
        .each("stop_contact_duty", stops, |stop| stop.contact_duty)?
        .each("stop_max_penetration_m", stops, |stop| stop.max_penetration_m)?
        .each("stop_max_contact_force_n", stops, |stop| stop.max_contact_force_n)?
        .each("stop_impulse_n_s", stops, |stop| stop.impulse_n_s)?
        .with("max_penetration_m", answer.max_penetration_m)?
        .with("max_contact_force_n", answer.max_contact_force_n)?
        .with("contacts", answer.contacts)?
        .with("contact_duty", answer.contact_duty)?
        .with("settled", settlement.map(|found| found.settled))?
        .with("period_cycles", settlement.map(|found| found.period_cycles))?
        .with("settle_change", settled(|found| found.change))?
        .with("settle_distance", settled(|found| found.distance))?
        .with("warnings", warnings)?
        .with("energy_residual_relative", energies.residual_relative())?
        .with("energies_j", flows)?
        .with("duration_s", plan.duration_s)?
        .with("average_over_s", plan.average_over_s)?
        .with("tolerance", plan.tolerance)?
        .with("march_s", answer.march_s)?
        .with("end", state)?
        .with("work", work)?
        .with("history", history.map(|history| history.dict(py)).transpose()?)?
        .with("manifest", spec.manifest("run", &[]))?;
    Ok(answer.dict())
}
