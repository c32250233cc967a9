//! Folds, doublings and grazings over two keys of a spec: where the answer jumps.

mod curve;
mod key_plane;
mod search;

pub use curve::{JumpCurve, JumpPoint};
pub use key_plane::KeyPlane;
pub use search::JumpSearch;
