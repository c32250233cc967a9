//! Brute force: integration of every start by a method that shares no code with the library.

mod classify;
mod dormand_prince;
mod events;
mod first_root;
mod flow;
mod guard;
mod law;
mod model;
mod peaks;
mod record;
mod scales;
mod taylor;
mod taylor_step;

pub use classify::{Ending, Kind, Patience, classify};
pub use flow::{Flow, STEP_TOLERANCE};
pub use law::Phase;
pub use model::ReferenceModel;
pub use peaks::Peak;
pub use record::{Passage, Record, Work};
