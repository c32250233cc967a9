//! Studies in parts: one quantity at many points over the keys of a spec, on as many processes as there are.
//!
//! The points of a study are fixed by its text and its seed, and so is how they fall into parts. A part is computed by the same operations
//! wherever that happens, and is written whole or not at all, so that any number of processes, stopped and started in any order, come to
//! the same table.

mod design;
mod error;
mod evaluation;
mod faults;
mod folder;
mod key_quantities;
mod lock;
mod parametric_study;
mod quantity;
mod read;
mod read_quantity;
mod sampling;
mod shard;
mod sobol;

pub use design::{Design, Varied};
pub use error::StudyError;
pub use folder::{Folder, Status};
pub use parametric_study::Study;
pub use quantity::Quantity;
pub use sampling::Sampling;
pub use shard::Shard;
