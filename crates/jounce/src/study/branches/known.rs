//! Whether an orbit lies on a branch that is known, and where branches are one.
//!
//! ```text
//! F = a + s c,   <c, (u, p) - F> = 0,   R(u, p) = 0
//! ```
//!
//! `a` is a point of the branch, `c` the unit chord to the next one, and `F` the foot of the orbit on it. The curve meets the plane across the
//! chord through `F` once, at folds too, and Newton from `F` finds where. The orbit lies on the branch when it is that place.

use super::branch::{Branch, BranchKind, BranchPoint, Ending};
use super::follow::Following;
use crate::continuation::{Direction, Metric, Position, correct};
use crate::orbit::{Harvester, Orbit, Shooting};

/// Distance beside their size below which two orbits are one, ...
const SAME: f64 = 1e-4;

/// ... or in goals of Newton, where marches are so coarse that those are more.
const SAME_GOALS: f64 = 10.0;

/// Farthest that an orbit on the curve may lie from its chord, beside the length of that: a curve that turns by a right angle at a corner.
const OFF: f64 = 0.5;

/// Farthest from a doubling that the place where a branch merges may lie, beside the length of its last step.
const AT_END: f64 = 0.2;

/// Points at which one branch is compared with another, first and last included.
const COMPARED: usize = 5;

/// Two neighbouring points of a branch.
struct Chord {
    metric: Metric,
    from: Position,
    /// Unit vector to the other point.
    ahead: Direction,
    length: f64,
}

/// Where an orbit lies beside a chord.
struct Foot {
    /// The place on the chord.
    at: Position,
    /// The orbit, at the drive cycle that was looked at.
    orbit: Position,
    /// Distance between the two, in the metric.
    off: f64,
}

impl Chord {
    fn between(a: &BranchPoint, b: &BranchPoint, parameter_scale: f64) -> Self {
        let [from, to] = [a, b].map(position);
        let metric = Metric::at(&from, parameter_scale);
        let way = from.to(&to);
        let length = metric.length(&way);
        Self { metric, from, ahead: metric.unit(way), length }
    }

    /// The foot of an orbit that may lie on the curve here. An end of the branch may be passed by as much as the last step.
    fn foot(&self, orbit: Position, is_first: bool, is_last: bool) -> Option<Foot> {
        let along = self.metric.inner(&self.ahead, &self.from.to(&orbit));
        let slack = OFF * self.length;
        let low = if is_first { -self.length } else { -slack };
        let high = self.length + if is_last { self.length } else { slack };
        let at = self.from.moved(&self.ahead, along);
        let off = self.metric.length(&at.to(&orbit));
        ((low..=high).contains(&along) && off <= slack).then_some(Foot { at, orbit, off })
    }
}

fn position(point: &BranchPoint) -> Position {
    Position { unknown: point.orbit.start().to_vec(), parameter: point.parameter }
}

/// An orbit at each of its drive cycles.
fn looks(orbit: &Orbit, parameter: f64) -> impl Iterator<Item = Position> {
    let cycles = orbit.period_cycles as usize;
    orbit.looks.iter().take(cycles).map(move |look| Position { unknown: look.clone(), parameter })
}

impl Branch {
    /// True when an orbit lies on the branch, at whichever of its drive cycles it is looked at; `shooting` is that of its period.
    pub(super) fn holds<H: Harvester>(&self, following: &Following, shooting: &Shooting<'_, H>, (orbit, parameter): (&Orbit, f64)) -> bool {
        if self.period_cycles != orbit.period_cycles {
            return false;
        }
        let same = (SAME_GOALS * following.corrector.goal).max(SAME);
        if let [only] = &self.points[..] {
            let only = position(only);
            let metric = Metric::at(&only, following.parameter_scale());
            return looks(orbit, parameter).any(|look| metric.length(&only.to(&look)) < same);
        }
        let last = self.points.len().saturating_sub(2);
        let mut feet: Vec<(Chord, Foot)> = Vec::new();
        for (k, pair) in self.points.windows(2).enumerate() {
            for look in looks(orbit, parameter) {
                let chord = Chord::between(&pair[0], &pair[1], following.parameter_scale());
                if let Some(foot) = chord.foot(look, k == 0, k == last) {
                    feet.push((chord, foot));
                }
            }
        }
        feet.sort_by(|one, two| (one.1.off / one.0.length).total_cmp(&(two.1.off / two.0.length)));
        feet.into_iter().any(|(chord, foot)| {
            let found = correct(shooting, &following.corrector, &chord.metric, &chord.ahead, foot.at);
            found.is_ok_and(|found| chord.metric.length(&found.position.to(&foot.orbit)) < same)
        })
    }

    /// True when all of a branch lies on another one.
    pub(super) fn is_part_of<H: Harvester>(&self, whole: &Branch, following: &Following, shooting: &Shooting<'_, H>) -> bool {
        let last = self.points.len() - 1;
        let mut compared = (0..COMPARED).map(|k| &self.points[k * last / (COMPARED - 1)]);
        self.period_cycles == whole.period_cycles && compared.all(|point| whole.holds(following, shooting, (&point.orbit, point.parameter)))
    }

    /// Places where the branch merged with one of half its period, each with the chord that led there.
    fn merged(&self, following: &Following) -> Vec<(Chord, Position)> {
        let count = self.points.len();
        let ends = match (&self.endings[..], count) {
            (_, ..2) => Vec::new(),
            ([first, last], _) => vec![(first, [1, 0]), (last, [count - 2, count - 1])],
            (ends, _) => ends.iter().map(|last| (last, [count - 2, count - 1])).collect(),
        };
        let merged = ends.into_iter().filter(|(ending, _)| **ending == Ending::Merged);
        let place = |(_, pair): (&Ending, [usize; 2])| {
            let [a, b] = pair.map(|k| &self.points[k]);
            let (from, to) = (a.orbit.halves_apart()?, b.orbit.halves_apart()?);
            let inner = |one: &[f64], two: &[f64]| one.iter().zip(two).map(|(x, y)| x * y).sum::<f64>();
            // Along the curve the distance of the halves goes through zero in proportion.
            let share = inner(&from, &from) / (inner(&from, &from) - inner(&from, &to));
            let chord = Chord::between(a, b, following.parameter_scale());
            let at = chord.from.moved(&chord.ahead, share * chord.length);
            share.is_finite().then_some((chord, at))
        };
        merged.filter_map(place).collect()
    }
}

/// True when one of the branches ends at a period doubling: of all doublings it is the nearest to that end.
pub(super) fn is_end_of_one(branches: &[Branch], doubling: &BranchPoint, following: &Following) -> bool {
    let cycles = doubling.orbit.period_cycles;
    let ends = branches.iter().filter(|branch| branch.period_cycles == 2 * cycles).flat_map(|branch| branch.merged(following));
    let parents = branches.iter().filter(|branch| branch.period_cycles == cycles);
    let doublings = parents.flat_map(|branch| &branch.bifurcations).filter(|found| found.kind == BranchKind::PeriodDoubling);
    let doublings: Vec<&BranchPoint> = doublings.map(|found| &found.at).collect();
    let away = |(chord, end): &(Chord, Position), at: &BranchPoint| {
        looks(&at.orbit, at.parameter).map(|look| chord.metric.length(&end.to(&look))).fold(f64::INFINITY, f64::min)
    };
    ends.into_iter().any(|end| {
        let own = away(&end, doubling);
        own < AT_END * end.0.length && doublings.iter().all(|other| own <= away(&end, other))
    })
}
