//! Virtual test rig: simulates the recordings of sensors on a model, so that the true values are
//! known.
//!
//! A hammer strikes a linear structure with half sines `F(t) = P sin(pi t / T)`, compression
//! positive. The responses over the complete record are `IDFT(H(f) DFT(F))`, with the record
//! zero-padded until the slowest mode has decayed. This is exact for the band-limited force defined
//! by the samples. A sensor adds white noise and quantises to the steps of its converter.
//!
//! A shaker follows its setting except for its [`Disturbance`], or moves the base as recorded
//! ([`on_recorded_base`]). Cables and accelerometers change the harvester itself ([`Cable`],
//! [`add_accelerometers`]). The record of a [`ShakerTest`] jumps between coexisting
//! solutions at given times.
mod base;
mod disturbance;
mod error;
mod hammer;
mod jumps;
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
pub use sensor_loading::{Cable, add_accelerometers};
pub use shaker::{ShakerTest, shaker_test};
pub use start::start_of_run;

/// The paper's harvester with some keys set.
#[cfg(test)]
fn paper_spec(settings: &[(&str, &str)]) -> jounce_spec::Spec {
    let mut file = jounce_spec::SpecFile::from_text(include_str!(
        "../../../../examples/impact-harvester-2019/harvester.toml"
    ));
    for (key, value) in settings {
        file.set(key, value).expect("a key");
    }
    file.spec().expect("a spec")
}
