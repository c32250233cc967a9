//! Steps that may have led to another sheet of the curve.

use super::orbit_point::OrbitPoint;
use super::tracer::BranchTracer;
use crate::continuation::Metric;
use crate::orbit::OrbitMethod;

/// Length in the metric of a step after which a branch point is believed.
const TRUSTED_STEP: f64 = 2e-3;

impl BranchTracer {
    /// True for a step, not yet a short one, on which a multiplier passes +1 though the branch does not turn. That is a branch point, or the
    /// step ended beyond a fold, on the sheet that comes back from it: then the walk would turn round there. A shorter step tells.
    pub(super) fn may_be_astray<M: OrbitMethod>(
        &self,
        before: &OrbitPoint<M>,
        after: &OrbitPoint<M>,
    ) -> bool {
        let passes =
            before.point.orbit.determinant_at(1.0) * after.point.orbit.determinant_at(1.0) < 0.0;
        let turns = before.step.tangent.parameter * after.step.tangent.parameter < 0.0;
        let metric = Metric::at(&before.step.position, self.parameter_scale());
        passes
            && !turns
            && metric.length(&before.step.position.to(&after.step.position)) > TRUSTED_STEP
    }
}
