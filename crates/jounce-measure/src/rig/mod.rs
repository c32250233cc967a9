//! A virtual rig: what sensors would record of a model, so that the truth behind a recording is known.
//!
//! A hammer strikes a linear structure with half sines `F(t) = P sin(pi t / T)`, compression positive. The responses over the whole record are
//! `IDFT(H(f) DFT(F))` with the record padded by zeros until the slowest mode has died: exact for the band-limited force that the samples
//! stand for. A sensor adds white noise and rounds to the steps of its converter.
//!
//! A shaker holds what it is told but for its [`Disturbance`], or moves the base as it was recorded ([`on_recorded_base`]). Cables and
//! accelerometers change the harvester itself ([`Cable`], [`carry`]). Between solutions that live side by side the record of a
//! [`ShakerTest`] jumps at the times that it is told.
mod base;
mod disturbance;
mod error;
mod hammer;
mod sensed_channel;
mod sensor;
mod sensor_loading;
mod shaker;
mod start;

pub use base::on_recorded_base;
pub use disturbance::{Disturbance, DriveCourse, SAMPLES_PER_CYCLE};
pub use error::RigError;
pub use hammer::{HammerTest, ResidualRinging, hammer_test, ringing};
pub use sensor::Sensor;
pub use sensor_loading::{Cable, carry};
pub use shaker::{ShakerTest, shaker_test};
pub use start::start_of_run;
