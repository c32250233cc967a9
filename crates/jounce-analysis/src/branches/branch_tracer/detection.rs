//! Detection of the events between two points of a branch.

use super::orbit_point::{OrbitPoint, point};
use super::tracer::BranchTracer;
use crate::branches::branch::{Bifurcation, Branch, BranchKind, BranchPoint};
use crate::branches::events::{
    Extremum, NotProved, ProofGap, StepEvents, TestFunction, doubling, extrema, fold, torus,
};
use jounce_continuation::{CurvePoint, Metric, Position, locate};
use jounce_linalg::c64;
use jounce_orbits::{
    Orbit, OrbitMethod, ShootingEvaluation, determinant_at, multipliers, nearest_pair_to_circle,
    outside_count,
};

/// Event between two neighbouring orbits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum DetectedEvent {
    Fold,
    BranchPoint,
    PeriodDoubling,
    NeimarkSacker,
    /// This turning point passes the surface of its stop.
    Grazing(Extremum),
    /// Level of this index.
    Level(usize),
}

impl DetectedEvent {
    fn kind(self) -> BranchKind {
        match self {
            DetectedEvent::Fold => BranchKind::Fold,
            DetectedEvent::BranchPoint => BranchKind::BranchPoint,
            DetectedEvent::PeriodDoubling => BranchKind::PeriodDoubling,
            DetectedEvent::NeimarkSacker => BranchKind::NeimarkSacker,
            DetectedEvent::Grazing(_) => BranchKind::Grazing,
            DetectedEvent::Level(_) => BranchKind::Level,
        }
    }

    /// Returns the test function of an event of the multipliers.
    pub(super) fn test_function(self) -> Option<TestFunction> {
        match self {
            DetectedEvent::PeriodDoubling => Some(doubling),
            DetectedEvent::NeimarkSacker => Some(torus),
            DetectedEvent::BranchPoint => Some(fold),
            _ => None,
        }
    }
}

impl BranchTracer {
    /// Returns the distance of a position along the chord of a step, in the metric.
    pub(super) fn along<L>(
        &self,
        from: &CurvePoint<L>,
        to: &CurvePoint<L>,
        position: &Position,
    ) -> f64 {
        let metric = Metric::at(&from.position, self.parameter_scale());
        metric.inner(
            &metric.unit(from.position.to(&to.position)),
            &from.position.to(position),
        )
    }

    /// Returns the events between two points.
    ///
    /// # Errors
    /// As [`BranchTracer::walk`].
    pub(in crate::branches) fn between<M: OrbitMethod>(
        &self,
        method: &M,
        a: &OrbitPoint<M>,
        b: &OrbitPoint<M>,
    ) -> Result<StepEvents, M::Error> {
        let turns = a.step.tangent.parameter * b.step.tangent.parameter < 0.0;
        let ends = [a, b].map(|end| end.point.parameter);
        let mut events = StepEvents::default();
        for event in crossed_events(&a.point.orbit, &b.point.orbit, turns)
            .into_iter()
            .chain(self.read_between(method, a, b))
        {
            let located = match self.locate_event(method, event, (a, b)) {
                Some(step) => self.located(method, event, (a, b), step)?,
                None => None,
            };
            match located {
                Some((along, event)) => events.add(along, event, ends),
                None => NotProved::add(
                    &mut events.not_proved,
                    event.kind(),
                    ends,
                    ProofGap::NotLocated,
                ),
            }
        }
        Ok(events)
    }

    /// Returns a located event with its distance along the step; `None` for a Neimark-Sacker point
    /// whose multipliers nearest to the unit circle are real: two of them passed +1 or -1.
    fn located<M: OrbitMethod>(
        &self,
        method: &M,
        event: DetectedEvent,
        (a, b): (&OrbitPoint<M>, &OrbitPoint<M>),
        step: CurvePoint<M::Evaluation>,
    ) -> Result<Option<(f64, Bifurcation)>, M::Error> {
        let at = point(method, &step)?;
        if event == DetectedEvent::NeimarkSacker && !is_pair_nearest(&at.orbit.multipliers) {
            return Ok(None);
        }
        let stops = &method.shot(&step.local)?.kernel.plant.system.stops;
        let (level, stop) = match event {
            DetectedEvent::Level(number) => (Some(self.levels[number].text.clone()), None),
            DetectedEvent::Grazing(turn) => (
                None,
                stops.get(turn.from.port).map(|stop| stop.name.clone()),
            ),
            _ => (None, None),
        };
        let event = Bifurcation {
            kind: event.kind(),
            level,
            stop,
            at,
            parameter_error: self.parameter_error(method, event, (a, b), &step),
            neighbours: Some([a, b].map(|end| end.point.parameter)),
        };
        Ok(Some((self.along(&a.step, &b.step, &step.position), event)))
    }

