//! Mean power of a run, under noise or a recording.

use crate::problem::{LimitedQuantity, Problem};
use jounce_analysis::run::{RunPlan, simulate};
use jounce_analysis::{AnalysisError, Model};
use jounce_orbits::OrbitQuantity;

/// Returns the mean power, W, and sets the contact forces that have limits. A periodic drive whose
/// motion has not settled gives no power.
pub(super) fn evaluate(
    problem: &Problem,
    model: &Model,
    limits: &mut [f64],
) -> Result<f64, AnalysisError> {
    let start = model.start(&problem.folder)?;
    let kernel = model.from_state(&start)?;
    let result = simulate(&kernel, &start, &RunPlan::of(&model.spec.run, 0.0))?;
    for (limit, value) in problem.limits.iter().zip(limits) {
        if let LimitedQuantity::Peak(OrbitQuantity::ContactForce(stop)) = limit.quantity {
            *value = result.stops[stop].max_contact_force_n;
        }
    }
    let is_transient = result.settlement.is_some_and(|found| !found.settled);
    Ok(if is_transient {
        0.0
    } else {
        result.mean_power_w
    })
}
