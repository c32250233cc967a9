//! Tests whether an orbit lies on a known branch, and whether one branch is a part of another.
//!
//! ```text
//! F = a + s c,   <c, (u, p) - F> = 0,   R(u, p) = 0
//! ```
//!
//! `a` is a point of the branch, `c` the unit chord to the next one, and `F` the projection of the
//! orbit on it. The hyperplane through `F` normal to the chord intersects the curve once, even at a
//! fold. Newton's method finds the intersection from `F`. The orbit lies on the branch if it is
//! that intersection.

use crate::branches::branch::{Branch, BranchKind, BranchPoint, Termination};
use crate::branches::branch_tracer::tracer::BranchTracer;
use jounce_continuation::{Direction, Metric, Position, correct};
use jounce_orbits::{Orbit, ParametricModel, Shooting};
use std::rc::Rc;

/// Relative distance below which two orbits are the same.
pub(crate) const SAME_ORBIT_DISTANCE: f64 = 1e-4;

/// This distance in tolerances of Newton's method; the larger one counts.
const SAME_ORBIT_GOALS: f64 = 10.0;

/// Largest distance of the curve from its chord, relative to the chord; a right-angled corner
/// reaches it.
const MAX_DISTANCE_FROM_CHORD: f64 = 0.5;

/// Largest distance between a period doubling and the end of a branch that merges there, relative
/// to the last chord.
const MAX_DISTANCE_AT_MERGE: f64 = 0.2;

/// Number of points at which two branches are compared, the first and the last included.
const COMPARED_POINTS: usize = 5;

/// Two neighbouring points of a branch.
struct Chord {
    metric: Metric,
    from: Position,
    /// Unit vector to the other point.
    direction: Direction,
    length: f64,
}

/// Projection of an orbit onto a chord.
struct ChordProjection {
    /// Position on the chord.
    at: Position,
    /// The orbit, at one of its drive cycles.
    orbit: Position,
    /// Distance between the two, in the metric.
    off: f64,
}

impl Chord {
    fn between(a: &BranchPoint, b: &BranchPoint, parameter_scale: f64) -> Self {
        let [from, to] = [a, b].map(position);
        let metric = Metric::at(&from, parameter_scale);
        let step = from.to(&to);
        let length = metric.length(&step);
        Self {
            metric,
            from,
            direction: metric.unit(step),
            length,
        }
    }

    /// Returns the projection of an orbit that may lie on this part of the curve. At an end of the
    /// branch the projection may lie one chord beyond.
    fn project(&self, orbit: Position, is_first: bool, is_last: bool) -> Option<ChordProjection> {
        let along = self.metric.inner(&self.direction, &self.from.to(&orbit));
        let slack = MAX_DISTANCE_FROM_CHORD * self.length;
        let low = if is_first { -self.length } else { -slack };
        let high = self.length + if is_last { self.length } else { slack };
        let at = self.from.offset_along(&self.direction, along);
        let distance = self.metric.length(&at.to(&orbit));
        ((low..=high).contains(&along) && distance <= slack).then_some(ChordProjection {
            at,
            orbit,
            off: distance,
        })
    }
}

fn position(point: &BranchPoint) -> Position {
    Position {
        unknown: point.orbit.start().to_vec(),
        parameter: point.parameter,
    }
}

/// Returns the positions of an orbit at each of its drive cycles.
fn compared_positions(orbit: &Orbit, parameter: f64) -> impl Iterator<Item = Position> {
    let cycles = orbit.period_cycles as usize;
    orbit
        .strobe_states
        .iter()
        .take(cycles)
        .map(move |candidate| Position {
            unknown: candidate.clone(),
            parameter,
        })
}

