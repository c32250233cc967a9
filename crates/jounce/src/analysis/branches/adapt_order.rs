//! The change to a finer or a coarser method on the way along a branch.

use super::tracer::BranchTracer;
use crate::continuation::{
    Corrector, CurvePoint, Direction, Metric, Position, Problem, correct, tangent,
};
use crate::orbit::OrbitMethod;

/// Share of its excess that a finer method must get rid of: what stays is no matter of the number of unknowns.
const MIN_ERROR_REDUCTION: f64 = 0.6;

/// Excess below which a coarser method is tried.
pub(super) const COARSER_BELOW_ERROR: f64 = 0.04;

/// Excess of a coarser method that is not taken, for it would soon be too coarse.
const MAX_COARSER_ERROR: f64 = 0.4;

/// Another method with a place in its unknown.
type Other<M> = Option<(M, CurvePoint<<M as Problem>::Evaluation>)>;

/// Newton's goal beside the usual one, where what it left out may be all that is in excess.
const STRICT_GOAL_FACTOR: f64 = 0.01;

impl BranchTracer {
    /// The place by a Newton that goes on, where that is what keeps it from its accuracy; otherwise as it is.
    pub(super) fn polished<M: OrbitMethod>(
        &self,
        method: &M,
        place: CurvePoint<M::Evaluation>,
    ) -> Result<CurvePoint<M::Evaluation>, M::Error> {
        if method.error_ratio(&place.local, self.parameter_scale())? <= 1.0 {
            return Ok(place);
        }
        let closer = BranchTracer {
            corrector: Corrector {
                goal: STRICT_GOAL_FACTOR * self.corrector.goal,
                ..self.corrector
            },
            ..self.clone()
        };
        let fits = |there: &CurvePoint<M::Evaluation>| {
            method
                .error_ratio(&there.local, self.parameter_scale())
                .is_ok_and(|excess| excess <= 1.0)
        };
        Ok(closer.carried(method, &place).filter(fits).unwrap_or(place))
    }

    /// A method fine enough for the orbit at `rough`, where this one is not and a finer one is better; with `from` in its unknown.
    pub(super) fn finer<M: OrbitMethod>(
        &self,
        method: &M,
        rough: &CurvePoint<M::Evaluation>,
        from: &CurvePoint<M::Evaluation>,
    ) -> Result<Other<M>, M::Error> {
        let mut excess = method.error_ratio(&rough.local, self.parameter_scale())?;
        let mut found: Other<M> = None;
        let mut next = method.finer();
        while let Some(finer) = next.filter(|_| excess > 1.0) {
            let (Some(there), Some(back)) =
                (self.carried(&finer, rough), self.carried(&finer, from))
            else {
                break;
            };
            let before = std::mem::replace(
                &mut excess,
                finer.error_ratio(&there.local, self.parameter_scale())?,
            );
            if excess > MIN_ERROR_REDUCTION * before {
                break;
            }
            next = finer.finer();
            found = Some((finer, back));
        }
        Ok(found)
    }

    /// A coarser method that is fine enough for the orbit at a place, where this one is far finer than need be; with the place in its
    /// unknown. `spare` is the excess below which one is tried: it shrinks where none will do.
    pub(super) fn coarser<M: OrbitMethod>(
        &self,
        method: &M,
        place: &CurvePoint<M::Evaluation>,
        spare: &mut f64,
    ) -> Result<Other<M>, M::Error> {
        let Some(coarser) = method.coarser() else {
            return Ok(None);
        };
        let excess = method.error_ratio(&place.local, self.parameter_scale())?;
        if excess > *spare {
            return Ok(None);
        }
        let there = self.carried(&coarser, place);
        let fits = |there: &CurvePoint<M::Evaluation>| {
            coarser
                .error_ratio(&there.local, self.parameter_scale())
                .is_ok_and(|excess| excess < MAX_COARSER_ERROR)
        };
        match there.filter(fits) {
            Some(there) => Ok(Some((coarser, there))),
            None => {
                *spare = 0.3 * excess;
                Ok(None)
            }
        }
    }

    /// A place of another method, corrected by this one.
    fn carried<M: OrbitMethod>(
        &self,
        method: &M,
        step: &CurvePoint<M::Evaluation>,
    ) -> Option<CurvePoint<M::Evaluation>> {
        let guess = Position {
            unknown: method.carried(&step.position.unknown),
            parameter: step.position.parameter,
        };
        let metric = Metric::at(&guess, self.parameter_scale());
        let ahead = Direction {
            unknown: method.carried(&step.tangent.unknown),
            parameter: step.tangent.parameter,
        };
        // What lies on an edge of the range stays there.
        let at_edge = guess.parameter == self.range.0 || guess.parameter == self.range.1;
        let upright = Direction {
            unknown: vec![0.0; guess.unknown.len()],
            parameter: metric.parameter,
        };
        let found = correct(
            method,
            &self.corrector,
            &metric,
            if at_edge { &upright } else { &ahead },
            guess,
        )
        .ok()?;
        let tangent = tangent(&found.local, &metric, &ahead)?;
        Some(CurvePoint {
            position: found.position,
            tangent,
            local: found.local,
            error: found.error,
        })
    }
}
