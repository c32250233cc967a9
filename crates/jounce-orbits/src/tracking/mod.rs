//! Bifurcations and peaks of power, continued in two parameters.
//!
//! ```text
//! R(u, p, p2) = 0,   g(u, p, p2) = 0
//! ```
//!
//! `R` is the residual of shooting; `g` is zero at the point that is continued. At a fold (or
//! period doubling) a multiplier is +1 (or -1); at a Neimark-Sacker point a complex pair is on the
//! unit circle. At a grazing a turning point is on the surface of the stop. A quantity has a given
//! level, or the power is stationary along the curve (peak). The unknowns are `u` and `p`. `p2` is
//! the parameter of the curve; continuation passes through its folds.

mod branch_projection;
mod condition;
mod extended_problem;
mod fold_flip;
mod grazing;
mod level;
mod multiplier_pair;
mod neimark_sacker;
mod peak;
mod two_parameter_problem;

pub use condition::{Condition, Gradient};
pub use extended_problem::{ExtendedEvaluation, ExtendedProblem};
pub use grazing::GrazingPoint;
pub use two_parameter_problem::TwoParameterProblem;
