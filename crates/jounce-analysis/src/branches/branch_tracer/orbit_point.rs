//! Point of a continuation with its orbit.

use super::tracer::BranchTracer;
use crate::branches::branch::BranchPoint;
use crate::branches::events::TestDataPair;
use jounce_continuation::CurvePoint;
use jounce_orbits::OrbitMethod;
use std::sync::OnceLock;

/// Point of a continuation with its orbit.
pub(in crate::branches) struct OrbitPoint<M: OrbitMethod> {
    pub step: CurvePoint<M::Evaluation>,
    pub point: BranchPoint,
    readings: OnceLock<Option<TestDataPair>>,
}

impl<M: OrbitMethod> OrbitPoint<M> {
    /// Computes the orbit at a step.
    pub fn new(method: &M, step: CurvePoint<M::Evaluation>) -> Result<Self, M::Error> {
        Ok(Self {
            point: point(method, &step)?,
            step,
            readings: OnceLock::new(),
        })
    }

    /// Returns the data of its test functions, here and ahead; computed on first use.
    pub fn readings(&self, method: &M, tracer: &BranchTracer) -> Option<&TestDataPair> {
        let make = || {
            TestDataPair::of(
                method,
                (&self.step, &self.point.orbit),
                tracer.parameter_scale(),
                &tracer.levels,
            )
        };
        self.readings.get_or_init(make).as_ref()
    }
}

/// Returns the point of a branch at a step.
pub(super) fn point<M: OrbitMethod>(
    method: &M,
    step: &CurvePoint<M::Evaluation>,
) -> Result<BranchPoint, M::Error> {
    let orbit = method.orbit(&step.local, step.error)?;
    Ok(BranchPoint {
        parameter: step.position.parameter,
        orbit,
    })
}
