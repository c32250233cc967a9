//! Continuation: curves of solutions `R(u, p) = 0` followed through their folds.
//!
//! Nothing here knows what `R` is. A [`Family`] gives the residual with its derivative at `(u, p)`; a [`Walk`] is an iterator over
//! the points of a curve: predictor along the tangent, Newton on the plane across it, and a step that follows from both.
//!
//! Source: E. Doedel, H. B. Keller and J. P. Kernevez, Int. J. Bifurcation Chaos 1 (1991) 493 (pseudo-arclength).

mod bracket;
mod closure;
mod corrector;
mod error;
mod event;
mod family;
mod metric;
mod parts;
mod predictor;
mod step_control;
mod tangent;
mod walk;

pub use bracket::Bracket;
pub use closure::passes;
pub use corrector::{Corrected, Corrector, correct, settle};
pub use error::WalkError;
pub use event::locate;
pub use family::{Family, Linear};
pub use metric::{Direction, Metric, Position};
pub use parts::Parts;
pub use predictor::Stretch;
pub use step_control::StepControl;
pub use tangent::tangent;
pub use walk::{Mark, Step, Walk};
