//! Newton's method on the plane normal to a direction, or at a fixed parameter.

use super::{
    ContinuationError, Direction, Linearization, Metric, Position, Problem, ResidualReport,
};

/// Convergence criterion and iteration limit of Newton's method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corrector {
    /// Length of a correction, in the metric, below which Newton has converged.
    pub goal: f64,
    /// Largest number of evaluations.
    pub most: u32,
}

/// Point on the curve.
#[derive(Debug)]
pub struct CorrectedPoint<L> {
    /// Position.
    pub position: Position,
    /// Evaluation of the problem there.
    pub local: L,
    /// Number of evaluations.
    pub evaluations: u32,
    /// Length of the next correction, which is not applied: the error of the point, in the metric.
    pub error: f64,
}

/// Corrects a predictor onto the curve, in the plane normal to `direction`.
///
/// # Errors [`ContinuationError`].
pub fn correct<F: Problem>(
    family: &F,
    corrector: &Corrector,
    metric: &Metric,
    direction: &Direction,
    guess: Position,
) -> Result<CorrectedPoint<F::Evaluation>, ContinuationError<F::Error>> {
    let (row, corner) = metric.row(direction);
    let mut position = guess;
    let (mut last, mut residuals) = (f64::INFINITY, ResidualReport::default());
    for evaluations in 1..=corrector.most {
        let local = family
            .at(&position.unknown, position.parameter)
            .map_err(ContinuationError::Family)?;
        let right: Vec<f64> = local.residual().iter().map(|r| -r).collect();
        let Some((unknown, parameter)) = local.bordered(&row, corner, &right, 0.0) else {
            return Err(ContinuationError::Singular {
                parameter: position.parameter,
            });
        };
        let change = Direction { unknown, parameter };
        let error = metric.length(&change);
        if error <= corrector.goal {
            return Ok(CorrectedPoint {
                position,
                local,
                evaluations,
                error,
            });
        }
        // The first correction may be long; a later one that grows means divergence.
        if !error.is_finite() || error > 2.0 * last {
            let parameter = position.parameter;
            return Err(ContinuationError::Diverged {
                parameter,
                error,
                goal: corrector.goal,
                left: local.parts(),
            });
        }
        if evaluations == corrector.most {
            residuals = local.parts();
        }
        last = error;
        position = position.offset_along(&change, 1.0);
    }
    Err(ContinuationError::Diverged {
        parameter: position.parameter,
        error: last,
        goal: corrector.goal,
        left: residuals,
    })
}

/// Corrects a predictor onto the curve at fixed parameter.
///
/// # Errors [`ContinuationError`].
pub fn correct_at<F: Problem>(
    family: &F,
    corrector: &Corrector,
    metric: &Metric,
    guess: Position,
) -> Result<CorrectedPoint<F::Evaluation>, ContinuationError<F::Error>> {
    let direction = Direction {
        unknown: vec![0.0; guess.unknown.len()],
        parameter: metric.parameter,
    };
    correct(family, corrector, metric, &direction, guess)
}
