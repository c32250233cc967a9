//! Bifurcations and peaks of power, continued in two parameters.
//!
//! ```text
//! R(u, p, p2) = 0,   g(u, p, p2) = 0
//! ```
//!
//! `R` is the residual of shooting; `g` is zero at the point that is continued. That point is one
//! of: a multiplier +1 (fold) or -1 (period doubling), a complex pair on the unit circle
//! (Neimark-Sacker), a turning point on the surface of the stop (grazing), a quantity at a level,
//! or power stationary along the curve (peak). The unknowns are `u` and `p`. `p2` is the parameter
//! of the curve; continuation passes through its folds.

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
