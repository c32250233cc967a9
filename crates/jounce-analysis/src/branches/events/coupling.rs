//! Complex pairs of multipliers that may meet between two points and leave the unit circle.
//!
//! Where two pairs have the same angle, the coupling `k` between them changes their moduli by up to
//! `k`: an instability tongue. Moduli and derivatives at the two points do not show it. Symmetric
//! functions of both pairs are smooth through it.
//!
//! ```text
//! |dm| <= 2 k^2 / g,   |dm'| <= 2 (k / g)^2 b t      4 k <= g
//! ```
//!
//! Where the moduli `a > b` stay apart by `g`, the coupling only moves each multiplier by `dm`, while
//! their angles turn by `t` relative to each other. So functions of one of the pairs have this much
//! more error, and no tongue exists.

use super::interpolant::Interpolant;
use super::pairing::paired;
use super::spectrum::{MultiplierGroup, StepEnd, TestFunction};
use jounce_linalg::c64;
use jounce_orbits::ShootingEvaluation;
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
    pub fn of(values: &[c64], here: &ShootingEvaluation, other: &ShootingEvaluation) -> Self {
        let tied = here
            .eigenbasis()
            .zip(other.eigenbasis())
            .and_then(|(basis, beyond)| {
                basis.couplings(&here.block_map, (beyond, &other.block_map))
            });
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

/// Two complex multipliers that may meet on a step and leave the unit circle, each by its index at
/// both ends; the first is the upper one of two conjugates. Their conjugates meet likewise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Meeting {
    pub one: (usize, usize),
    pub two: (usize, usize),
    /// Largest change of each by the coupling, and of its slope over the step; infinite where the
    /// moduli do not stay apart.
    pub shift: [f64; 2],
}

impl Meeting {
    /// Returns the meeting of two multipliers. The couplings at both ends, or `None` where they are
    /// unknown, are requested for multipliers that may meet.
    pub fn of<'c>(
        ends: [StepEnd; 2],
        couplings: impl Fn() -> Option<&'c [Couplings; 2]>,
        one: (usize, usize),
        two: (usize, usize),
    ) -> Option<Self> {
        let [a, b] = ends;
        let values = [
            a.value(one.0),
            a.value(two.0),
            b.value(one.1),
            b.value(two.1),
        ];
        if values[0].im <= 0.0 || values.iter().any(|mu| mu.im == 0.0) {
            return None;
        }
        let turn = meeting_turn(ends, one, two)?;
        let coupling = couplings().map_or(f64::INFINITY, |[at_one, at_two]| {
            let (from, to) = (at_one.between(one.0, two.0), at_two.between(one.1, two.1));
            COUPLING_MARGIN * from.max(to)
        });
        let [first, second] =
            [[values[0], values[2]], [values[1], values[3]]].map(|ends| ends.map(|mu| mu.norm()));
        let [first_high, second_high] = [first, second].map(|ends| ends[0].max(ends[1]));
        let [first_low, second_low] = [first, second].map(|ends| ends[0].min(ends[1]));
        let gap = (first_low - second_high).max(second_low - first_high);
        let [shift, slope] = largest_shift(coupling, gap, first_high.min(second_high));
        (largest_coupled(first_high, second_high, coupling) >= 1.0).then_some(Self {
            one,
            two,
            shift: [shift, slope * turn],
        })
    }

    /// True for the meeting of these two.
    pub fn is_of(&self, one: (usize, usize), two: (usize, usize)) -> bool {
        [(one, two), (two, one)].contains(&(self.one, self.two))
    }
}

/// Returns the errors of a function of a group, and of its slope over the step, by the couplings of
/// its members to those of other groups that they meet.
pub(super) fn coupling_error(
    [a, b]: [StepEnd; 2],
    group: &MultiplierGroup,
    f: TestFunction,
    meetings: &[Meeting],
) -> [f64; 2] {
    let at = |end: StepEnd, members: &[usize], index: fn((usize, usize)) -> usize| {
        let values: Vec<c64> = members.iter().map(|i| end.value(*i)).collect();
        let value = f(&values);
        let change = |k: usize, by: c64| {
            let mut moved = values.clone();
            moved[k] += by;
            (f(&moved) - value).abs()
        };
        let mut sums = [0.0; 2];
        for (k, i) in members.iter().enumerate() {
            let either = [*i, end.conjugate(*i)];
            let is_here = |meeting: &&Meeting| {
                let met = [meeting.one, meeting.two].map(index);
                met.iter().any(|k| either.contains(k))
            };
            for meeting in meetings.iter().filter(is_here) {
                for (sum, shift) in sums.iter_mut().zip(meeting.shift) {
                    *sum += change(k, c64::new(shift, 0.0)) + change(k, c64::new(0.0, shift));
                }
            }
        }
        sums
    };
    let from = at(a, &group.from, |pair| pair.0);
    let to = at(b, &group.to, |pair| pair.1);
    [from[0].max(to[0]), from[1].max(to[1])]
}

