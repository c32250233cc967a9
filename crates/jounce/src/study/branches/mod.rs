//! Branches of periodic orbits over one key of a spec.

mod astray;
mod branch;
mod carry;
mod chase;
mod eased;
mod edge;
mod finer;
mod follow;
mod free;
mod passed;
mod refine;
mod search;
mod thinned;

pub use branch::{Bifurcation, Branch, BranchKind, BranchPoint, Ending};
pub use carry::{BranchCarry, Carried, Trend};
pub use chase::{BranchChase, KnownOrbit};
pub(super) use follow::RESOLUTION;
pub use search::{BranchSearch, Method};
