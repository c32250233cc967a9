//! Studies: many runs of one spec.

mod branches;
mod journal;
mod parameter;
mod prepared;
mod sweep;
mod sweep_point;

pub use branches::{Bifurcation, Branch, BranchKind, BranchPoint, BranchSearch, Ending, Method, settled_orbit};
pub use journal::{Journal, JournalError};
pub use parameter::Parameter;
pub use prepared::{Prepared, StudyError};
pub use sweep::{Direction, Sweep};
pub use sweep_point::{SweepPoint, Way};
