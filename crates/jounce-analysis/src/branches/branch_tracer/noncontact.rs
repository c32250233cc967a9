//! Orbits without contact; a plant has one of them at each value of a key.
//!
//! At a grazing on a stiff stop a branch may turn within less than the accuracy of its orbits.
//! Continuation may then turn back over its own points, and two neighbouring points look as at a
//! fold. But if it leaves the orbits without contact and returns to them at an earlier value, it
//! has turned back. The turning point is half-way.

use crate::branches::branch::{Branch, BranchPoint, Termination};
use jounce_linalg::distance;

/// Point where continuation left the orbits without contact.
#[derive(Debug, Clone, Copy)]
pub(super) struct NoncontactEnd {
    /// Number of points so far.
    points: usize,
    /// Number of bifurcations so far.
    bifurcations: usize,
}

impl NoncontactEnd {
    /// Returns the state of the branch if a step from its last point leaves the orbits without
    /// contact.
    pub fn between(before: &BranchPoint, after: &BranchPoint, branch: &Branch) -> Option<Self> {
        let leaves = is_contact_free(before) && !is_contact_free(after);
        leaves.then_some(Self {
            points: branch.points.len(),
            bifurcations: branch.bifurcations.len(),
        })
    }

    /// Returns the index of the point after the one to which the branch returned with its last
    /// point.
    pub fn comes_back(self, branch: &Branch) -> Option<usize> {
        let last = branch.points.last().filter(|last| is_contact_free(last))?;
        let lies_in = |pair: &[BranchPoint]| {
            let (low, high) = (
                pair[0].parameter.min(pair[1].parameter),
                pair[0].parameter.max(pair[1].parameter),
            );
            pair.iter().all(is_contact_free) && low < last.parameter && last.parameter < high
        };
        branch.points[..self.points]
            .windows(2)
            .position(lies_in)
            .map(|index| index + 1)
    }

    /// Ends a branch that returned to a point at its turning point, with the bifurcations passed
    /// until then.
    pub fn end(self, branch: &mut Branch, back_at: usize) {
        let points = &branch.points;
        let step = |pair: &[BranchPoint]| {
            distance(pair[0].orbit.start(), pair[1].orbit.start()) / pair[1].orbit.size()
        };
        let mut arc_lengths = vec![0.0];
        arc_lengths.extend(
            points[back_at..]
                .windows(2)
                .map(step)
                .scan(0.0, |sum, length| {
                    *sum += length;
                    Some(*sum)
                }),
        );
        let half = 0.5 * arc_lengths.last().copied().unwrap_or(0.0);
        let turns = |k: &usize| {
            let [a, b, c] = [k - 1, *k, k + 1].map(|k| points[k].parameter);
            (b - a) * (c - b) < 0.0
        };
        let from_middle = |k: usize| (arc_lengths[k - back_at] - half).abs();
        let turn = (self.points..points.len() - 1)
            .filter(turns)
            .min_by(|a, b| from_middle(*a).total_cmp(&from_middle(*b)))
            .unwrap_or(self.points);
        let parameter = points[turn].parameter;
        branch.points.truncate(turn + 1);
        let n_events = branch.bifurcations.len() - self.bifurcations;
        branch
            .bifurcations
            .truncate(self.bifurcations + n_events / 2);
        let reason = "the continuation turned back over its own points there; try a smaller tolerance or the other method".to_owned();
        branch.endings.push(Termination::Failed {
            why: reason,
            parameter,
        });
    }
}

fn is_contact_free(point: &BranchPoint) -> bool {
    let orbit = &point.orbit;
    orbit.contacts == 0 && orbit.switches == 0 && orbit.max_penetration_m == 0.0
}
