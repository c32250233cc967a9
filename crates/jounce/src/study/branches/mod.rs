//! Branches of periodic orbits over one key of a spec.

mod astray;
mod branch;
mod carry;
mod chase;
mod eased;
mod edge;
mod events;
mod finer;
mod follow;
mod free;
mod halves;
mod known;
mod options;
mod passed;
mod place;
mod search;
mod starts;
mod thinned;

pub use branch::{Bifurcation, Branch, BranchKind, BranchPoint, Ending};
pub use carry::{BranchCarry, Carried, Trend};
pub use chase::{BranchChase, KnownOrbit};
pub use events::{Level, NotProved};
pub(super) use follow::RESOLUTION;
pub use options::BranchOptions;
pub use search::{BranchSearch, Method};
