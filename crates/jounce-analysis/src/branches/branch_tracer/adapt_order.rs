//! Change to a finer or a coarser method during continuation of a branch.

use super::tracer::BranchTracer;
use jounce_continuation::{
    Corrector, CurvePoint, Direction, Metric, Position, Problem, correct, tangent,
};
use jounce_orbits::OrbitMethod;

/// Largest fraction of its error ratio that a finer method may retain; otherwise the error is not
/// due to the number of unknowns.
const MIN_ERROR_REDUCTION: f64 = 0.6;

/// Error ratio below which a coarser method is tried.
pub(super) const COARSER_BELOW_ERROR: f64 = 0.04;

/// Largest error ratio of a coarser method; above it the method would soon be too coarse.
const MAX_COARSER_ERROR: f64 = 0.4;

/// Another method with a point in its unknown.
type Other<M> = Option<(M, CurvePoint<<M as Problem>::Evaluation>)>;

/// Stricter goal of Newton's method relative to the usual one, where its residual may dominate the
/// error.
const STRICT_GOAL_FACTOR: f64 = 0.01;

impl BranchTracer {
    /// Returns the point after more Newton iterations, if these bring it within the accuracy;
    /// otherwise the point itself.
    pub(super) fn refined_point<M: OrbitMethod>(
        &self,
        method: &M,
        point: CurvePoint<M::Evaluation>,
    ) -> Result<CurvePoint<M::Evaluation>, M::Error> {
        if method.error_ratio(&point.local, self.parameter_scale())? <= 1.0 {
            return Ok(point);
        }
        let closer = BranchTracer {
            corrector: Corrector {
                goal: STRICT_GOAL_FACTOR * self.corrector.goal,
                ..self.corrector
            },
            ..self.clone()
        };
        let fits = |corrected: &CurvePoint<M::Evaluation>| {
            method
                .error_ratio(&corrected.local, self.parameter_scale())
                .is_ok_and(|excess| excess <= 1.0)
        };
        Ok(closer
            .resampled(method, &point)
            .filter(fits)
            .unwrap_or(point))
    }

    /// Returns a method fine enough for the orbit at `rough`, where this one is too coarse and a
    /// finer one is better, with `from` in its unknown.
    pub(super) fn finer<M: OrbitMethod>(
        &self,
        method: &M,
        rough: &CurvePoint<M::Evaluation>,
        from: &CurvePoint<M::Evaluation>,
    ) -> Result<Other<M>, M::Error> {
        let mut excess = method.error_ratio(&rough.local, self.parameter_scale())?;
        let mut candidate: Other<M> = None;
        let mut next = method.finer();
        while let Some(finer) = next.filter(|_| excess > 1.0) {
            let (Some(corrected), Some(back)) =
                (self.resampled(&finer, rough), self.resampled(&finer, from))
            else {
                break;
            };
            let before = std::mem::replace(
                &mut excess,
                finer.error_ratio(&corrected.local, self.parameter_scale())?,
            );
            if excess > MIN_ERROR_REDUCTION * before {
                break;
            }
            next = finer.finer();
            candidate = Some((finer, back));
        }
        Ok(candidate)
    }

    /// Returns a coarser method that is fine enough for the orbit at a point, with the point in its
    /// unknown. It is tried where the error ratio is below `spare`, which is reduced after each
    /// failure.
    pub(super) fn coarser<M: OrbitMethod>(
        &self,
        method: &M,
        point: &CurvePoint<M::Evaluation>,
        spare: &mut f64,
    ) -> Result<Other<M>, M::Error> {
        let Some(coarser) = method.coarser() else {
            return Ok(None);
        };
        let excess = method.error_ratio(&point.local, self.parameter_scale())?;
        if excess > *spare {
            return Ok(None);
        }
        let corrected = self.resampled(&coarser, point);
        let fits = |corrected: &CurvePoint<M::Evaluation>| {
            coarser
                .error_ratio(&corrected.local, self.parameter_scale())
                .is_ok_and(|excess| excess < MAX_COARSER_ERROR)
        };
        match corrected.filter(fits) {
            Some(corrected) => Ok(Some((coarser, corrected))),
            None => {
                *spare = 0.3 * excess;
                Ok(None)
            }
        }
    }

    /// Converts a point of another method and corrects it with this one.
    fn resampled<M: OrbitMethod>(
        &self,
        method: &M,
        step: &CurvePoint<M::Evaluation>,
    ) -> Option<CurvePoint<M::Evaluation>> {
        let guess = Position {
            unknown: method.resampled(&step.position.unknown),
            parameter: step.position.parameter,
        };
        let metric = Metric::at(&guess, self.parameter_scale());
        let direction = Direction {
            unknown: method.resampled(&step.tangent.unknown),
            parameter: step.tangent.parameter,
        };
        // A point on an edge of the range remains there.
        let at_edge = guess.parameter == self.range.0 || guess.parameter == self.range.1;
        let parameter_direction = Direction {
            unknown: vec![0.0; guess.unknown.len()],
            parameter: metric.parameter,
        };
        let corrected = correct(
            method,
            &self.corrector,
            &metric,
            if at_edge {
                &parameter_direction
            } else {
                &direction
            },
            guess,
        )
        .ok()?;
        let tangent = tangent(&corrected.local, &metric, &direction)?;
        Some(CurvePoint {
            position: corrected.position,
            tangent,
            local: corrected.local,
            error: corrected.error,
        })
    }
}
