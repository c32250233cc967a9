//! Complex pairs of multipliers that may meet between two points and leave the unit circle.
//!
//! Where two pairs have the same angle, the coupling `k` between them changes their moduli by up to
//! `k`: an instability tongue. Moduli and derivatives at the two points do not show it. Symmetric
//! functions of both pairs are smooth through it.

use super::interpolant::Interpolant;
use super::pairing::paired;
use super::spectrum::StepEnd;
use faer::{Mat, c64};
use jounce_orbits::Eigenbasis;
use std::f64::consts::TAU;

/// Factor on the coupling computed at the two points.
const COUPLING_MARGIN: f64 = 2.0;

/// Relative turns of two pairs on one step above which they are assumed to meet.
const MAX_TURNS: f64 = 4.0;

/// Couplings between the multipliers at one end of a step, in their order; `None` where the
/// eigenvectors are unknown.
pub(super) struct Couplings(Option<Vec<Vec<f64>>>);

impl Couplings {
    /// Computes the couplings of another map in the eigenvectors of a map with these multipliers.
    pub fn of(values: &[c64], [eigenvalues, other]: [(&Mat<f64>, &Option<Eigenbasis>); 2]) -> Self {
        let tied = eigenvalues
            .1
            .as_ref()
            .zip(other.1.as_ref())
            .and_then(|(basis, beyond)| basis.couplings(eigenvalues.0, (beyond, other.0)));
        let Some((eigenvalues, tied)) = tied else {
            return Self(None);
        };
        let mut all = vec![vec![0.0; values.len()]; values.len()];
        let pairs = paired(values.len(), eigenvalues.len(), |i, k| {
            (values[i] - eigenvalues[k]).norm_sqr()
        });
        for (i, k) in &pairs {
            for (j, l) in &pairs {
                all[*i][*j] = tied[(*k, *l)];
            }
        }
        Self(Some(all))
    }

    /// Returns the coupling of two multipliers; infinite where unknown.
    fn between(&self, i: usize, j: usize) -> f64 {
        let known = self.0.as_ref().map(|all| all[i][j]);
        known
            .filter(|coupling| !coupling.is_nan())
            .unwrap_or(f64::INFINITY)
    }
}

/// True where two complex multipliers may meet on the step and leave the unit circle. Each is given
/// by its index at both ends; the upper one of two conjugates represents both.
pub(super) fn may_push_out(
    ends: [StepEnd; 2],
    couplings: &[Couplings; 2],
    one: (usize, usize),
    two: (usize, usize),
) -> bool {
    let [a, b] = ends;
    let values = [
        a.value(one.0),
        a.value(two.0),
        b.value(one.1),
        b.value(two.1),
    ];
    if values[0].im <= 0.0 || values.iter().any(|mu| mu.im == 0.0) {
        return false;
    }
    let coupling = COUPLING_MARGIN
        * couplings[0]
            .between(one.0, two.0)
            .max(couplings[1].between(one.1, two.1));
    let [first, second] = [
        values[0].norm().max(values[2].norm()),
        values[1].norm().max(values[3].norm()),
    ];
    largest_coupled(first, second, coupling) >= 1.0 && may_meet(ends, one, two)
}

/// Returns the larger modulus of two coupled multipliers of one angle: the larger eigenvalue of `[a
/// k; k b]`.
fn largest_coupled(a: f64, b: f64, coupling: f64) -> f64 {
    0.5 * (a + b) + (0.5 * (a - b)).hypot(coupling)
}

/// True where the angles of two multipliers may be equal somewhere on the step.
fn may_meet(ends: [StepEnd; 2], one: (usize, usize), two: (usize, usize)) -> bool {
    let [a, b] = ends;
    let rate = |end: StepEnd, i: usize| (end.change(i) / end.value(i)).im;
    let turn = |(i, j): (usize, usize)| {
        let principal_angle = (b.value(j) / a.value(i)).arg();
        let mean_rate = 0.5 * (rate(a, i) + rate(b, j));
        principal_angle + TAU * ((mean_rate - principal_angle) / TAU).round()
    };
    let from = (a.value(one.0) / a.value(two.0)).arg();
    let to = from + turn(one) - turn(two);
    let slopes = [
        rate(a, one.0) - rate(a, two.0),
        rate(b, one.1) - rate(b, two.1),
    ];
    let reach = slopes[0].abs().max(slopes[1].abs());
    let (low, high) = ((from.min(to) - reach) / TAU, (from.max(to) + reach) / TAU);
    if (high - low).is_nan() || high - low >= MAX_TURNS {
        return true;
    }
    let meets = |k: i64| {
        Interpolant {
            values: [from, to].map(|angle| angle - TAU * k as f64),
            slopes,
        }
        .crossings()
            != Some(0)
    };
    (low.ceil() as i64..=high.floor() as i64).any(meets)
}
