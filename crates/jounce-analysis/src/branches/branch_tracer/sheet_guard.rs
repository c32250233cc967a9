//! Guard against steps to another sheet of the curve.

use super::orbit_point::OrbitPoint;
use super::tracer::BranchTracer;
use crate::branches::events::{NotProved, ProofGap};
use jounce_continuation::Metric;
use jounce_orbits::OrbitMethod;

/// Length of a step, in the metric, below which a branch point, or the lack of an orbit half-way, is
/// accepted.
const TRUSTED_STEP: f64 = 2e-3;

impl BranchTracer {
    /// True for a longer step on which a multiplier passes +1 although the branch does not turn.
    /// Either there is a branch point, or the step ended beyond a fold on the returning sheet and
    /// the continuation would turn back. A shorter step decides.
    pub(super) fn may_be_off_branch<M: OrbitMethod>(
        &self,
        before: &OrbitPoint<M>,
        after: &OrbitPoint<M>,
    ) -> bool {
        let passes =
            before.point.orbit.determinant_at(1.0) * after.point.orbit.determinant_at(1.0) < 0.0;
        let turns = before.step.tangent.parameter * after.step.tangent.parameter < 0.0;
        passes && !turns && self.is_long(before, after)
    }

    /// True where no orbit half-way on a longer step was found, so that its ends may lie on
    /// different parts of the curve. A shorter step decides.
    pub(super) fn may_be_torn<M: OrbitMethod>(
        &self,
        before: &OrbitPoint<M>,
        after: &OrbitPoint<M>,
        not_proved: &[NotProved],
    ) -> bool {
        let is_torn = |part: &NotProved| part.why == ProofGap::NoMidpoint;
        not_proved.iter().any(is_torn) && self.is_long(before, after)
    }

    fn is_long<M: OrbitMethod>(&self, before: &OrbitPoint<M>, after: &OrbitPoint<M>) -> bool {
        let metric = Metric::at(&before.step.position, self.parameter_scale());
        metric.length(&before.step.position.to(&after.step.position)) > TRUSTED_STEP
    }
}
