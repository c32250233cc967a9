//! Goals of a run, under noise or a recording: mean power, and the operation of a device.

use crate::problem::{Goal, LimitedQuantity, Problem};
use jounce_analysis::run::{RunPlan, RunResult, StartState, WorstOperation, simulate};
use jounce_analysis::{AnalysisError, Ensemble, Model};
use jounce_dynamics::Kernel;
use jounce_orbits::OrbitQuantity;
use rayon::prelude::*;

/// Number of realisations of noise in which a design is examined.
pub const REALISATIONS: usize = Ensemble::DEFAULT_MEMBERS;

/// Samples of each step of the integration, and of the averaging window at least.
const SAMPLES_PER_STEP: f64 = 4.0;
const MIN_SAMPLES: f64 = 4096.0;

/// Mean power of a run and the limited quantities of a design in it.
#[derive(Debug, Clone, PartialEq)]
pub struct RealisedRun {
    /// Mean power, W.
    pub mean_power_w: f64,
    /// Value of each limited quantity, SI; NaN for those that do not depend on a run.
    pub limits: Vec<f64>,
}

/// Returns the run, and fills in the limited quantities of its averaging window: peaks are raised to
/// those of the run.
pub(super) fn run(
    problem: &Problem,
    model: &Model,
    limits: &mut [f64],
) -> Result<RunResult, AnalysisError> {
    let start = model.start(&problem.folder)?;
    let kernel = model.from_state(&start)?;
    of_kernel(problem, model, (&kernel, &start), limits)
}

/// Returns the runs of a model under realisations of its noise other than that of its spec, drawn from
/// a seed; without noise all of them are its one run.
///
/// # Errors
/// A failed integration.
pub fn realised(
    problem: &Problem,
    model: &Model,
    seed: u64,
) -> Result<Vec<RealisedRun>, AnalysisError> {
    let start = model.start(&problem.folder)?;
    let run = |kernel: &Kernel| {
        let mut limits = vec![f64::NAN; problem.limits.len()];
        let result = of_kernel(problem, model, (kernel, &start), &mut limits)?;
        Ok(RealisedRun {
            mean_power_w: value(Goal::MeanPower, &result),
            limits,
        })
    };
    let members = (0..REALISATIONS as u64).into_par_iter();
    let runs = members.map(|member| run(&model.realised(seed, member)?));
    match runs.collect() {
        Err(AnalysisError::NoNoise) => {
            let one = run(&*model.from_state(&start)?)?;
            Ok(vec![one; REALISATIONS])
        }
        runs => runs,
    }
}

fn of_kernel(
    problem: &Problem,
    model: &Model,
    (kernel, start): (&Kernel, &StartState),
    limits: &mut [f64],
) -> Result<RunResult, AnalysisError> {
    let is_force = |quantity| matches!(quantity, OrbitQuantity::ContactForce(_));
    let is_sampled = problem.peaks().iter().any(|(_, one)| !is_force(*one));
    let record_s = match is_sampled {
        true => model.spec.run.average_over_s,
        false => 0.0,
    };
    let result = simulate(kernel, start, &RunPlan::of(&model.spec.run, record_s))?;
    for ((index, _), peak) in problem.peaks().iter().zip(peaks(problem, kernel, &result)) {
        // NaN: no goal needs the peaks of an orbit.
        limits[*index] = limits[*index].max(peak);
    }
    for (limit, value) in problem.limits.iter().zip(limits) {
        if limit.quantity == LimitedQuantity::MeanPower {
            *value = self::value(Goal::MeanPower, &result);
        }
    }
    Ok(result)
}

/// Returns a goal of a run. A periodic drive whose motion has not settled gives no power.
pub(super) fn value(goal: Goal, result: &RunResult) -> f64 {
    let is_transient = result.settlement.is_some_and(|found| !found.settled);
    // A problem with these goals has a device.
    let of_devices = |measure: fn(WorstOperation) -> f64| {
        WorstOperation::of(&result.devices).map_or(f64::NAN, measure)
    };
    match goal {
        Goal::TimeOn => of_devices(|worst| worst.on_fraction),
        Goal::PowerMargin => of_devices(|worst| worst.margin_w),
        _ if is_transient => 0.0,
        _ => result.mean_power_w,
    }
}

/// Returns the limited peaks over the record of a run; contact forces over the averaging window.
fn peaks(problem: &Problem, kernel: &Kernel, result: &RunResult) -> Vec<f64> {
    let quantities = problem.peaks();
    let mut peaks: Vec<f64> = quantities
        .iter()
        .map(|(_, quantity)| match quantity {
            OrbitQuantity::ContactForce(stop) => result.stops[*stop].max_contact_force_n,
            _ => 0.0,
        })
        .collect();
    let segments = result.trajectory.segments();
    let length_s: f64 = segments.iter().map(|segment| segment.length_s).sum();
    let mut times_s = Vec::new();
    for segment in segments {
        let parts = (segment.length_s / length_s * MIN_SAMPLES).max(SAMPLES_PER_STEP);
        let step_s = segment.length_s / parts.ceil();
        let inside = 0..parts.ceil() as usize;
        times_s.extend(inside.map(|k| segment.start_s + k as f64 * step_s));
    }
    for at in result.trajectory.at(kernel, &times_s) {
        let state = kernel.plant.to_physical(&at.state, at.time_s);
        for (peak, (_, quantity)) in peaks.iter_mut().zip(&quantities) {
            *peak = peak.max(quantity.at(&kernel.plant, &state, &at));
        }
    }
    peaks
}
