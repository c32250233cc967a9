//! A virtual rig: what sensors would record of a model, so that the truth behind a recording is known.
//!
//! A hammer strikes a linear structure with half sines `F(t) = P sin(pi t / T)`, compression positive. The responses over the whole record are
//! `IDFT(H(f) DFT(F))` with the record padded by zeros until the slowest mode has died: exact for the band-limited force that the samples
//! stand for. A sensor adds white noise and rounds to the steps of its converter.
mod error;
mod hammer;
mod sensor;
mod shaken;

pub use error::RigError;
pub use hammer::{HammerTest, hammer_test};
pub use sensor::Sensor;
pub use shaken::shaken;
