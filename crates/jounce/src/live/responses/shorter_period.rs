//! Points of an updated branch that have fallen back to an orbit of a shorter period.

use jounce_analysis::{Branch, BranchPoint};
use jounce_orbits::Orbit;

/// Distance of two states, relative to their size, below which they are the same in a draft.
const SAME_STATE: f64 = 2e-3;

/// Removes these points from branches. After a change of the design that undoes a period doubling,
/// Newton's method finds the orbit of the shorter period in place of the doubled one.
pub(super) fn without_shorter_periods(branches: Vec<Branch>) -> Vec<Branch> {
    let pieces = |branch: &Branch| {
        let is_shorter = |point: &BranchPoint| has_shorter_period(&point.orbit);
        let runs = branch.points.split(is_shorter).filter(|run| run.len() > 1);
        let piece = |points: &[BranchPoint]| Branch {
            points: points.to_vec(),
            ..branch.clone()
        };
        runs.map(piece).collect::<Vec<_>>()
    };
    branches.iter().flat_map(pieces).collect()
}

/// Returns whether the state returns after a proper divisor of the period.
fn has_shorter_period(orbit: &Orbit) -> bool {
    let cycles = orbit.period_cycles as usize;
    let size = orbit.size();
    let returns_after = |part: usize| {
        let Some(later) = orbit.strobe_states.get(part) else {
            return false;
        };
        let squares = later
            .iter()
            .zip(orbit.start())
            .map(|(a, b)| (a - b).powi(2));
        squares.sum::<f64>().sqrt() <= SAME_STATE * size
    };
    (1..cycles).any(|part| cycles.is_multiple_of(part) && returns_after(part))
}
