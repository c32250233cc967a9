//! Recorded channels of a shaker test.

use jounce_model::structure::Modes;
use jounce_spec::{DriveKind, Spec};

use super::RigError;
use crate::solution::SensorOutput;
use jounce_data::recording::Quantity;

/// Channel to be recorded.
pub(super) struct SensedChannel {
    pub name: String,
    pub quantity: Quantity,
    pub unit: &'static str,
    pub output: SensorOutput,
}

/// Returns the voltages of patches, forces of stops, the base acceleration, and accelerometers.
pub(super) fn sensors(
    spec: &Spec,
    modes: &Modes,
    accelerometers: &[String],
) -> Result<Vec<SensedChannel>, RigError> {
    let patches = modes
        .patch
        .keys()
        .enumerate()
        .map(|(k, name)| (format!("{name}.voltage"), SensorOutput::PatchVoltage(k)));
    let stops = spec
        .stop
        .keys()
        .enumerate()
        .map(|(k, name)| (format!("{name}.force"), SensorOutput::StopForce(k)));
    let mut all: Vec<(String, SensorOutput)> = patches.chain(stops).collect();
    let base_output = spec
        .drive
        .values()
        .find_map(|drive| drive.base())
        .map(|base| SensorOutput::Base(base.to_owned()));
    let force_output = spec
        .drive
        .values()
        .find(|drive| drive.kind == DriveKind::Force)
        .map(|drive| SensorOutput::Acceleration(drive.at.clone()));
    all.extend(
        base_output
            .or(force_output)
            .map(|output| ("base.acceleration".to_owned(), output)),
    );
    for point in accelerometers {
        if !modes.shape.contains_key(point) {
            let known = modes.shape.keys().cloned().collect::<Vec<_>>().join(", ");
            return Err(RigError::UnknownPoint {
                point: point.clone(),
                known,
            });
        }
        all.push((
            format!("{point}.acceleration"),
            SensorOutput::Acceleration(point.clone()),
        ));
    }
    Ok(all
        .into_iter()
        .map(|(name, output)| SensedChannel::new(name, output))
        .collect())
}

impl SensedChannel {
    fn new(name: String, output: SensorOutput) -> Self {
        let (quantity, unit) = match output {
            SensorOutput::PatchVoltage(_) | SensorOutput::LoadVoltage(_) => {
                (Quantity::Voltage, "V")
            }
            SensorOutput::StopForce(_) => (Quantity::Force, "N"),
            SensorOutput::Acceleration(_) | SensorOutput::Base(_) => {
                (Quantity::Acceleration, "m/s^2")
            }
        };
        Self {
            name,
            quantity,
            unit,
            output,
        }
    }
}
