//! What the user says: one TOML file, every fault reported at once with its place.
mod model;
pub use model::*;
