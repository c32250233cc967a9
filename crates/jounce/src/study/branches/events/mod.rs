//! Events on a curve by one rule.
//!
//! Every event is a zero of a test function: a fold of the parameter's share of the tangent, a doubling, a branch point and a torus of
//! products over multipliers ([`spectrum`]), a grazing of the distance of a turning point past its stop ([`contacts`]). Each function
//! comes with its derivative along the curve ([`reading`]). A step is accepted where the cubic through both ends and both slopes, with its
//! stated error ([`interpolant`]), proves that it holds at most one event of each kind. Otherwise a point is put half-way ([`rule`]). What
//! is not proved on the shortest steps is listed with its place.

mod contacts;
mod coupling;
mod interpolant;
mod level;
mod pairing;
mod reading;
mod rule;
mod spectrum;

pub(super) use contacts::{Extremum, extrema};
pub use level::Level;
pub(super) use reading::Readings;
pub use rule::NotProved;
