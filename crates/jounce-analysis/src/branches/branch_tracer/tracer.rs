//! Continuation of one branch from one of its orbits, with its events.

use super::adapt_order::COARSER_BELOW_ERROR;
use super::detection::add_crossings;
use super::ending::{end, failure_at_edge};
use super::halves::turns_round;
use super::orbit_point::{OrbitPoint, point};
use super::range_end::RangeCrossing;
use super::tracer_start::TracerStart;
use crate::branches::branch::{Branch, Termination};
use crate::branches::events::{NotProved, QuantityLevel};
use jounce_continuation::{
    Checkpoint, Continuation, CorrectedPoint, Corrector, CurvePoint, Direction, Metric, Position,
    StepControl, correct_at, tangent,
};
use jounce_orbits::OrbitMethod;

/// Default length, in the metric, to which a bifurcation is located.
pub(crate) const RESOLUTION: f64 = 1e-8;

/// Newton's goal relative to the tolerance of an integration. One more iteration would square the
/// residual; the error estimate states it.
const NEWTON_GOAL_FACTOR: f64 = 50.0;

/// Limits of the goal. With coarser integrations no correction is more accurate than they are.
const NEWTON_GOAL_LIMITS: (f64, f64) = (1e-11, 1e-6);

/// Largest number of evaluations of a correction.
const MAX_EVALUATIONS: u32 = 8;

/// Largest number of points of a branch.
const MAX_POINTS: usize = 4000;

/// Returns Newton's goal for a tolerance of integration.
fn correction_goal(tolerance: f64) -> f64 {
    (NEWTON_GOAL_FACTOR * tolerance)
        .clamp(NEWTON_GOAL_LIMITS.0, NEWTON_GOAL_LIMITS.1.max(tolerance))
}

/// Returns the scale of the parameter in the metric.
pub(in crate::branches) fn parameter_scale(range: (f64, f64)) -> f64 {
    (range.1 - range.0) / 20.0
}

/// Continuation of branches with its settings.
#[derive(Debug, Clone)]
pub struct BranchTracer {
    /// Ends of the range of the key.
    pub range: (f64, f64),
    /// Newton's goal.
    pub corrector: Corrector,
    /// Step size control.
    pub control: StepControl,
    /// Largest number of points.
    pub most_points: usize,
    /// Largest number of drive cycles of all orbits on the branches.
    pub budget: usize,
    /// Length in the metric to which bifurcations are located.
    pub resolution: f64,
    /// Levels of quantities that are labelled.
    pub levels: Vec<QuantityLevel>,
}

/// Points that a step adds to a branch.
struct StepPoints<M: OrbitMethod> {
    points: Vec<OrbitPoint<M>>,
    /// Intervals of the step where the events are not proved complete.
    not_proved: Vec<NotProved>,
    /// True where the step leads to an orbit of fewer cycles.
    merges: bool,
}

impl BranchTracer {
    /// Creates a tracer over a range from the relative tolerance of the integrations, with default
    /// steps and without levels, and without a budget.
    pub(in crate::branches) fn new(range: (f64, f64), tolerance: f64) -> Self {
        Self {
            range,
            corrector: Corrector {
                goal: correction_goal(tolerance),
                most: MAX_EVALUATIONS,
            },
            control: StepControl::default(),
            most_points: MAX_POINTS,
            budget: usize::MAX,
            resolution: RESOLUTION,
            levels: Vec::new(),
        }
    }

    /// Returns the tracer for one more branch of a period, with as many points as the budget
    /// permits; `None` where it permits no step.
    pub(in crate::branches) fn within(&self, branches: &[Branch], cycles: u32) -> Option<Self> {
        let remaining = self
            .budget
            .saturating_sub(branches.iter().map(Branch::work).sum());
        let most_points = self.most_points.min(remaining / cycles as usize);
        (most_points > 1).then(|| Self {
            most_points,
            ..self.clone()
        })
    }

