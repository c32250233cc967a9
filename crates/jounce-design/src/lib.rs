//! Design: values of keys of a harvester with the largest power within limits.
//!
//! A [`Problem`] is read from a file: the free keys with their ranges, the goal, the limits, the
//! conditions and the tolerances of the workshop. [`design`] searches for the best design and
//! examines it:
//!
//! 1. At points that fill the space of the keys (a Sobol sequence), few starts are integrated until
//!    their attractors are proved. A start without a proved attractor has no power, so that no
//!    transient is rewarded.
//! 2. From each of them, the orbit is followed to larger power within its limits, by sequential
//!    quadratic programming with the derivatives of the orbit. Goals that are not the power of an
//!    orbit are searched by differential evolution.
//! 3. What is found counts only after all starts have been integrated there.
//!
//! The order of the work does not depend on the number of threads, and neither does the result.

mod error;
mod evaluation;
mod examination;
mod front;
mod problem;
mod result;
mod robustness;
mod search;

pub use error::DesignError;
pub use evaluation::{Evaluation, Journaled, MainOrbit, OnImprovement};
pub use problem::{
    AllowedLimit, Choice, ChoiceIndex, Condition, FreeKey, FreeRange, FreeValues, Goal, Limit,
    LimitedQuantity, Problem, Size, Tolerance, allowed_limits,
};
pub use result::{
    BestDesign, DesignBefore, DesignOutcome, FreeValue, FrontPoint, Improvement, LimitResult,
    NearestFold, NoiseLimit, NoisePower, PowerBand, Quantile, Robustness, SearchEnd, SobolIndex,
    TracePoint,
};
pub use robustness::PowerBandSearch;
pub use search::design;