impl Branch {
    /// True when an orbit lies on the branch, shifted by any number of drive cycles; `shooting` has the period of the orbit.
    pub(in crate::branches) fn holds<H: ParametricModel>(
        &self,
        tracer: &BranchTracer,
        shooting: &Shooting<'_, H>,
        (orbit, parameter): (&Orbit, f64),
    ) -> bool {
        if self.period_cycles != orbit.period_cycles {
            return false;
        }
        let same = (SAME_ORBIT_GOALS * tracer.corrector.goal).max(SAME_ORBIT_DISTANCE);
        if let [only] = &self.points[..] {
            let only = position(only);
            let metric = Metric::at(&only, tracer.parameter_scale());
            return compared_positions(orbit, parameter)
                .any(|candidate| metric.length(&only.to(&candidate)) < same);
        }
        let last = self.points.len().saturating_sub(2);
        let mut projections: Vec<(Rc<Chord>, ChordProjection)> = Vec::new();
        for (k, pair) in self.points.windows(2).enumerate() {
            let chord = Rc::new(Chord::between(&pair[0], &pair[1], tracer.parameter_scale()));
            let near = compared_positions(orbit, parameter)
                .filter_map(|candidate| chord.project(candidate, k == 0, k == last));
            projections.extend(near.map(|projection| (Rc::clone(&chord), projection)));
        }
        projections
            .sort_by(|one, two| (one.1.off / one.0.length).total_cmp(&(two.1.off / two.0.length)));
        projections.into_iter().any(|(chord, projection)| {
            let corrected = correct(
                shooting,
                &tracer.corrector,
                &chord.metric,
                &chord.direction,
                projection.at,
            );
            corrected.is_ok_and(|corrected| {
                chord
                    .metric
                    .length(&corrected.position.to(&projection.orbit))
                    < same
            })
        })
    }

    /// True when a branch lies entirely on another one.
    pub(super) fn is_part_of<H: ParametricModel>(
        &self,
        complete: &Branch,
        tracer: &BranchTracer,
        shooting: &Shooting<'_, H>,
    ) -> bool {
        let last = self.points.len() - 1;
        let mut compared =
            (0..COMPARED_POINTS).map(|k| &self.points[k * last / (COMPARED_POINTS - 1)]);
        self.period_cycles == complete.period_cycles
            && compared
                .all(|point| complete.holds(tracer, shooting, (&point.orbit, point.parameter)))
    }

    /// Returns the ends at which the branch merges with one of half its period, each with the last
    /// chord.
    fn merged(&self, tracer: &BranchTracer) -> Vec<(Chord, Position)> {
        let count = self.points.len();
        let ends = match (&self.endings[..], count) {
            (_, ..2) => Vec::new(),
            ([first, last], _) => vec![(first, [1, 0]), (last, [count - 2, count - 1])],
            (ends, _) => ends
                .iter()
                .map(|last| (last, [count - 2, count - 1]))
                .collect(),
        };
        let merged = ends
            .into_iter()
            .filter(|(ending, _)| **ending == Termination::Merged);
        let point = |(_, pair): (&Termination, [usize; 2])| {
            let [a, b] = pair.map(|k| &self.points[k]);
            let (from, to) = (
                a.orbit.half_period_difference()?,
                b.orbit.half_period_difference()?,
            );
            let inner =
                |one: &[f64], two: &[f64]| one.iter().zip(two).map(|(x, y)| x * y).sum::<f64>();
            // The distance of the halves is linear along the curve near its zero.
            let share = inner(&from, &from) / (inner(&from, &from) - inner(&from, &to));
            let chord = Chord::between(a, b, tracer.parameter_scale());
            let at = chord
                .from
                .offset_along(&chord.direction, share * chord.length);
            share.is_finite().then_some((chord, at))
        };
        merged.filter_map(point).collect()
    }
}

/// True when a branch ends at this period doubling, the nearest one to its end.
pub(super) fn is_end_of_one(
    branches: &[Branch],
    doubling: &BranchPoint,
    tracer: &BranchTracer,
) -> bool {
    let cycles = doubling.orbit.period_cycles;
    let ends = branches
        .iter()
        .filter(|branch| branch.period_cycles == 2 * cycles)
        .flat_map(|branch| branch.merged(tracer));
    let parents = branches
        .iter()
        .filter(|branch| branch.period_cycles == cycles);
    let doublings = parents
        .flat_map(|branch| &branch.bifurcations)
        .filter(|bifurcation| bifurcation.kind == BranchKind::PeriodDoubling);
    let doublings: Vec<&BranchPoint> = doublings.map(|bifurcation| &bifurcation.at).collect();
    let away = |(chord, end): &(Chord, Position), at: &BranchPoint| {
        compared_positions(&at.orbit, at.parameter)
            .map(|candidate| chord.metric.length(&end.to(&candidate)))
            .fold(f64::INFINITY, f64::min)
    };
    ends.into_iter().any(|end| {
        let distance = away(&end, doubling);
        distance < MAX_DISTANCE_AT_MERGE * end.0.length
            && doublings.iter().all(|other| distance <= away(&end, other))
    })
}
