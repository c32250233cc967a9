//! A turning point on the surface of the stop, as a scalar: its distance past the surface, beside the size of the motion.
//!
//! ```text
//! d = c . x(t*) - gap,   c' . x(t*) = 0,   dd/du = c Phi(t*)
//! ```
//!
//! `Phi` is the derivative of the flow up to the turning point, whose own move in time is of no account because the speed is zero there.

use super::condition::Gradient;
use crate::march::{Drift, Variation, VariationError};
use crate::orbit::{Shot, Turn, nearest_turn};
use faer::Mat;

/// `g` with its gradient, by the parameters with differences; `None` without a turning point. `scale` is that of shooting.
pub fn gradient(
    shot: &Shot,
    aside: [&Shot; 2],
    differences: [f64; 2],
    (scale, tolerance): (&[f64], f64),
) -> Result<Option<Gradient>, VariationError> {
    let scale_m = shot.kernel.plant.scale_m();
    let distance = |shot: &Shot| nearest_turn(shot).map(|turn| turn.past_m / scale_m);
    let Some(turn) = nearest_turn(shot) else { return Ok(None) };
    let value = turn.past_m / scale_m;
    let by_unknown = past_by_unknown(shot, turn, scale, tolerance)?.into_iter().map(|by| by / scale_m).collect();
    let [Some(first), Some(second)] = [distance(aside[0]), distance(aside[1])] else { return Ok(None) };
    let by_parameters = [(first - value) / differences[0], (second - value) / differences[1]];
    Ok(Some(Gradient { value, by_unknown, by_parameters, bend: None, is_resonant: false }))
}

/// Derivative of the distance at a turning point by the state at the start of the period, m.
fn past_by_unknown(shot: &Shot, turn: Turn, scale: &[f64], tolerance: f64) -> Result<Vec<f64>, VariationError> {
    let plant = &shot.kernel.plant;
    let n = scale.len();
    let cycle_s = shot.period_s / shot.trajectories.len() as f64;
    let into = &plant.diagonal.from_physical;
    let mut flow = Mat::from_fn(n, n, |i, j| into[(i, j)] / scale[j]);
    for (cycle, look) in shot.looks.iter().enumerate().take(turn.cycle + 1) {
        let physical: Vec<f64> = look.iter().zip(scale).map(|(u, w)| u / w).collect();
        let until_s = if cycle == turn.cycle { turn.time_s } else { cycle_s };
        let start = plant.from_physical(&physical, 0.0);
        flow = &Variation::march(&shot.kernel, &start, 0.0, until_s, tolerance, &Drift::default())?.jacobian * &flow;
    }
    let row: &[f64] = &plant.ports[turn.port].displacement;
    Ok((0..n).map(|j| row.iter().enumerate().map(|(i, c)| c * flow[(i, j)]).sum()).collect())
}
