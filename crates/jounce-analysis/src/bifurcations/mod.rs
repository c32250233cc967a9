//! Folds, period doublings, Neimark-Sacker bifurcations, grazings and peaks of power over two keys
//! of a spec.

mod corner;
mod curve;
mod curve_tracer;
mod cusp;
mod key_plane;
mod search;
mod seed;

pub use curve::{BifurcationCurve, BifurcationCurvePoint, CurveKind};
pub use key_plane::KeyPlane;
pub use search::BifurcationSearch;
