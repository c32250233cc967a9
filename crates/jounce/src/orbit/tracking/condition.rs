//! What is zero at a bifurcation.

use super::critical::Critical;
use super::touching;
use crate::orbit::Shot;

/// The condition of a bifurcation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Condition {
    /// A multiplier of this value: +1 at a fold, -1 at a doubling.
    Multiplier(f64),
    /// A turning point of the port on the surface of the stop.
    Touching,
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
}

impl Condition {
    /// `g` at a shot. `moved` shoots from a start moved by a vector, `aside` are shots at parameters moved by `differences`.
    ///
    /// `None` where there is no such condition: a singular border, or no turning point.
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
            Condition::Touching => touching::gradient(shot, aside, differences, moved),
        }
    }
}
