//! Scalar conditions that define a bifurcation.

use super::fold_flip::CriticalMultiplier;
use super::grazing::GrazingPoint;
use super::level;
use super::neimark_sacker;
use crate::{OrbitQuantity, ShootingEvaluation};

/// Condition of a bifurcation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Condition {
    /// A multiplier has this value: +1 at a fold, -1 at a period doubling.
    Multiplier(f64),
    /// A complex pair of multipliers lies on the unit circle; past a strong resonance, two real
    /// ones with the product one.
    Circle,
    /// A turning point of a port lies on the surface of its stop, as found at the start of the
    /// curve.
    Touching(GrazingPoint),
    /// A quantity of the orbit has a given level.
    Level(OrbitQuantity, f64),
    /// The mean power is stationary along the curve over the first parameter.
    Peak,
}

/// `g` with its gradient.
#[derive(Debug, Clone, PartialEq)]
pub struct Gradient {
    /// `g`.
    pub value: f64,
    /// Derivative by the state at the start.
    pub by_unknown: Vec<f64>,
    /// Derivatives by the two parameters.
    pub by_parameters: [f64; 2],
    /// Derivative by the time of a turning point, drive cycles.
    pub by_phase: f64,
    /// At a peak, second derivative of the power along the curve, relative to the power: negative
    /// at a maximum.
    pub power_curvature: Option<f64>,
    /// True where a pair on the circle has met on the real axis.
    pub is_resonant: bool,
}

impl Gradient {
    /// Returns the gradient for a condition that does not exist at a point.
    pub fn none(states: usize) -> Self {
        let by_unknown = vec![0.0; states];
        Self {
            value: f64::NAN,
            by_unknown,
            by_parameters: [0.0; 2],
            by_phase: 0.0,
            power_curvature: None,
            is_resonant: false,
        }
    }
}

impl Condition {
    /// Returns `g` at a shooting evaluation, for a condition on its multipliers or on a level.
    /// `shifted_shot` shoots from a start moved by a vector; `neighbours` are evaluations at
    /// parameters moved by `differences`.
    ///
    /// `None` where the condition does not exist: a singular border, no complex pair, or a
    /// condition of another kind.
    pub fn gradient<E>(
        self,
        evaluation: &ShootingEvaluation,
        neighbours: [&ShootingEvaluation; 2],
        differences: [f64; 2],
        shifted_shot: impl Fn(&[f64]) -> Result<ShootingEvaluation, E>,
    ) -> Result<Option<Gradient>, E> {
        match self {
            Condition::Multiplier(s) => match CriticalMultiplier::of(evaluation.map(), s) {
                Some(critical) => critical
                    .gradient(evaluation, neighbours, differences, shifted_shot)
                    .map(Some),
                None => Ok(None),
            },
            Condition::Circle => {
                neimark_sacker::gradient(evaluation, neighbours, differences, shifted_shot)
            }
            Condition::Level(quantity, value) => level::gradient(
                (quantity, value),
                evaluation,
                neighbours,
                differences,
                shifted_shot,
            )
            .map(Some),
            Condition::Touching(_) | Condition::Peak => Ok(None),
        }
    }
}