/// Returns the largest change of two coupled multipliers whose moduli stay apart by a gap, and of
/// their derivatives by the angle between them; `low` is the smaller modulus.
fn largest_shift(coupling: f64, gap: f64, low: f64) -> [f64; 2] {
    if 4.0 * coupling > gap {
        return [f64::INFINITY; 2];
    }
    let share = coupling / gap;
    [2.0 * coupling * share, 2.0 * share * share * low]
}

/// Returns the larger modulus of two coupled multipliers of one angle: the larger eigenvalue of `[a
/// k; k b]`.
fn largest_coupled(a: f64, b: f64, coupling: f64) -> f64 {
    0.5 * (a + b) + (0.5 * (a - b)).hypot(coupling)
}

/// Returns the relative turn of two multipliers on the step, rad, where their angles may be equal
/// somewhere on it.
fn meeting_turn(ends: [StepEnd; 2], one: (usize, usize), two: (usize, usize)) -> Option<f64> {
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
    let turn = TAU * (high - low);
    if high - low >= MAX_TURNS || turn.is_nan() {
        return Some(turn);
    }
    let meets = |k: i64| {
        Interpolant {
            values: [from, to].map(|angle| angle - TAU * k as f64),
            slopes,
        }
        .crossings()
            != Some(0)
    };
    (low.ceil() as i64..=high.floor() as i64)
        .any(meets)
        .then_some(turn)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::branches::events::test_data::{TestData, TestDataPair};

    /// Data of two pairs: one at 0.3 rad, one that turns through zero from 0.2 to -0.6 rad.
    fn at(s: f64) -> TestDataPair {
        let multipliers = |s: f64| {
            let pair =
                |modulus: f64, angle: f64| [angle, -angle].map(|a| c64::from_polar(modulus, a));
            [pair(1.0, 0.3), pair(0.95, 0.2 - 0.8 * s)].concat()
        };
        let current = TestData {
            multipliers: multipliers(s),
            radii: vec![2.0; 4],
            turns: Vec::new(),
            levels: Vec::new(),
            period_s: 1.0,
            cycles: 1,
            is_free: false,
        };
        TestDataPair {
            current,
            multipliers: multipliers(s + 1e-6),
            turns: Vec::new(),
            levels: Vec::new(),
            length: 1e-6,
            error: 1e-9,
        }
    }

    #[test]
    fn a_multiplier_meets_the_lower_one_of_another_pair_that_turns_through_zero() {
        let readings = [at(0.0), at(1.0)];
        let ends = readings.each_ref().map(|readings| StepEnd {
            readings,
            length: 1.0,
        });
        let meets =
            |one: usize, two: usize| Meeting::of(ends, || None, (one, one), (two, two)).is_some();
        assert!(meets(0, 3) && !meets(0, 2));
    }

    /// The exact eigenvalues of `[a c; c z]` with `z = b e^(i angle)` and `|c| = k`.
    #[test]
    fn a_coupling_moves_multipliers_by_no_more_than_its_bound() {
        let (mut tightest, step) = ([0.0_f64; 2], 1e-5);
        for (a, b) in [(1.0, 0.2), (1.0, 0.5), (0.9, 0.8), (1.1, 0.95)] {
            for k in [0.05, 0.15, 0.25].map(|share: f64| share * (a - b)) {
                let bounds = largest_shift(k, a - b, b);
                for (turn, phase) in (0..720).map(|n| (f64::from(n % 60), f64::from(n / 60))) {
                    let shift = |angle: f64| {
                        let z = c64::from_polar(b, angle);
                        let square = c64::from_polar(k * k, phase * TAU / 12.0);
                        let half = (c64::new(a, 0.0) - z) * 0.5;
                        let root = half * (c64::new(1.0, 0.0) + square / (half * half)).sqrt();
                        root - half
                    };
                    let angle = turn * TAU / 60.0;
                    let slope = (shift(angle + step) - shift(angle - step)).norm() / (2.0 * step);
                    for (k, found) in [shift(angle).norm(), slope].into_iter().enumerate() {
                        assert!(
                            found <= bounds[k] + 1e-9,
                            "{a} {b} {k}: {found} of {bounds:?}"
                        );
                        tightest[k] = tightest[k].max(found / bounds[k]);
                    }
                }
            }
        }
        // The bounds are not far from what happens.
        assert!(tightest.iter().all(|share| *share > 0.5), "{tightest:?}");
    }

    #[test]
    fn a_strong_coupling_has_no_bound() {
        assert_eq!(largest_shift(0.3, 1.0, 0.5), [f64::INFINITY; 2]);
    }
}
