//! Continuation of one branch from one of its orbits, with its events.

use super::adapt_order::COARSER_BELOW_ERROR;
use super::detection::add_crossings;
use super::halves::{drop_doubling, merge, turns_round};
use super::noncontact::NoncontactEnd;
use super::orbit_point::{OrbitPoint, point};
use super::range_end::RangeCrossing;
use crate::branches::branch::{Bifurcation, Branch, BranchKind, BranchPoint, Termination};
use crate::branches::events::QuantityLevel;
use jounce_continuation::{
    Checkpoint, Continuation, ContinuationError, CorrectedPoint, Corrector, CurvePoint, Direction,
    Metric, Position, StepControl, correct_at, passes, tangent,
};
use jounce_dynamics::SensitivityError;
use jounce_orbits::{OrbitError, OrbitMethod, nearest_extremum_m};

/// Distance from the stop, relative to the size of the motion, below which an orbit touches it.
const GRAZING_DISTANCE: f64 = 1e-6;

/// Default length, in the metric, to which a bifurcation is located.
pub(crate) const RESOLUTION: f64 = 1e-8;

/// Newton's goal relative to the tolerance of an integration. One more iteration would square the
/// residual; the error estimate states it.
const NEWTON_GOAL_FACTOR: f64 = 50.0;

/// Limits of the goal. With coarser integrations no correction is more accurate than they are.
const NEWTON_GOAL_LIMITS: (f64, f64) = (1e-11, 1e-6);

/// Returns Newton's goal for a tolerance of integration.
pub(in crate::branches) fn newton_tolerance(tolerance: f64) -> f64 {
    (NEWTON_GOAL_FACTOR * tolerance)
        .clamp(NEWTON_GOAL_LIMITS.0, NEWTON_GOAL_LIMITS.1.max(tolerance))
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

impl BranchTracer {
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
        (self.range.1 - self.range.0) / 20.0
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
        let mut ways = Vec::new();
        for sign in [-1.0, 1.0] {
            let at_edge = parameter
                == if sign < 0.0 {
                    self.range.0
                } else {
                    self.range.1
                };
            let Ok(first) = correct_at(method, &self.corrector, &metric, position.clone()) else {
                return Ok(None);
            };
            let Some(mut direction) = tangent(&first.local, &metric, &up) else {
                return Ok(None);
            };
            direction.unknown.iter_mut().for_each(|d| *d *= sign);
            direction.parameter *= sign;
            let closed = ways
                .last()
                .is_some_and(|branch: &Branch| branch.endings.contains(&Termination::Closed));
            if !at_edge && !closed {
                ways.push(self.walk(method, first, direction)?);
            }
        }
        let mut ways = ways.into_iter();
        Ok(match (ways.next(), ways.next()) {
            (Some(down), Some(up)) => Some(down.joined(up)),
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
            add_crossings(
                mark.tangent().parameter * before.step.tangent.parameter < 0.0,
                &before.point,
                branch,
            );
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
                return self.continue_branch(
                    &finer,
                    start,
                    (beginning.resampled(&finer), Some(mark)),
                    branch,
                );
            }
            let after = OrbitPoint::new(method, step)?;
            if self.may_be_off_branch(&before, &after) && walk.retreat(mark.clone()) {
                continue;
            }
            let mut not_proved = Vec::new();
            let points = match after.point.orbit.repeats_early() {
                true => vec![after],
                false => self.resolved(method, &before, after, &mut not_proved)?,
            };
            // Newton's method may have reached an orbit of fewer cycles; if a short step gets there
            // too, the branch ends on it.
            let merges = points.iter().any(|point| point.point.orbit.repeats_early());
            if (merges || turns_round(&before, &points)) && walk.retreat(mark.clone()) {
                continue;
            }
            if merges {
                end(Termination::Merged, branch);
                return Ok(());
            }
            branch.not_proved.extend(not_proved);
            for after in points {
                if self.ends_with(method, &mut beginning, (&before, &after), branch)? {
                    return Ok(());
                }
                before = after;
            }
            mark = walk.mark();
            if let Some((coarser, start)) = self.coarser(method, &before.step, &mut spare)? {
                return self.continue_branch(
                    &coarser,
                    start,
                    (beginning.resampled(&coarser), Some(mark)),
                    branch,
                );
            }
        }
        Ok(())
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

    /// Adds a point with the events before it; true where the branch ends with it.
    fn ends_with<M: OrbitMethod>(
        &self,
        method: &M,
        beginning: &mut TracerStart,
        (before, after): (&OrbitPoint<M>, &OrbitPoint<M>),
        branch: &mut Branch,
    ) -> Result<bool, M::Error> {
        beginning.noncontact =
            NoncontactEnd::between(&before.point, &after.point, branch).or(beginning.noncontact);
        let points = branch.points.len() + 1;
        let return_point = self.return_point(beginning, before, after, points);
        let merge = if return_point.is_none() && points > 3 {
            merge(before, after)
        } else {
            None
        };
        branch
            .bifurcations
            .extend(match return_point.or(merge.as_ref()) {
                // Events beyond the start were listed at the beginning; beyond a merge the other half
                // repeats earlier events.
                Some(end) => self.until(method, (before, after), end)?,
                None => self.between(method, before, after)?,
            });
        branch.points.push(after.point.clone());
        if let Some((noncontact, back_at)) = beginning
            .noncontact
            .and_then(|noncontact| Some((noncontact, noncontact.comes_back(branch)?)))
        {
            noncontact.end(branch, back_at);
            return Ok(true);
        }
        let last = (points >= self.most_points).then_some(Termination::Points);
        let ending = return_point
            .map(|_| Termination::Closed)
            .or(merge.map(|_| Termination::Merged))
            .or(last);
        let ends = ending.is_some();
        ending.into_iter().for_each(|ending| end(ending, branch));
        Ok(ends)
    }

    /// Ends a branch whose continuation failed: with sticking where the smallest step leads to a
    /// motion that sticks, or at a grazing where the orbit touches the stop. On a stiff stop a
    /// branch turns there more sharply than any step can follow.
    fn end_with_failure<M: OrbitMethod>(
        &self,
        method: &M,
        last: OrbitPoint<M>,
        error: ContinuationError<M::Error>,
        branch: &mut Branch,
    ) -> Result<(), M::Error> {
        let evaluation = method.shot(&last.step.local)?;
        let distance_m = nearest_extremum_m(evaluation).map_or(f64::INFINITY, f64::abs);
        let (parameter, reason) = (last.point.parameter, error.to_string());
        if let ContinuationError::Family(OrbitError::Integration(SensitivityError::Rests {
            stop,
            ..
        })) = error
        {
            branch.bifurcations.push(Bifurcation {
                kind: BranchKind::Sticking,
                level: None,
                stop: Some(stop),
                at: last.point,
            });
            branch.endings.push(Termination::Sticking {
                why: reason,
                parameter,
            });
        } else if distance_m < GRAZING_DISTANCE * evaluation.kernel.plant.scale_m() {
            branch
                .bifurcations
                .push(Bifurcation::grazing(last.point, evaluation));
            branch.endings.push(Termination::Grazing {
                why: reason,
                parameter,
            });
        } else {
            branch.endings.push(Termination::Failed {
                why: reason,
                parameter,
            });
        }
        Ok(())
    }

    /// Returns the position of its start that a branch passes on a step.
    fn return_point<'b, M: OrbitMethod>(
        &self,
        beginning: &'b TracerStart,
        before: &OrbitPoint<M>,
        after: &OrbitPoint<M>,
        points: usize,
    ) -> Option<&'b Position> {
        let metric = Metric::at(&after.step.position, self.parameter_scale());
        // Another sheet of the curve may pass nearby in the opposite direction.
        let goes_alike = beginning.sense * after.step.tangent.parameter > 0.0;
        let closes = |origin: &&Position| {
            passes(&metric, origin, &before.step.position, &after.step.position)
        };
        if points > 4 && goes_alike {
            beginning.origins.iter().find(closes)
        } else {
            None
        }
    }
}

