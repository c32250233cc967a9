//! Scalar condition of a pair of multipliers on the unit circle.
//!
//! ```text
//! g = det B - 1,   B = W' M V,   M V = V B,   W' M = B W',   W' V = I,   dg = det B tr(B^-1 dB),   dB = W' dM V
//! ```
//!
//! The columns of `V` span the plane of the pair, the columns of `W` the plane in the transposed
//! map. Planes, unlike eigenvectors, remain well defined where the pair meets on the real axis
//! (strong resonance), so that `g` is smooth there. Beyond it the product remains one without a
//! torus: the curve of tori has ended.
//!
//! `M` is the derivative of a flow, whose second derivative is symmetric: two shooting evaluations,
//! along the columns of `V`, give the gradient.
//!
//! Source: Y. A. Kuznetsov, Elements of Applied Bifurcation Theory (Springer, 2004), ch. 4, 5 and 10.

use super::condition::Gradient;
use super::multiplier_pair::MultiplierPair;
use crate::ShootingEvaluation;
use jounce_linalg::norm;

/// Step along a vector of the plane for the second derivative, relative to the size of the state.
const DIFFERENCE_STEP: f64 = 1e-5;

/// Returns `g` with its gradient; `None` without a pair. See [`super::Condition::gradient`].
pub fn gradient<E>(
    evaluation: &ShootingEvaluation,
    neighbours: [&ShootingEvaluation; 2],
    differences: [f64; 2],
    shifted_shot: impl Fn(&[f64]) -> Result<ShootingEvaluation, E>,
) -> Result<Option<Gradient>, E> {
    let Some(pair) = MultiplierPair::of(evaluation.map()) else {
        return Ok(None);
    };
    let n = evaluation.map().nrows();
    let step = DIFFERENCE_STEP * norm(&evaluation.strobe_states[0]);
    let along = |column: usize| {
        shifted_shot(
            &pair
                .right
                .column(column)
                .iter()
                .map(|v| step * v)
                .collect::<Vec<_>>(),
        )
    };
    let sides = [along(0)?, along(1)?];
    let by = |j: usize| {
        pair.change(|row, column| {
            (0..n)
                .map(|i| {
                    pair.left_basis[(i, row)]
                        * (sides[column].map()[(i, j)] - evaluation.map()[(i, j)])
                })
                .sum::<f64>()
                / step
        })
    };
    let by_parameter = |k: usize| {
        let change = |i: usize, j: usize| {
            (neighbours[k].map()[(i, j)] - evaluation.map()[(i, j)]) / differences[k]
        };
        pair.change(|row, column| pair.between(row, column, change))
    };
    Ok(Some(Gradient {
        value: pair.product() - 1.0,
        by_unknown: (0..n).map(by).collect(),
        by_parameters: [by_parameter(0), by_parameter(1)],
        by_phase: 0.0,
        power_curvature: None,
        is_resonant: !pair.is_complex,
    }))
}
