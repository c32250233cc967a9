//! Fits keys of a spec to measured modes, frequency responses, powers, jumps and time histories.
//!
//! With the keys `p_k = p0_k exp(x_k)` and the results `m_i(p)` of the model the fit minimises
//!
//! ```text
//! sum_i (e_i / s_i)^2 + sum_k (x_k / t_k)^2
//! e_i = ln m_i(p) - ln m_i,measured                frequencies, damping ratios, sizes of responses, powers, jumps
//! e_i = (m_i(p) - m_i,measured) / |H_i|            real and imaginary parts of a response H
//! e_i = (m_i(p) - m_i,measured) / rms              samples of a time history
//! ```
//!
//! Here `s` are the relative standard deviations of the features and `t` those of the keys before
//! the test (their priors). The minimum is therefore the most probable set of keys. The covariance
//! is that of the linearised model, `C = (J^T J)^-1`; confidence intervals are 95 %. Prediction
//! intervals combine the deviations of the model, from `C`, and of the measurement.
//!
//! Source: M. Friswell, J. Mottershead, Finite Element Model Updating in Structural Dynamics
//! (1995), chapter 8; levenberg-marquardt after MINPACK.
mod derived;
mod deviation;
mod discrepancy;
mod error;
mod features;
mod intervals;
mod measured;
mod model;
mod observations;
mod problem;
mod profile;
mod result;
mod solve;
mod warnings;

pub use derived::Derived;
pub use deviation::Deviation;
pub use error::FitError;
pub use features::{
    Features, HistoryFeature, JumpFeature, MeasuredLines, ModeFeature, PowerFeature,
    ResponseFeature,
};
pub use result::{FitResult, FittedCurve, FittedDeviation, FittedFeature, FittedKey};
pub use solve::fit;

use model::{FeatureModel, FitModel};
