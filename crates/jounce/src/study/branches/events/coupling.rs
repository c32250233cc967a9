//! Complex pairs that may meet between two points and push each other out of the unit circle.
//!
//! Where two pairs come to one place on the way, the coupling `k` between them parts their moduli by up to `k`, and they meet again on the other
//! side: a tongue, of which neither the moduli at both ends nor their derivatives tell anything. Symmetric functions of both pairs are smooth
//! through it.

use super::interpolant::Interpolant;
use super::pairing::paired;
use super::spectrum::End;
use crate::orbit::couplings;
use faer::{Mat, c64};
use std::f64::consts::TAU;

/// Couplings by which two pairs may part: what the ends tell, and once more as much.
const SAFETY: f64 = 2.0;

/// Turns of one pair past another on one step above which they are taken to meet.
const MOST_TURNS: f64 = 4.0;

/// The couplings of a step, in the numbers of the multipliers at one of its ends.
pub(super) struct Couplings(Option<Vec<Vec<f64>>>);

impl Couplings {
    /// Of the multipliers of a period map by another map.
    pub fn of(values: &[c64], map: &Mat<f64>, other: &Mat<f64>) -> Self {
        let Some((own, tied)) = couplings(map, other) else { return Self(None) };
        let mut all = vec![vec![0.0; values.len()]; values.len()];
        let pairs = paired(values.len(), own.len(), |i, k| (values[i] - own[k]).norm());
        for (i, k) in &pairs {
            for (j, l) in &pairs {
                all[*i][*j] = tied[(*k, *l)];
            }
        }
        Self(Some(all))
    }

    /// Between two multipliers; infinite where it is not known.
    fn between(&self, i: usize, j: usize) -> f64 {
        self.0.as_ref().map_or(f64::INFINITY, |all| all[i][j]).max(0.0)
    }
}

/// True where two complex multipliers, by their numbers at both ends, may meet on the way and leave the unit circle.
pub(super) fn may_push_out(ends: [End; 2], couplings: &[Couplings; 2], one: (usize, usize), two: (usize, usize)) -> bool {
    let [a, b] = ends;
    let values = [a.value(one.0), a.value(two.0), b.value(one.1), b.value(two.1)];
    if values.iter().any(|mu| mu.im == 0.0) {
        return false;
    }
    let coupling = couplings[0].between(one.0, two.0).max(couplings[1].between(one.1, two.1));
    let largest = values.iter().map(|mu| mu.norm()).fold(0.0, f64::max);
    (largest + SAFETY * coupling >= 1.0 || coupling.is_nan()) && may_meet(ends, one, two)
}

/// True where the angles of two multipliers may be the same on the way.
fn may_meet(ends: [End; 2], one: (usize, usize), two: (usize, usize)) -> bool {
    let [a, b] = ends;
    let rate = |end: End, i: usize| (end.change(i) / end.value(i)).im;
    let turn = |(i, j): (usize, usize)| {
        let whole = (b.value(j) / a.value(i)).arg();
        let led = 0.5 * (rate(a, i) + rate(b, j));
        whole + TAU * ((led - whole) / TAU).round()
    };
    let from = (a.value(one.0) / a.value(two.0)).arg();
    let to = from + turn(one) - turn(two);
    let slopes = [rate(a, one.0) - rate(a, two.0), rate(b, one.1) - rate(b, two.1)];
    let reach = slopes[0].abs().max(slopes[1].abs());
    let (low, high) = ((from.min(to) - reach) / TAU, (from.max(to) + reach) / TAU);
    if (high - low).is_nan() || high - low >= MOST_TURNS {
        return true;
    }
    let meets = |k: i64| Interpolant { values: [from, to].map(|angle| angle - TAU * k as f64), slopes }.crossings() != Some(0);
    (low.ceil() as i64..=high.floor() as i64).any(meets)
}
