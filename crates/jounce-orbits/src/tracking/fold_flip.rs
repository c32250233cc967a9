//! Scalar condition of a multiplier +1 or -1.
//!
//! ```text
//! [A b; c' 0] (v, g) = (0, 1),   [A' c; b' 0] (w, g) = (0, 1),   A = M - s I,   dg = -w' dA v
//! ```
//!
//! `b` and `c` are near the null vectors of `A'` and `A`, so that the border is regular. `M` is the
//! derivative of a flow, whose second derivative is symmetric. `w' dM v` for a change `du`
//! therefore equals the change of `w' M` along `v`, applied to `du`. One more shooting evaluation
//! gives the gradient.
//!
//! Source: W. Govaerts, Numerical Methods for Bifurcations of Dynamical Equilibria (SIAM, 2000), ch. 3.

use super::condition::Gradient;
use crate::bordered::border::solve_bordered;
use crate::{ShootingEvaluation, null_vector};
use jounce_linalg::{Mat, norm};

/// Step along `v` for the second derivative, relative to the size of the state.
const DIFFERENCE_STEP: f64 = 1e-5;

/// `A` with its border.
#[derive(Debug)]
pub struct CriticalMultiplier {
    v: Vec<f64>,
    w: Vec<f64>,
    g: f64,
}

impl CriticalMultiplier {
    /// Solves for the multiplier `s` of a period map; `None` where the border is singular.
    pub fn of(map: &Mat<f64>, s: f64) -> Option<Self> {
        let n = map.nrows();
        let shifted = Mat::from_fn(n, n, |i, j| map[(i, j)] - if i == j { s } else { 0.0 });
        let transposed = shifted.transpose();
        let (c, b) = (null_vector(&shifted), null_vector(&transposed));
        let zero = vec![0.0; n];
        let (v, g) = solve_bordered(&shifted, &b, (&c, 0.0), (&zero, 1.0))?;
        let (w, _) = solve_bordered(&transposed, &c, (&b, 0.0), (&zero, 1.0))?;
        Some(Self { v, w, g })
    }

    /// Returns `g` with its gradient; see [`super::Condition::gradient`].
    pub fn gradient<E>(
        &self,
        evaluation: &ShootingEvaluation,
        neighbours: [&ShootingEvaluation; 2],
        differences: [f64; 2],
        shifted_shot: impl Fn(&[f64]) -> Result<ShootingEvaluation, E>,
    ) -> Result<Gradient, E> {
        let n = self.v.len();
        let step = DIFFERENCE_STEP * norm(&evaluation.strobe_states[0]) / norm(&self.v);
        let along = shifted_shot(&self.v.iter().map(|v| step * v).collect::<Vec<_>>())?;
        let by_unknown = (0..n)
            .map(|j| {
                -(0..n)
                    .map(|i| self.w[i] * (along.map()[(i, j)] - evaluation.map()[(i, j)]))
                    .sum::<f64>()
                    / step
            })
            .collect();
        let change = |k: usize| -> f64 {
            let entry = |i: usize, j: usize| {
                self.w[i] * (neighbours[k].map()[(i, j)] - evaluation.map()[(i, j)]) * self.v[j]
            };
            -(0..n)
                .map(|i| (0..n).map(|j| entry(i, j)).sum::<f64>())
                .sum::<f64>()
                / differences[k]
        };
        Ok(Gradient {
            value: self.g,
            by_unknown,
            by_parameters: [change(0), change(1)],
            by_phase: 0.0,
            power_curvature: None,
            is_resonant: false,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `g` vanishes with the distance of the multiplier, and is about equal to it for orthogonal
    /// null vectors.
    #[test]
    fn g_is_zero_with_the_multiplier_at_s() {
        let map = |multiplier: f64| {
            Mat::from_fn(3, 3, |i, j| {
                if i == j {
                    [0.3, multiplier, -0.5][i]
                } else {
                    0.0
                }
            })
        };
        for distance in [1e-3, 1e-9, -1e-3] {
            let g = CriticalMultiplier::of(&map(1.0 + distance), 1.0)
                .map_or(f64::NAN, |condition| condition.g);
            assert!(
                (g.abs() - f64::abs(distance)).abs() < 1e-12,
                "{g} for {distance}"
            );
        }
    }
}
