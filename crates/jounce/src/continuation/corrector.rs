//! Newton on the plane across a direction, or at a fixed parameter.

use super::{
    ContinuationError, Direction, Linearization, Metric, Position, Problem, ResidualReport,
};

/// When Newton has converged, and when it is given up.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corrector {
    /// Length of a correction, in the metric, below which a place counts as on the curve.
    pub goal: f64,
    /// Most evaluations.
    pub most: u32,
}

/// A place on the curve.
#[derive(Debug)]
pub struct CorrectedPoint<L> {
    /// Where.
    pub position: Position,
    /// The problem there.
    pub local: L,
    /// Evaluations it took.
    pub evaluations: u32,
    /// Length of the correction that was left out: the error of the place, in the metric.
    pub error: f64,
}

/// From a guess onto the curve, moving across `direction` only.
///
/// # Errors
/// [`ContinuationError`].
pub fn correct<F: Problem>(
    family: &F,
    corrector: &Corrector,
    metric: &Metric,
    direction: &Direction,
    guess: Position,
) -> Result<CorrectedPoint<F::Evaluation>, ContinuationError<F::Error>> {
    let (row, corner) = metric.row(direction);
    let mut position = guess;
    let (mut last, mut left) = (f64::INFINITY, ResidualReport::default());
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
        // The first correction may be long; one that grows afterwards leads nowhere.
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
            left = local.parts();
        }
        last = error;
        position = position.moved(&change, 1.0);
    }
    Err(ContinuationError::Diverged {
        parameter: position.parameter,
        error: last,
        goal: corrector.goal,
        left,
    })
}

/// From a guess onto the curve at its own parameter.
///
/// # Errors
/// [`ContinuationError`].
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
