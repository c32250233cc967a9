//! End of a continuation at the end of the range of the key.
//!
//! The last point lies exactly on the edge. It is searched along the curve, not along a line of
//! guesses: just below a fold a line crosses to the other side of it.

use super::orbit_point::{OrbitPoint, point};
use super::tracer::BranchTracer;
use crate::branches::branch::{Branch, Termination};
use jounce_continuation::{CurvePoint, Metric, Position, correct_at, locate, tangent};
use jounce_orbits::OrbitMethod;

/// Distance from an end of the range, relative to its width, at which a branch has reached it.
/// Steps are relative to the size of the response, so they would never reach a drive of amplitude
/// zero.
const RANGE_END_DISTANCE: f64 = 1e-9;

/// Largest distance between the point searched along the curve and the orbit on the edge, relative
/// to the step; a more distant orbit is another one.
const MAX_DISTANCE_TO_ORBIT: f64 = 0.01;

/// Relation of a step to the range.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum RangeCrossing {
    /// It stays inside.
    Stays,
    /// It left, and the branch ends on the edge.
    Left,
    /// It left, and no orbit was found on the edge.
    Lost,
}

impl BranchTracer {
    /// Ends a branch that has reached the end of the range.
    ///
    /// # Errors
    /// As [`BranchTracer::walk`].
    pub(super) fn leaves_range<M: OrbitMethod>(
        &self,
        method: &M,
        before: &OrbitPoint<M>,
        step: &CurvePoint<M::Evaluation>,
        branch: &mut Branch,
    ) -> Result<RangeCrossing, M::Error> {
        let point_beyond = self.beyond(method, &before.step, step);
        if let Some(outside) = if self.is_outside(step.position.parameter) {
            Some(step)
        } else {
            point_beyond.as_ref()
        } {
            let Some(last) = self.on_edge(method, &before.step, outside) else {
                return Ok(RangeCrossing::Lost);
            };
            let points = self.resolved(
                method,
                before,
                OrbitPoint::new(method, last)?,
                &mut branch.not_proved,
            )?;
            for (index, after) in points.iter().enumerate() {
                let before = match index {
                    0 => before,
                    _ => &points[index - 1],
                };
                let events = self.between(method, before, after)?;
                branch.add_events(events);
                branch.points.push(after.point.clone());
            }
        } else if self.is_at_edge(&step.position, step.tangent.parameter) {
            branch.points.push(point(method, step)?);
        } else {
            return Ok(RangeCrossing::Stays);
        }
        branch.endings.push(Termination::Range);
        Ok(RangeCrossing::Left)
    }

    fn is_outside(&self, parameter: f64) -> bool {
        !(self.range.0..=self.range.1).contains(&parameter)
    }

    /// True where a continuation in a direction is close enough to the end of the range.
    fn is_at_edge(&self, position: &Position, sense: f64) -> bool {
        let edge = if sense < 0.0 {
            self.range.0
        } else {
            self.range.1
        };
        (position.parameter - edge).abs() < RANGE_END_DISTANCE * (self.range.1 - self.range.0)
    }

    /// Returns the fold beyond the range through which a step came back into it.
    fn beyond<M: OrbitMethod>(
        &self,
        method: &M,
        before: &CurvePoint<M::Evaluation>,
        after: &CurvePoint<M::Evaluation>,
    ) -> Option<CurvePoint<M::Evaluation>> {
        let metric = Metric::at(&before.position, self.parameter_scale());
        let length = metric.length(&before.position.to(&after.position));
        // A curve that bends back stays within its tangents.
        let reach = |step: &CurvePoint<M::Evaluation>, sign: f64| {
            self.is_outside(step.position.parameter + sign * length * step.tangent.parameter)
        };
        let turns = before.tangent.parameter * after.tangent.parameter < 0.0;
        if !turns
            || self.is_outside(after.position.parameter)
            || !(reach(before, 1.0) && reach(after, -1.0))
        {
            return None;
        }
        let value = |step: &CurvePoint<M::Evaluation>| Some(step.tangent.parameter);
        let fold = locate(
            method,
            &self.corrector,
            self.parameter_scale(),
            (before, after),
            self.resolution,
            value,
        )?;
        self.is_outside(fold.position.parameter).then_some(fold)
    }

    /// Returns the orbit on the edge of the range between two points, the second one outside.
    fn on_edge<M: OrbitMethod>(
        &self,
        method: &M,
        before: &CurvePoint<M::Evaluation>,
        outside: &CurvePoint<M::Evaluation>,
    ) -> Option<CurvePoint<M::Evaluation>> {
        let edge = if outside.position.parameter < self.range.0 {
            self.range.0
        } else {
            self.range.1
        };
        let value = |step: &CurvePoint<M::Evaluation>| Some(step.position.parameter - edge);
        let near = locate(
            method,
            &self.corrector,
            self.parameter_scale(),
            (before, outside),
            self.resolution,
            value,
        )?;
        let metric = Metric::at(&near.position, self.parameter_scale());
        let guess = Position {
            parameter: edge,
            ..near.position.clone()
        };
        let corrected = correct_at(method, &self.corrector, &metric, guess).ok()?;
        let direction = tangent(&corrected.local, &metric, &near.tangent)?;
        let length = metric.length(&before.position.to(&outside.position));
        let is_near =
            metric.length(&near.position.to(&corrected.position)) <= MAX_DISTANCE_TO_ORBIT * length;
        // On the other side of a fold the curve has the opposite direction.
        let is_same_side = direction.parameter * near.tangent.parameter > 0.0;
        (is_near && is_same_side).then(|| CurvePoint {
            position: corrected.position,
            tangent: direction,
            local: corrected.local,
            error: corrected.error,
        })
    }
}
