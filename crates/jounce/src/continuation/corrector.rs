//! Newton on the plane across a direction, or at a fixed parameter.

use super::{Direction, Family, Linear, Metric, Position, WalkError};

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
pub struct Corrected<L> {
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
/// [`WalkError`].
pub fn correct<F: Family>(
    family: &F,
    corrector: &Corrector,
    metric: &Metric,
    direction: &Direction,
    guess: Position,
) -> Result<Corrected<F::Local>, WalkError<F::Error>> {
    let (row, corner) = metric.row(direction);
    let mut position = guess;
    let mut last = f64::INFINITY;
    for evaluations in 1..=corrector.most {
        let local = family.at(&position.unknown, position.parameter).map_err(WalkError::Family)?;
        let right: Vec<f64> = local.residual().iter().map(|r| -r).collect();
        let Some((unknown, parameter)) = local.bordered(&row, corner, &right, 0.0) else {
            return Err(WalkError::Singular { parameter: position.parameter });
        };
        let change = Direction { unknown, parameter };
        let error = metric.length(&change);
        if error <= corrector.goal {
            return Ok(Corrected { position, local, evaluations, error });
        }
        // The first correction may be long; one that grows afterwards leads nowhere.
        if !error.is_finite() || error > 2.0 * last {
            let parameter = position.parameter;
            return Err(WalkError::Diverged { parameter, error, goal: corrector.goal });
        }
        last = error;
        position = position.moved(&change, 1.0);
    }
    Err(WalkError::Diverged { parameter: position.parameter, error: last, goal: corrector.goal })
}

/// From a guess onto the curve at its own parameter.
///
/// # Errors
/// [`WalkError`].
pub fn settle<F: Family>(
    family: &F,
    corrector: &Corrector,
    metric: &Metric,
    guess: Position,
) -> Result<Corrected<F::Local>, WalkError<F::Error>> {
    let direction = Direction { unknown: vec![0.0; guess.unknown.len()], parameter: metric.parameter };
    correct(family, corrector, metric, &direction, guess)
}
