//! What is zero at a bifurcation.

use super::circle;
use super::critical::Critical;
use crate::orbit::Shot;

/// The condition of a bifurcation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Condition {
    /// A multiplier of this value: +1 at a fold, -1 at a doubling.
    Multiplier(f64),
    /// A complex pair of multipliers on the unit circle; past a strong resonance two real ones whose product is one.
    Circle,
    /// A turning point of the port on the surface of the stop.
    Touching,
    /// Mean power stationary along the curve over the first parameter.
    Peak,
}

/// `g` with its gradient.
#[derive(Debug, Clone, PartialEq)]
pub struct Gradient {
    /// `g`.
    pub value: f64,
    /// By the state at the start.
    pub by_unknown: Vec<f64>,
    /// By the two parameters.
    pub by_parameters: [f64; 2],
    /// At a peak, second derivative of the power along the curve, beside the power: negative at a maximum.
    pub bend: Option<f64>,
    /// True where a pair on the circle has met on the real axis.
    pub is_resonant: bool,
}

impl Condition {
    /// `g` at a shot, for a condition on its multipliers. `moved` shoots from a start moved by a vector, `aside` are shots at
    /// parameters moved by `differences`.
    ///
    /// `None` where there is no such condition: a singular border, no complex pair, or a condition of another kind.
    pub fn gradient<E>(
        self,
        shot: &Shot,
        aside: [&Shot; 2],
        differences: [f64; 2],
        moved: impl Fn(&[f64]) -> Result<Shot, E>,
    ) -> Result<Option<Gradient>, E> {
        match self {
            Condition::Multiplier(s) => match Critical::of(&shot.map, s) {
                Some(critical) => critical.gradient(shot, aside, differences, moved).map(Some),
                None => Ok(None),
            },
            Condition::Circle => circle::gradient(shot, aside, differences, moved),
            Condition::Touching | Condition::Peak => Ok(None),
        }
    }
}
