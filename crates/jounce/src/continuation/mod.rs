//! Continuation: curves of solutions `R(u, p) = 0` followed through their folds.
//!
//! Nothing here knows what `R` is. A [`Problem`] gives the residual with its derivative at `(u, p)`; a [`Continuation`] is an iterator over
//! the points of a curve: predictor along the tangent, Newton on the plane across it, and a step that follows from both.
//!
//! Source: E. Doedel, H. B. Keller and J. P. Kernevez, Int. J. Bifurcation Chaos 1 (1991) 493 (pseudo-arclength).

mod bracket;
mod closed_loop;
mod corrector;
mod driver;
mod error;
mod event;
mod metric;
mod predictor;
mod problem;
mod residual_report;
mod step_control;
mod tangent;

pub use bracket::Bracket;
pub use closed_loop::passes;
pub use corrector::{CorrectedPoint, Corrector, correct, correct_at};
pub use driver::{Checkpoint, Continuation, CurvePoint};
pub use error::ContinuationError;
pub use event::locate;
pub use metric::{Direction, Metric, Position};
pub use predictor::HermiteSegment;
pub use problem::{Linearization, Problem};
pub use residual_report::ResidualReport;
pub use step_control::StepControl;
pub use tangent::tangent;