fn failure_at_edge(parameter: f64) -> Termination {
    let reason = "the branch leaves the range beyond this value, and no orbit was found on the edge; give a wider range".to_owned();
    Termination::Failed {
        why: reason,
        parameter,
    }
}

fn end(ending: Termination, branch: &mut Branch) {
    if ending == Termination::Merged {
        drop_doubling(branch);
    }
    branch.endings.push(ending);
}

/// Start of a continuation.
struct TracerStart {
    /// First orbit at each of its drive cycles; a branch closes where it returns to any of them.
    origins: Vec<Position>,
    /// Direction of the parameter.
    sense: f64,
    /// Point where the continuation left the orbits without contact.
    noncontact: Option<NoncontactEnd>,
}

impl TracerStart {
    fn of<M: OrbitMethod>(method: &M, first: &BranchPoint, sense: f64) -> Result<Self, M::Error> {
        let cycles = first.orbit.period_cycles as usize;
        let strobe_states = first.orbit.strobe_states.iter().take(cycles);
        let origin = |state: &Vec<f64>| {
            Ok(Position {
                unknown: method.unknown_of(state, first.parameter)?,
                parameter: first.parameter,
            })
        };
        Ok(Self {
            origins: strobe_states.map(origin).collect::<Result<_, M::Error>>()?,
            sense,
            noncontact: None,
        })
    }

    /// Converts to the unknown of another method.
    fn resampled<M: OrbitMethod>(self, method: &M) -> Self {
        let resampled = |origin: Position| Position {
            unknown: method.resampled(&origin.unknown),
            ..origin
        };
        Self {
            origins: self.origins.into_iter().map(resampled).collect(),
            ..self
        }
    }
}
