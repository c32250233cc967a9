//! Orbits that never touch a stop, of which a plant has one at each value of a key.
//!
//! On a stiff stop a branch turns at its grazing within less than the accuracy of its orbits. A walk may then turn round there and run
//! back over the orbits that it came along: it left them and is among them again, at a value that it has passed.

use super::branch::{Bifurcation, Branch, BranchKind, BranchPoint, Ending};

/// Where a walk left the orbits that never touch.
#[derive(Debug, Clone, Copy)]
pub(super) struct Left {
    /// Points so far.
    points: usize,
    /// Bifurcations so far, the grazing being the last.
    bifurcations: usize,
}

impl Left {
    /// Where a step from the last point of a branch leaves them; `passed` is what it passes.
    pub fn between(before: &BranchPoint, after: &BranchPoint, branch: &Branch, passed: &[Bifurcation]) -> Option<Self> {
        let grazing = passed.iter().position(|found| found.kind == BranchKind::Grazing).map_or(passed.len(), |place| place + 1);
        let leaves = never_touches(before) && !never_touches(after);
        leaves.then(|| Self { points: branch.points.len(), bifurcations: branch.bifurcations.len() + grazing })
    }

    /// True when the last point of a branch lies where it was before it left.
    pub fn comes_back(self, branch: &Branch) -> bool {
        let Some(last) = branch.points.last().filter(|last| never_touches(last)) else { return false };
        branch.points[..self.points].windows(2).any(|pair| {
            let (low, high) = (pair[0].parameter.min(pair[1].parameter), pair[0].parameter.max(pair[1].parameter));
            pair.iter().all(never_touches) && low < last.parameter && last.parameter < high
        })
    }

    /// Ends a branch there.
    pub fn end(self, branch: &mut Branch) {
        branch.points.truncate(self.points);
        branch.bifurcations.truncate(self.bifurcations);
        let grazing = branch.bifurcations.last().map(|found| found.at.parameter);
        let Some(parameter) = grazing.or(branch.points.last().map(|last| last.parameter)) else { return };
        let why = "from there the walk came back over the orbits that never touch; try a smaller tolerance or the other method".to_owned();
        branch.endings.push(Ending::Grazing { why, parameter });
    }
}

fn never_touches(point: &BranchPoint) -> bool {
    let orbit = &point.orbit;
    orbit.contacts == 0 && orbit.switches == 0 && orbit.max_penetration_m == 0.0
}
