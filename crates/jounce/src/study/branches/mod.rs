//! Branches of periodic orbits over one key of a spec.

mod attractor;
mod branch;
mod finer;
mod follow;
mod refine;
mod search;

pub use attractor::settled_orbit;
pub use branch::{Bifurcation, Branch, BranchKind, BranchPoint, Ending};
pub use search::{BranchSearch, Method};