    /// Returns the scale of the parameter in the metric.
    pub fn parameter_scale(&self) -> f64 {
        parameter_scale(self.range)
    }

    /// Follows both directions from the orbit that Newton's method finds near a state in energy
    /// coordinates; `None` where it finds no orbit.
    ///
    /// # Errors
    /// As [`BranchTracer::walk`].
    pub(in crate::branches) fn both_ways<M: OrbitMethod>(
        &self,
        method: &M,
        state: &[f64],
        parameter: f64,
    ) -> Result<Option<Branch>, M::Error> {
        let position = Position {
            unknown: method.unknown_of(state, parameter)?,
            parameter,
        };
        let metric = Metric::at(&position, self.parameter_scale());
        let up = Direction {
            unknown: vec![0.0; position.unknown.len()],
            parameter: 1.0,
        };
        self.both_ways_from(method, || {
            let first = correct_at(method, &self.corrector, &metric, position.clone()).ok()?;
            let direction = tangent(&first.local, &metric, &up)?;
            Some((first, direction))
        })
    }

    /// Continues from an orbit along a tangent and against it, and joins both parts; `None` without
    /// a start.
    ///
    /// # Errors
    /// As [`BranchTracer::walk`].
    pub(in crate::branches) fn both_ways_from<M: OrbitMethod>(
        &self,
        method: &M,
        start: impl Fn() -> Option<(CorrectedPoint<M::Evaluation>, Direction)>,
    ) -> Result<Option<Branch>, M::Error> {
        let mut ways = Vec::new();
        for sign in [-1.0, 1.0] {
            let Some((first, mut direction)) = start() else {
                return Ok(None);
            };
            direction.unknown.iter_mut().for_each(|d| *d *= sign);
            direction.parameter *= sign;
            let edge = if direction.parameter < 0.0 {
                self.range.0
            } else {
                self.range.1
            };
            let at_edge = first.position.parameter == edge;
            let closed = ways
                .last()
                .is_some_and(|branch: &Branch| branch.endings.contains(&Termination::Closed));
            if !at_edge && !closed {
                ways.push(self.walk(method, first, direction)?);
            }
        }
        let mut ways = ways.into_iter();
        Ok(match (ways.next(), ways.next()) {
            (Some(against), Some(along)) => Some(against.joined(along)),
            (one, _) => one,
        })
    }

    /// Continues from an orbit in a direction until the branch ends.
    ///
    /// # Errors
    /// The multipliers of an orbit cannot be computed, or a model cannot be built.
    pub fn walk<M: OrbitMethod>(
        &self,
        method: &M,
        first: CorrectedPoint<M::Evaluation>,
        direction: Direction,
    ) -> Result<Branch, M::Error> {
        let metric = Metric::at(&first.position, self.parameter_scale());
        let tangent = metric.unit(direction);
        let sense = tangent.parameter;
        let start = CurvePoint {
            position: first.position,
            tangent,
            local: first.local,
            error: first.error,
        };
        let mut branch = Branch {
            period_cycles: method.cycles(),
            ..Branch::default()
        };
        if let Some((finer, start)) = self.finer(method, &start, &start)? {
            branch.points.push(point(&finer, &start)?);
            let beginning = TracerStart::of(&finer, &branch.points[0], sense)?;
            self.continue_branch(&finer, start, (beginning, None), &mut branch)?;
        } else {
            branch.points.push(point(method, &start)?);
            let beginning = TracerStart::of(method, &branch.points[0], sense)?;
            self.continue_branch(method, start, (beginning, None), &mut branch)?;
        }
        Ok(branch)
    }

