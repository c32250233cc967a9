//! Keys of a spec fitted to measured natural frequencies and damping ratios.
//!
//! With the keys `p_k = p0_k exp(x_k)` and the modes `f_i(p)` of the structure the fit minimises
//!
//! ```text
//! sum_i [(ln f_i(p) - ln f_i,measured) / s_i]^2 + sum_k (x_k / t_k)^2
//! ```
//!
//! `s` the relative standard deviations of the features and `t` those of the keys before the test (their priors), so that the minimum is the
//! most probable set of keys. Covariance is that of the linearised model, `(J^T J)^-1`; intervals are of 95 %.
//!
//! Source: M. Friswell, J. Mottershead, Finite Element Model Updating in Structural Dynamics (1995), chapter 8; levenberg-marquardt after MINPACK.
mod answer;
mod error;
mod features;
mod problem;
mod solve;

pub use answer::{FitAnswer, FittedFeature, FittedKey};
pub use error::FitError;
pub use features::{Features, ModeFeature};
pub use solve::fit;
