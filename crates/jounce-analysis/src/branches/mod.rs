//! Branches of periodic orbits over one key of a spec.

mod branch;
mod branch_tracer;
mod branch_update;
mod events;
mod line_error;
mod options;
mod search;
mod simplified;
mod warm_start;

pub use branch::{Bifurcation, Branch, BranchKind, BranchPoint, Termination};
pub(super) use branch_tracer::tracer::RESOLUTION;
pub use branch_update::{BranchUpdate, Extrapolation, UpdatedBranches};
pub use events::{NotProved, ProofGap, QuantityLevel};
pub use line_error::LineErrors;
pub use options::BranchOptions;
pub(crate) use search::SAME_ORBIT_DISTANCE;
pub use search::{BranchSearch, OrbitMethodKind};
pub use warm_start::{KnownOrbit, WarmStart};
