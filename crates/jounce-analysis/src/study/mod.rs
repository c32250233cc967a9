//! Parametric studies: one quantity at many points over the keys of a spec, on any number of
//! processes.
//!
//! The text and the seed of a study fix its points and their division into parts. A part is
//! computed by the same operations everywhere, and is written completely or not at all. Any number
//! of processes, stopped and started in any order, therefore produce the same table.

mod card;
mod design;
mod error;
mod faults;
mod folder;
mod lock;
mod parametric_study;
mod quantity;
mod read;
mod sampling;
mod shard;
mod sobol;

pub use design::{Design, Varied};
pub use error::StudyError;
pub use faults::FaultCollector;
pub use folder::{Folder, Status};
pub use parametric_study::Study;
pub use quantity::Quantity;
pub use sampling::{CubePoints, Sampling};
pub use shard::Shard;
pub use sobol::MAX_DIMENSIONS as MAX_SOBOL_DIMENSIONS;
