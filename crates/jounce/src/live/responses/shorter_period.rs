//! Points of an updated branch that have fallen back to an orbit of a shorter period.

use jounce_analysis::{Branch, BranchPoint};

/// Distance of two states, relative to their size, below which they are the same in a draft.
const SAME_STATE: f64 = 2e-3;

/// Removes these points from branches. After a change of the design that undoes a period doubling,
/// Newton's method finds the orbit of the shorter period in place of the doubled one.
pub(super) fn without_shorter_periods(branches: Vec<Branch>) -> Vec<Branch> {
    let pieces = |branch: &Branch| {
        let is_shorter = |point: &BranchPoint| {
            let shorter = point.orbit.shorter_period_within(SAME_STATE);
            shorter.is_some()
        };
        let runs = branch.points.split(is_shorter).filter(|run| run.len() > 1);
        let piece = |points: &[BranchPoint]| Branch {
            points: points.to_vec(),
            ..branch.clone()
        };
        runs.map(piece).collect::<Vec<_>>()
    };
    branches.iter().flat_map(pieces).collect()
}
