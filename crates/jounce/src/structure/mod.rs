//! Beams, masses and supports to mass-normalised modes.
mod modes;
pub use modes::{Modes, PatchModes};