    /// Continues from the last point of a branch, with the step size of the checkpoint.
    fn continue_branch<M: OrbitMethod>(
        &self,
        method: &M,
        start: CurvePoint<M::Evaluation>,
        (mut beginning, mark): (TracerStart, Option<Checkpoint>),
        branch: &mut Branch,
    ) -> Result<(), M::Error> {
        let mut walk = self.resume_from(method, &start, mark.as_ref());
        let mut before = OrbitPoint::new(method, start)?;
        if let Some(mark) = &mark {
            let turns = mark.tangent().parameter * before.step.tangent.parameter < 0.0;
            add_crossings(turns, &before.point, branch);
        }
        let (mut mark, mut spare) = (walk.mark(), COARSER_BELOW_ERROR);
        while let Some(next) = walk.next() {
            let step = match next {
                Ok(step) => step,
                // Beyond the range a key may have no meaning at all.
                Err(error) => return self.end_with_failure(method, before, error, branch),
            };
            match self.leaves_range(method, &before, &step, branch)? {
                RangeCrossing::Stays => {}
                RangeCrossing::Left => return Ok(()),
                RangeCrossing::Lost if walk.retreat(mark.clone()) => continue,
                RangeCrossing::Lost => {
                    branch.endings.push(failure_at_edge(before.point.parameter));
                    return Ok(());
                }
            }
            let step = self.refined_point(method, step)?;
            if let Some((finer, start)) = self.finer(method, &step, &before.step)? {
                let resumed = (beginning.resampled(&finer), Some(mark));
                return self.continue_branch(&finer, start, resumed, branch);
            }
            let after = OrbitPoint::new(method, step)?;
            let retreats = || walk.retreat(mark.clone());
            let Some(step) = self.step_points(method, &before, after, retreats)? else {
                continue;
            };
            if step.merges {
                end(Termination::Merged, branch);
                return Ok(());
            }
            branch.not_proved.extend(step.not_proved);
            for after in step.points {
                if self.ends_with(method, &mut beginning, (&before, &after), branch)? {
                    return Ok(());
                }
                before = after;
            }
            mark = walk.mark();
            if let Some((coarser, start)) = self.coarser(method, &before.step, &mut spare)? {
                let resumed = (beginning.resampled(&coarser), Some(mark));
                return self.continue_branch(&coarser, start, resumed, branch);
            }
        }
        Ok(())
    }

    /// Returns the points that a step adds; `None` where `retreats` succeeds, so that a shorter step
    /// decides.
    fn step_points<M: OrbitMethod>(
        &self,
        method: &M,
        before: &OrbitPoint<M>,
        after: OrbitPoint<M>,
        mut retreats: impl FnMut() -> bool,
    ) -> Result<Option<StepPoints<M>>, M::Error> {
        if self.may_be_off_branch(before, &after) && retreats() {
            return Ok(None);
        }
        let mut not_proved = Vec::new();
        let points = match after.point.orbit.repeats_early() {
            true => vec![after],
            false => self.resolved(method, before, after, &mut not_proved)?,
        };
        // Newton's method may have reached an orbit of fewer cycles; if a short step gets there
        // too, the branch ends on it.
        let merges = points.iter().any(|point| point.point.orbit.repeats_early());
        let is_torn = points
            .last()
            .is_some_and(|after| self.may_be_torn(before, after, &not_proved));
        if (merges || is_torn || turns_round(before, &points)) && retreats() {
            return Ok(None);
        }
        Ok(Some(StepPoints {
            points,
            not_proved,
            merges,
        }))
    }

    /// Creates a continuation from a start, with the step size of the checkpoint.
    fn resume_from<'m, M: OrbitMethod>(
        &self,
        method: &'m M,
        start: &CurvePoint<M::Evaluation>,
        mark: Option<&Checkpoint>,
    ) -> Continuation<'m, M> {
        let (position, tangent) = (start.position.clone(), start.tangent.clone());
        let mut walk = Continuation::new(
            method,
            self.corrector,
            self.control,
            self.parameter_scale(),
            position,
            tangent,
        );
        if let Some(mark) = mark {
            walk.resume(mark, |unknown| method.resampled(unknown));
        }
        walk
    }
}
