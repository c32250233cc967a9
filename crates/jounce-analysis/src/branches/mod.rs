//! Branches of periodic orbits over one key of a spec.

mod adapt_order;
mod branch;
mod branch_update;
mod detection;
mod events;
mod halves;
mod known;
mod noncontact;
mod options;
mod orbit_point;
mod ramp_down;
mod range_end;
mod search;
mod sheet_guard;
mod simplified;
mod starts;
mod tracer;
mod warm_start;

pub use branch::{Bifurcation, Branch, BranchKind, BranchPoint, Termination};
pub use branch_update::{BranchUpdate, Extrapolation, UpdatedBranches};
pub use events::{NotProved, QuantityLevel};
pub use options::BranchOptions;
pub use search::{BranchSearch, OrbitMethodKind};
pub(super) use tracer::RESOLUTION;
pub use warm_start::{KnownOrbit, WarmStart};
