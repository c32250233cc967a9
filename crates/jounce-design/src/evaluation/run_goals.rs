//! Goals of a run, under noise or a recording: mean power, and the operation of a device.

use crate::problem::{Goal, Problem};
use jounce_analysis::run::{RunPlan, RunResult, WorstOperation, simulate};
use jounce_analysis::{AnalysisError, Model};
use jounce_dynamics::Kernel;
use jounce_orbits::OrbitQuantity;

/// Samples of each step of the integration, and of the averaging window at least.
const SAMPLES_PER_STEP: f64 = 4.0;
const MIN_SAMPLES: f64 = 4096.0;

/// Returns the run, and raises the limited peaks to those of its averaging window.
pub(super) fn run(
    problem: &Problem,
    model: &Model,
    limits: &mut [f64],
) -> Result<RunResult, AnalysisError> {
    let start = model.start(&problem.folder)?;
    let kernel = model.from_state(&start)?;
    let is_force = |quantity| matches!(quantity, OrbitQuantity::ContactForce(_));
    let is_sampled = problem.peaks().iter().any(|(_, one)| !is_force(*one));
    let record_s = match is_sampled {
        true => model.spec.run.average_over_s,
        false => 0.0,
    };
    let result = simulate(&kernel, &start, &RunPlan::of(&model.spec.run, record_s))?;
    for ((index, _), peak) in problem.peaks().iter().zip(peaks(problem, &kernel, &result)) {
        // NaN: no goal needs the peaks of an orbit.
        limits[*index] = limits[*index].max(peak);
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
