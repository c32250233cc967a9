//! What a branch passes between two of its points.

use super::branch::{Bifurcation, Branch, BranchKind, BranchPoint};
use super::follow::Following;
use super::place::{Place, point};
use crate::continuation::{Metric, Position, Step, locate};
use crate::orbit::{Orbit, OrbitMethod, determinant_at, multipliers, nearest_extremum_m, nearest_pair_to_circle, pairs_outside};

/// Distance beside their size of the halves of a doubled orbit that is the one that it left: a fold is located to a share of the step, and
/// the distance goes with its root.
const MERGED: f64 = 0.01;

/// What two neighbouring orbits have between them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Passed {
    kind: BranchKind,
    /// Of a grazing: contacts on its side of fewer. Of a level: its number.
    which: u64,
}

impl Following {
    /// Everything that happens between two points, in the order of the curve.
    ///
    /// # Errors
    /// As [`Following::walk`].
    pub(super) fn between<M: OrbitMethod>(&self, method: &M, a: &Place<M>, b: &Place<M>) -> Result<Vec<Bifurcation>, M::Error> {
        Ok(self.on_the_way(method, a, b)?.into_iter().map(|(_, found)| found).collect())
    }

    /// The same without what lies beyond a place between the two points.
    ///
    /// # Errors
    /// As [`Following::walk`].
    pub(super) fn until<M: OrbitMethod>(
        &self,
        method: &M,
        (a, b): (&Place<M>, &Place<M>),
        end: &Position,
    ) -> Result<Vec<Bifurcation>, M::Error> {
        let end = self.along(&a.step, &b.step, end);
        let found = self.on_the_way(method, a, b)?.into_iter().filter(|(along, _)| *along <= end);
        Ok(found.map(|(_, found)| found).collect())
    }

    /// How far along the chord of a step a place lies, in the metric.
    fn along<L>(&self, from: &Step<L>, to: &Step<L>, place: &Position) -> f64 {
        let metric = Metric::at(&from.position, self.parameter_scale());
        metric.inner(&metric.unit(from.position.to(&to.position)), &from.position.to(place))
    }

    fn on_the_way<M: OrbitMethod>(&self, method: &M, a: &Place<M>, b: &Place<M>) -> Result<Vec<(f64, Bifurcation)>, M::Error> {
        let (one, two) = (&a.point.orbit, &b.point.orbit);
        let turns = a.step.tangent.parameter * b.step.tangent.parameter < 0.0;
        let mut found = Vec::new();
        for passed in passed(one, two, turns).into_iter().chain(self.levels_passed(method, a, b)) {
            let kind = passed.kind;
            let level = if kind == BranchKind::Level { self.levels.get(passed.which as usize) } else { None };
            let value = |step: &Step<M::Local>| match level {
                Some(level) => method.shot(&step.local).map_or(0.0, |shot| level.off(shot)),
                None => test(method, passed, step, one),
            };
            let place = locate(method, &self.corrector, self.parameter_scale(), (&a.step, &b.step), self.resolution, value);
            let Some(place) = place else { continue };
            let at = point(method, &place)?;
            // Two real multipliers that meet outside the circle are no torus.
            let on_circle = at.orbit.multipliers.iter().any(|value| value.im > 1e-9 && (value.norm() - 1.0).abs() < 1e-4);
            if kind != BranchKind::NeimarkSacker || on_circle {
                let level = level.map(|level| level.text.clone());
                let found_here = match kind {
                    BranchKind::Grazing => Bifurcation::grazing(at, method.shot(&place.local)?),
                    kind => Bifurcation { kind, level, stop: None, at },
                };
                found.push((self.along(&a.step, &b.step, &place.position), found_here));
            }
        }
        // By the key alone what lies about a fold has no order.
        found.sort_by(|x, y| x.0.total_cmp(&y.0));
        Ok(found)
    }
}

