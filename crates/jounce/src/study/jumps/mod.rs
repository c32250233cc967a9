//! Folds, doublings, tori, grazings and peaks of power over two keys of a spec.

mod corner;
mod curve;
mod cusp;
mod follow;
mod key_plane;
mod search;
mod seed;

pub use curve::{CurveKind, JumpCurve, JumpPoint};
pub use key_plane::KeyPlane;
pub use search::JumpSearch;
