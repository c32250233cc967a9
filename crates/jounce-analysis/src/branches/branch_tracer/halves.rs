//! Merging of a doubled branch with its parent: the two halves of its orbits pass through each
//! other.
//!
//! ```text
//! d = x(n T / 2) - x(0),   d(-s) = -d(s)
//! ```
//!
//! The difference `d` of the halves is an odd function of the distance `s` along the curve from the
//! merging point, since beyond it the branch is its own copy, shifted by half a period. So the
//! chord of `d` over a short step passes through zero there. A difference that only rotates does
//! not.

use super::orbit_point::OrbitPoint;
use crate::branches::branch::{Bifurcation, Branch, BranchKind};
use jounce_continuation::Position;
use jounce_orbits::{Orbit, OrbitMethod};

/// Largest relative distance of the halves at the point where they meet. A fold is located to a
/// fraction of the step, and the distance is proportional to its square root.
const MAX_HALF_DISTANCE: f64 = 0.01;

/// Distance of the chord from zero where the halves pass through each other, relative to their
/// distance at the nearer end of the step.
const MAX_CHORD_DISTANCE: f64 = 0.1;

/// Relation of the halves of two neighbouring orbits.
#[derive(Debug, Clone, Copy, PartialEq)]
enum HalfPeriods {
    /// They remain apart.
    Apart,
    /// They pass through each other at this fraction of the step.
    PassThrough(f64),
    /// Their difference rotates by more than a right angle.
    TurnRound,
}

impl HalfPeriods {
    fn between(one: &Orbit, two: &Orbit) -> Self {
        let (Some(from), Some(to)) = (one.half_period_difference(), two.half_period_difference())
        else {
            return Self::Apart;
        };
        if inner(&from, &to) >= 0.0 {
            return Self::Apart;
        }
        let chord: Vec<f64> = to.iter().zip(&from).map(|(to, from)| to - from).collect();
        let share = -inner(&from, &chord) / inner(&chord, &chord);
        let nearest: Vec<f64> = from
            .iter()
            .zip(&chord)
            .map(|(from, chord)| from + share * chord)
            .collect();
        let least = inner(&from, &from).min(inner(&to, &to));
        if inner(&nearest, &nearest) < MAX_CHORD_DISTANCE * MAX_CHORD_DISTANCE * least {
            Self::PassThrough(share)
        } else {
            Self::TurnRound
        }
    }
}

fn inner(one: &[f64], two: &[f64]) -> f64 {
    one.iter().zip(two).map(|(a, b)| a * b).sum()
}

/// Returns the position on a step at which a doubled branch merges with its parent.
pub(super) fn merge<M: OrbitMethod>(
    before: &OrbitPoint<M>,
    after: &OrbitPoint<M>,
) -> Option<Position> {
    let (from, to) = (&before.step.position, &after.step.position);
    match HalfPeriods::between(&before.point.orbit, &after.point.orbit) {
        HalfPeriods::PassThrough(share) => Some(from.offset_along(&from.to(to), share)),
        HalfPeriods::Apart | HalfPeriods::TurnRound => None,
    }
}

/// True where the halves rotate on one of the steps; a shorter step decides whether they pass
/// through each other.
pub(super) fn turns_round<M: OrbitMethod>(
    before: &OrbitPoint<M>,
    points: &[OrbitPoint<M>],
) -> bool {
    let orbits: Vec<&Orbit> = [before]
        .into_iter()
        .chain(points)
        .map(|point| &point.point.orbit)
        .collect();
    orbits
        .windows(2)
        .any(|pair| HalfPeriods::between(pair[0], pair[1]) == HalfPeriods::TurnRound)
}

/// True where the distance of an orbit from its copy shifted by half a period changes by half or
/// passes zero. There a doubled branch meets its parent and turns; the square of the distance is a
/// factor of its distance from +1.
pub(in crate::branches) fn meets_halves(one: &Orbit, two: &Orbit) -> bool {
    let (Some(one), Some(two)) = (one.half_period_difference(), two.half_period_difference())
    else {
        return false;
    };
    let [from, to] = [&one, &two].map(|difference| inner(difference, difference).sqrt());
    inner(&one, &two) <= 0.0 || from.min(to) < 0.5 * from.max(to)
}

/// Removes the last labels of a doubled branch that merged with its parent. There it turns and
/// meets its own copy; the parent reports this event as the period doubling.
pub(super) fn drop_doubling(branch: &mut Branch) {
    let is_doubling = |bifurcation: &Bifurcation| {
        let orbit = &bifurcation.at.orbit;
        let difference = orbit
            .half_period_difference()
            .map_or(f64::INFINITY, |difference| {
                difference.iter().map(|d| d * d).sum::<f64>().sqrt()
            });
        matches!(bifurcation.kind, BranchKind::Fold | BranchKind::BranchPoint)
            && difference < MAX_HALF_DISTANCE * orbit.size()
    };
    while branch.bifurcations.last().is_some_and(is_doubling) {
        branch.bifurcations.pop();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(strobe_states: Vec<Vec<f64>>) -> Orbit {
        Orbit {
            period_cycles: strobe_states.len().saturating_sub(1) as u32,
            strobe_states,
            mean_power_w: 0.0,
            voltage_rms_v: 0.0,
            contacts: 1,
            switches: 0,
            max_penetration_m: 0.0,
            max_contact_force_n: 0.0,
            max_impact_velocity_m_s: 0.0,
            displacement_peak_m: 0.0,
            multipliers: Vec::new(),
            error_estimate: 0.0,
        }
    }

    fn orbit(difference: [f64; 2]) -> Orbit {
        at(vec![vec![0.0; 2], difference.to_vec(), vec![0.0; 2]])
    }

    #[test]
    fn halves_that_turn_round_do_not_pass_through_each_other() {
        let halves = |from, to| HalfPeriods::between(&orbit(from), &orbit(to));
        assert_eq!(halves([1.0, 0.0], [0.5, 0.1]), HalfPeriods::Apart);
        assert_eq!(halves([1.0, 0.0], [-1.0, 0.8]), HalfPeriods::TurnRound);
        assert_eq!(
            halves([1.0, 0.0], [-3.0, 0.0]),
            HalfPeriods::PassThrough(0.25)
        );
        assert_eq!(
            HalfPeriods::between(&at(vec![vec![0.0; 2]; 2]), &at(vec![vec![0.0; 2]; 2])),
            HalfPeriods::Apart
        );
    }
}
