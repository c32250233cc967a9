//! Continuation of solution curves `R(u, p) = 0` through their folds.
//!
//! The module is independent of `R`. A [`Problem`] gives the residual with its derivative at
//! `(u, p)`. A [`Continuation`] is an iterator over the points of a curve, with a predictor along
//! the tangent, Newton on the plane normal to it, and step length control from both.
//!
//! Source: E. Doedel, H. B. Keller and J. P. Kernevez, Int. J. Bifurcation Chaos 1 (1991) 493
//! (pseudo-arclength).

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
pub use closed_loop::lies_between;
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
