//! A virtual rig: what sensors would record of a model, so that the truth behind a recording is known.
//!
//! A hammer strikes a linear structure with half sines `F(t) = P sin(pi t / T)`, compression positive. The responses over the whole record are
//! `IDFT(H(f) DFT(F))` with the record padded by zeros until the slowest mode has died: exact for the band-limited force that the samples
//! stand for. A sensor adds white noise and rounds to the steps of its converter.
//!
//! A shaker holds what it is told but for its [`Wander`], or moves the base as it was recorded ([`on_recorded_base`]). Cables and
//! accelerometers change the harvester itself ([`Cable`], [`carry`]). Between solutions that live side by side the record of a
//! [`ShakerTest`] jumps at the times that it is told.
mod base;
mod error;
mod fitting;
mod hammer;
mod sensed;
mod sensor;
mod shaken;
mod start;
mod wander;

pub use base::on_recorded_base;
pub use error::RigError;
pub use fitting::{Cable, carry};
pub use hammer::{HammerTest, Ringing, hammer_test, ringing};
pub use sensor::Sensor;
pub use shaken::{ShakerTest, shaker_test};
pub use start::start_of_run;
pub use wander::{Course, SAMPLES, Wander};
