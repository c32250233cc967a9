//! Studies: many runs of one spec.

mod journal;
mod prepared;
mod sweep;
mod sweep_point;

pub use journal::{Journal, JournalError};
pub use prepared::{Prepared, StudyError};
pub use sweep::{Direction, Sweep};
pub use sweep_point::{SweepPoint, Way};
