//! Start of a continuation, and the return of a branch to it.

use super::noncontact::NoncontactEnd;
use super::orbit_point::OrbitPoint;
use super::tracer::BranchTracer;
use crate::branches::branch::BranchPoint;
use jounce_continuation::{Metric, Position, lies_between};
use jounce_orbits::OrbitMethod;

/// Start of a continuation.
pub(super) struct TracerStart {
    /// First orbit at each of its drive cycles; a branch closes where it returns to any of them.
    pub origins: Vec<Position>,
    /// Direction of the parameter.
    pub sense: f64,
    /// Point where the continuation left the orbits without contact.
    pub noncontact: Option<NoncontactEnd>,
}

impl TracerStart {
    /// Returns the start at the first point of a branch; `sense` is the direction of the parameter.
    pub fn of<M: OrbitMethod>(
        method: &M,
        first: &BranchPoint,
        sense: f64,
    ) -> Result<Self, M::Error> {
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
    pub fn resampled<M: OrbitMethod>(self, method: &M) -> Self {
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

impl BranchTracer {
    /// Returns the position of its start that a branch passes on a step.
    pub(super) fn return_point<'b, M: OrbitMethod>(
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
            lies_between(&metric, origin, &before.step.position, &after.step.position)
        };
        if points > 4 && goes_alike {
            beginning.origins.iter().find(closes)
        } else {
            None
        }
    }
}
