//! Simulated hammer test.

use super::RigOptions;
use crate::error::Error;
use crate::recording::Recording;
use jounce_experiment::rig::{HammerTest, hammer_test};
use jounce_model::linear::FrfOutput;
use jounce_model::plant::{Plant, System};
use jounce_model::structure::modes_holding;
use jounce_spec::{Gravity, Spec};

/// Hits a point of the linear structure; records the accelerometers, by default every point and
/// patch.
pub(super) fn record(
    mut spec: Spec,
    point: &str,
    fixed: &[String],
    options: &RigOptions,
) -> Result<Recording, Error> {
    spec.take_drives_away();
    spec.stop.clear();
    spec.gravity = Gravity::default();
    let modes = modes_holding(&spec, fixed)?;
    let acceleration = |point: &String| FrfOutput::Acceleration(point.clone());
    let voltage = |patch: &String| FrfOutput::Voltage(patch.clone());
    let responses = match options.at.is_empty() {
        true => (modes.shape.keys().map(acceleration))
            .chain(modes.patch.keys().map(voltage))
            .collect(),
        false => options.at.iter().map(acceleration).collect(),
    };
    let test = HammerTest {
        point: point.to_owned(),
        responses,
        hits: options.hits,
        block_s: options.block_s,
        peak_force_n: options.peak_n,
        contact_time_s: options.contact_s,
        rate_hz: options.rate_hz,
        sensor: options.sensor(),
        seed: options.seed,
    };
    let plant = Plant::new(System::assemble(&spec, modes)?)?;
    Ok(hammer_test(&plant, &test)?.into())
}
