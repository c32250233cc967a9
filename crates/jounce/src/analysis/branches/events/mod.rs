//! Events on a curve by one rule.
//!
//! Every event is a zero of a test function: a fold of the parameter's share of the tangent, a doubling, a branch point and a torus of
//! products over multipliers ([`spectrum`]), a grazing of the distance of a turning point past its stop ([`turning_points`]). Each function
//! comes with its derivative along the curve ([`test_data`]). A step is accepted where the cubic through both ends and both slopes, with its
//! stated error ([`interpolant`]), proves that it holds at most one event of each kind. Otherwise a point is put half-way ([`rule`]). What
//! is not proved on the shortest steps is listed with its place.

mod coupling;
mod interpolant;
mod level;
mod pairing;
mod rule;
mod spectrum;
mod test_data;
mod turning_points;

pub use level::QuantityLevel;
pub use rule::NotProved;
pub(super) use test_data::TestDataPair;
pub(super) use turning_points::{Extremum, extrema};
