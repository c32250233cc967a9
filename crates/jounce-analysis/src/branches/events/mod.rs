//! Detection of all events on a curve by one rule.
//!
//! Every event is a zero of a test function. A fold is a zero of the parameter's component of the
//! tangent. Doublings, branch points and tori are zeros of products over multipliers
//! ([`spectrum`]), and a grazing is a zero of the distance of a turning point past its stop
//! ([`turning_points`]). Each function has its derivative along the curve ([`test_data`]). A step
//! is accepted if the cubic through both ends and both slopes, with its error bound
//! ([`interpolant`]), proves at most one event of each kind. Otherwise a point is added half-way
//! ([`rule`]). Steps that are not proved at the smallest size are listed with their interval.

mod coupling;
mod interpolant;
mod level;
mod linking;
mod not_proved;
mod pairing;
mod rule;
mod spectrum;
mod step_events;
mod test_data;
mod turning_points;

pub(super) use interpolant::Interpolant;
pub use level::QuantityLevel;
pub use not_proved::{NotProved, ProofGap};
pub(super) use spectrum::{TestFunction, contradiction, doubling, fold, torus};
pub(super) use step_events::StepEvents;
pub(super) use test_data::{TestDataPair, slope_distance};
pub(super) use turning_points::{Extremum, extrema};
