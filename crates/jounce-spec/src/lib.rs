//! The spec of a harvester: one TOML file; all faults are reported at once with their places.
//!
//! [`SpecFile`] holds the text and its overrides, [`Spec`] the resulting values in SI units. One
//! table of keys (`keys/`) drives reading, range checks, suggestions, overrides, sweeps, printing,
//! the JSON Schema ([`schema`]) and the key reference ([`reference_markdown`]).

pub mod bibliography;
mod fault;
mod file;
mod force_curve;
mod force_table_file;
pub mod hertz;
mod key;
mod key_range;
mod key_reference;
mod keys;
pub mod material;
mod model;
mod nearest;
mod numeric_key;
mod overrides;
mod read;
mod read_error;
mod recording;
mod schema;
mod source;
pub mod starter;
mod validation;
mod write;

pub use fault::{Fault, Faults};
pub use file::SpecFile;
pub use force_curve::ForceCurve;
pub use jounce_units::{Quantity, QuantityError, is_unit};
pub use key_range::{KeyRange, quantity_range};
pub use key_reference::reference_markdown;
pub use model::*;
pub use nearest::{did_you_mean, nearest};
pub use numeric_key::NumericKey;
pub use read_error::ReadError;
pub use recording::{Recording, RecordingError, driving_channel};
pub use schema::schema;
