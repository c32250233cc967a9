//! Scalar condition of a quantity of the orbit at a level.
//!
//! ```text
//! g = Q / L - 1
//! ```
//!
//! The largest value over a period has no derivative in closed form. The gradient is a difference
//! quotient with one shooting evaluation for each state.

use super::condition::Gradient;
use crate::{OrbitQuantity, ShootingEvaluation};
use jounce_linalg::norm;

/// Step of the difference quotient, relative to the norm of the state.
const RELATIVE_STEP: f64 = 1e-6;

/// Returns `g` with its gradient. See [`super::Condition::gradient`].
pub fn gradient<E>(
    (quantity, value): (OrbitQuantity, f64),
    evaluation: &ShootingEvaluation,
    neighbours: [&ShootingEvaluation; 2],
    differences: [f64; 2],
    shifted_shot: impl Fn(&[f64]) -> Result<ShootingEvaluation, E>,
) -> Result<Gradient, E> {
    let relative_error = |evaluation: &ShootingEvaluation| quantity.of(evaluation) / value - 1.0;
    let current = relative_error(evaluation);
    let states = evaluation.strobe_states[0].len();
    let step = RELATIVE_STEP * norm(&evaluation.strobe_states[0]);
    let by = |j: usize| {
        let change: Vec<f64> = (0..states)
            .map(|i| if i == j { step } else { 0.0 })
            .collect();
        Ok((relative_error(&shifted_shot(&change)?) - current) / step)
    };
    let by_unknown = (0..states).map(by).collect::<Result<_, E>>()?;
    let by_parameters = [0, 1].map(|k| (relative_error(neighbours[k]) - current) / differences[k]);
    Ok(Gradient {
        value: current,
        by_unknown,
        by_parameters,
        by_phase: 0.0,
        power_curvature: None,
        is_resonant: false,
    })
}
