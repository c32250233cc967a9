//! Orbits that never touch a stop, of which a plant has one at each value of a key.
//!
//! Where a branch turns within less than the accuracy of its orbits, as it does at its grazing on a stiff stop, a walk may turn round and run
//! back over its own points. Nothing that two neighbours show tells that from a fold; but a walk that left the orbits that never touch,
//! and is among them again at a value that it has passed, has come back. It turned half-way.

use super::branch::{Branch, BranchPoint, Termination};
use faer::ColRef;

/// Where a walk left the orbits that never touch.
#[derive(Debug, Clone, Copy)]
pub(super) struct NoncontactEnd {
    /// Points so far.
    points: usize,
    /// Bifurcations so far.
    bifurcations: usize,
}

impl NoncontactEnd {
    /// Where a step from the last point of a branch leaves them.
    pub fn between(before: &BranchPoint, after: &BranchPoint, branch: &Branch) -> Option<Self> {
        let leaves = never_touches(before) && !never_touches(after);
        leaves.then_some(Self {
            points: branch.points.len(),
            bifurcations: branch.bifurcations.len(),
        })
    }

    /// The point that a branch came back to with its last one, by the number of the next.
    pub fn comes_back(self, branch: &Branch) -> Option<usize> {
        let last = branch.points.last().filter(|last| never_touches(last))?;
        let lies_in = |pair: &[BranchPoint]| {
            let (low, high) = (
                pair[0].parameter.min(pair[1].parameter),
                pair[0].parameter.max(pair[1].parameter),
            );
            pair.iter().all(never_touches) && low < last.parameter && last.parameter < high
        };
        branch.points[..self.points]
            .windows(2)
            .position(lies_in)
            .map(|place| place + 1)
    }

    /// Ends a branch that came back to a point where it turned round, with those of its bifurcations that it passed until then.
    pub fn end(self, branch: &mut Branch, back_at: usize) {
        let points = &branch.points;
        let step = |pair: &[BranchPoint]| {
            let [from, to] = [0, 1].map(|k| ColRef::from_slice(pair[k].orbit.start()));
            (to - from).norm_l2() / pair[1].orbit.size()
        };
        let mut way = vec![0.0];
        way.extend(
            points[back_at..]
                .windows(2)
                .map(step)
                .scan(0.0, |sum, length| {
                    *sum += length;
                    Some(*sum)
                }),
        );
        let half = 0.5 * way.last().copied().unwrap_or(0.0);
        let turns = |k: &usize| {
            let [a, b, c] = [k - 1, *k, k + 1].map(|k| points[k].parameter);
            (b - a) * (c - b) < 0.0
        };
        let off = |k: usize| (way[k - back_at] - half).abs();
        let turn = (self.points..points.len() - 1)
            .filter(turns)
            .min_by(|a, b| off(*a).total_cmp(&off(*b)))
            .unwrap_or(self.points);
        let parameter = points[turn].parameter;
        branch.points.truncate(turn + 1);
        let passed = branch.bifurcations.len() - self.bifurcations;
        branch.bifurcations.truncate(self.bifurcations + passed / 2);
        let why = "from there the walk came back over its own points; try a smaller tolerance or the other method".to_owned();
        branch.endings.push(Termination::Failed { why, parameter });
    }
}

fn never_touches(point: &BranchPoint) -> bool {
    let orbit = &point.orbit;
    orbit.contacts == 0 && orbit.switches == 0 && orbit.max_penetration_m == 0.0
}