impl Following {
    /// Levels that are passed between two points.
    fn levels_passed<M: OrbitMethod>(&self, method: &M, a: &Place<M>, b: &Place<M>) -> Vec<Passed> {
        if self.levels.is_empty() {
            return Vec::new();
        }
        let (Some(one), Some(two)) = (a.readings(method, self), b.readings(method, self)) else { return Vec::new() };
        let signs = one.here.levels.iter().zip(&two.here.levels).map(|(one, two)| (*one > 0.0) != (*two > 0.0));
        signs.enumerate().filter(|(_, passes)| *passes).map(|(k, _)| Passed { kind: BranchKind::Level, which: k as u64 }).collect()
    }
}

/// Adds what was passed between the last point of a branch and another one: where a bifurcation lies nearer than the accuracy, the other
/// method may have the place on its other side.
pub(super) fn add_passed(turns: bool, at: &BranchPoint, branch: &mut Branch) {
    let Some(last) = branch.points.last() else { return };
    let found = passed(&last.orbit, &at.orbit, turns);
    branch.bifurcations.extend(found.into_iter().map(|passed| Bifurcation { kind: passed.kind, level: None, stop: None, at: at.clone() }));
}

/// Takes the last labels of a doubled branch that has come to the one that it left: there it turns, and meets its own other half, which is
/// the doubling that the other branch tells.
pub(super) fn drop_doubling(branch: &mut Branch) {
    let is_doubling = |found: &Bifurcation| {
        let orbit = &found.at.orbit;
        let apart = orbit.halves_apart().map_or(f64::INFINITY, |apart| apart.iter().map(|d| d * d).sum::<f64>().sqrt());
        matches!(found.kind, BranchKind::Fold | BranchKind::BranchPoint) && apart < MERGED * orbit.size()
    };
    while branch.bifurcations.last().is_some_and(is_doubling) {
        branch.bifurcations.pop();
    }
}

/// What must lie between two orbits of a branch that turns between them, or does not.
fn passed(one: &Orbit, two: &Orbit, turns: bool) -> Vec<Passed> {
    let passes = |s: f64| one.determinant_at(s) * two.determinant_at(s) < 0.0;
    let found = [
        (BranchKind::Fold, turns),
        (BranchKind::BranchPoint, passes(1.0) != turns),
        (BranchKind::PeriodDoubling, passes(-1.0)),
        (BranchKind::NeimarkSacker, one.pairs_outside() != two.pairs_outside()),
    ];
    let found = found.into_iter().filter(|(_, is_there)| *is_there).map(|(kind, _)| Passed { kind, which: 0 });
    let (fewer, more) = (one.contacts.min(two.contacts), one.contacts.max(two.contacts));
    found.chain((fewer..more).map(|which| Passed { kind: BranchKind::Grazing, which })).collect()
}

/// The function of the curve that is zero at a bifurcation, for two points on its two sides.
fn test<M: OrbitMethod>(method: &M, passed: Passed, step: &Step<M::Local>, before: &Orbit) -> f64 {
    if passed.kind == BranchKind::Fold {
        return step.tangent.parameter;
    }
    let Ok(shot) = method.shot(&step.local) else { return 0.0 };
    if passed.kind == BranchKind::Grazing {
        let distance = nearest_extremum_m(shot).map_or(0.0, f64::abs);
        return if shot.contacts <= passed.which { -distance } else { distance };
    }
    let map = &shot.block_map;
    match passed.kind {
        BranchKind::PeriodDoubling => determinant_at(map, -1.0),
        BranchKind::NeimarkSacker => {
            // The count decides on the sign: where real multipliers meet on the way, that of any product says nothing.
            let Some(values) = multipliers(map) else { return 0.0 };
            let distance = nearest_pair_to_circle(&values);
            if pairs_outside(&values) == before.pairs_outside() { -distance } else { distance }
        }
        _ => determinant_at(map, 1.0) * step.tangent.parameter.signum(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 18 contacts before and 16 after: one goes, then another.
    #[test]
    fn two_contacts_that_go_in_one_step_are_two_grazings() {
        let [one, two] = [18, 16].map(|contacts| Orbit { contacts, ..Orbit::of_cycles(11) });
        let grazing = |which| Passed { kind: BranchKind::Grazing, which };
        assert_eq!(passed(&one, &two, false), [grazing(16), grazing(17)]);
        assert_eq!(passed(&two, &one, false), [grazing(16), grazing(17)]);
    }
}