    /// Returns the point where the test function of an event is zero; `None` where it is not
    /// found.
    fn locate_event<M: OrbitMethod>(
        &self,
        method: &M,
        event: DetectedEvent,
        (a, b): (&OrbitPoint<M>, &OrbitPoint<M>),
    ) -> Option<CurvePoint<M::Evaluation>> {
        let value = |step: &CurvePoint<M::Evaluation>| {
            let evaluation = method.shot(&step.local).ok()?;
            self.value(event, (a, b), step, evaluation)
        };
        locate(
            method,
            &self.corrector,
            self.parameter_scale(),
            (&a.step, &b.step),
            self.resolution,
            value,
        )
    }

    /// Returns the test function of an event between two points, of an orbit at a point of the
    /// curve; `None` where its multipliers are unknown.
    pub(super) fn value<M: OrbitMethod>(
        &self,
        event: DetectedEvent,
        (a, b): (&OrbitPoint<M>, &OrbitPoint<M>),
        step: &CurvePoint<M::Evaluation>,
        evaluation: &ShootingEvaluation,
    ) -> Option<f64> {
        Some(match event {
            DetectedEvent::Fold => step.tangent.parameter,
            DetectedEvent::Grazing(turn) => {
                let length = self.along(&a.step, &b.step, &b.step.position);
                let share = self.along(&a.step, &b.step, &step.position) / length;
                turn.past_m(evaluation, share)
            }
            DetectedEvent::Level(number) => self.levels[number].relative_difference(evaluation),
            _ => return of_multipliers(event, step, (evaluation, &a.point.orbit)),
        })
    }

    /// Returns grazings and level crossings between two points, by the signs of their test
    /// functions.
    fn read_between<M: OrbitMethod>(
        &self,
        method: &M,
        a: &OrbitPoint<M>,
        b: &OrbitPoint<M>,
    ) -> Vec<DetectedEvent> {
        let Some(ends) = self.ends(method, a, b) else {
            return Vec::new();
        };
        let [one, two] = ends.map(|end| &end.readings.current.levels);
        let levels = (0..self.levels.len())
            .filter(|k| (one[*k] > 0.0) != (two[*k] > 0.0))
            .map(DetectedEvent::Level);
        extrema(ends)
            .into_iter()
            .filter(Extremum::grazes)
            .map(DetectedEvent::Grazing)
            .chain(levels)
            .collect()
    }
}

/// Adds the bifurcations between the last point of a branch and another one. The methods may
/// disagree on the side of a bifurcation nearer than the accuracy.
pub(super) fn add_crossings(turns: bool, at: &BranchPoint, branch: &mut Branch) {
    let Some(last) = branch.points.last() else {
        return;
    };
    let grazes = (last.orbit.contacts != at.orbit.contacts).then_some(BranchKind::Grazing);
    let kinds = crossed_events(&last.orbit, &at.orbit, turns)
        .into_iter()
        .map(DetectedEvent::kind)
        .chain(grazes);
    let neighbours = Some([last.parameter, at.parameter]);
    branch.bifurcations.extend(kinds.map(|kind| Bifurcation {
        kind,
        level: None,
        stop: None,
        at: at.clone(),
        parameter_error: None,
        neighbours,
    }));
}

/// Returns the events implied by two orbits; `turns` is true where the branch turns between them.
fn crossed_events(one: &Orbit, two: &Orbit, turns: bool) -> Vec<DetectedEvent> {
    let candidates = [
        (DetectedEvent::Fold, turns),
        (DetectedEvent::BranchPoint, one.passes(1.0, two) != turns),
        (DetectedEvent::PeriodDoubling, one.passes(-1.0, two)),
        (DetectedEvent::NeimarkSacker, one.pair_crosses_circle(two)),
    ];
    candidates
        .into_iter()
        .filter(|(_, is_there)| *is_there)
        .map(|(event, _)| event)
        .collect()
}

/// True where the multiplier nearest to the unit circle belongs to a complex pair.
fn is_pair_nearest(multipliers: &[c64]) -> bool {
    let distance = |value: &&c64| (value.norm() - 1.0).abs();
    multipliers
        .iter()
        .min_by(|a, b| distance(a).total_cmp(&distance(b)))
        .is_some_and(|value| value.im != 0.0)
}

/// Returns the function of the multipliers that is zero at a bifurcation between two points; `None`
/// where they do not converge.
fn of_multipliers<L>(
    event: DetectedEvent,
    step: &CurvePoint<L>,
    (evaluation, before): (&ShootingEvaluation, &Orbit),
) -> Option<f64> {
    let map = &evaluation.block_map;
    Some(match event {
        DetectedEvent::PeriodDoubling => determinant_at(map, -1.0),
        DetectedEvent::NeimarkSacker => {
            // The number outside gives the sign: products also change theirs at real multipliers
            // whose product is one.
            let values = multipliers(map)?;
            let distance = nearest_pair_to_circle(&values);
            if outside_count(&values).abs_diff(before.outside_count()) < 2 {
                -distance
            } else {
                distance
            }
        }
        _ => determinant_at(map, 1.0) * step.tangent.parameter.signum(),
    })
}
