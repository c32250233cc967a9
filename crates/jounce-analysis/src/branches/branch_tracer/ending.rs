//! Ends of a branch: at its start, at a merge, at a failure or at the limit of points.

use super::halves::{drop_doubling, merge};
use super::noncontact::NoncontactEnd;
use super::orbit_point::OrbitPoint;
use super::tracer::BranchTracer;
use super::tracer_start::TracerStart;
use crate::branches::branch::{Bifurcation, Branch, BranchKind, Termination};
use jounce_continuation::ContinuationError;
use jounce_dynamics::SensitivityError;
use jounce_orbits::{OrbitError, OrbitMethod, nearest_extremum_m};

/// Distance from the stop, relative to the size of the motion, below which an orbit touches it.
const GRAZING_DISTANCE: f64 = 1e-6;

impl BranchTracer {
    /// Adds a point with the events before it; true where the branch ends with it.
    pub(super) fn ends_with<M: OrbitMethod>(
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
        let merge = if return_point.is_none() {
            merge(before, after)
        } else {
            None
        };
        let events = self.between(method, before, after)?;
        branch.add_events(match return_point.or(merge.as_ref()) {
            // Events beyond the start were listed at the beginning; beyond a merge the other half
            // repeats earlier events.
            Some(end) => events.until(self.along(&before.step, &after.step, end)),
            None => events,
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
    pub(super) fn end_with_failure<M: OrbitMethod>(
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
                parameter_error: None,
                neighbours: None,
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
}

/// Returns the end of a branch that leaves the range where no orbit was found on the edge.
pub(super) fn failure_at_edge(parameter: f64) -> Termination {
    let reason = "the branch leaves the range beyond this value, and no orbit was found on the edge; give a wider range".to_owned();
    Termination::Failed {
        why: reason,
        parameter,
    }
}

/// Ends a branch; one that merges loses the labels of the merge, which its parent reports.
pub(super) fn end(ending: Termination, branch: &mut Branch) {
    if ending == Termination::Merged {
        drop_doubling(branch);
    }
    branch.endings.push(ending);
}
