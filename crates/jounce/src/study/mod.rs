//! Studies: many runs of one spec.

mod basins;
mod branches;
mod journal;
mod jumps;
mod parameter;
mod prepared;
mod sweep;
mod sweep_point;

pub use basins::{Attractor, Basins, BasinsAnswer, Cloud, Fate, Lyapunov, Share, Wandering, largest_exponent, wilson};
pub use branches::{Bifurcation, Branch, BranchKind, BranchPoint, BranchSearch, Ending, Method, settled_orbit};
pub use journal::{Journal, JournalError};
pub use jumps::{JumpCurve, JumpPoint, JumpSearch, KeyPlane};
pub use parameter::Parameter;
pub use prepared::{Prepared, StudyError};
pub use sweep::{Direction, Sweep};
pub use sweep_point::{SweepPoint, Way};
