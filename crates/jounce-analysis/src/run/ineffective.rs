//! Drives without effect, and devices that never start.

use super::{RunResult, Warning};
use jounce_model::plant::{Bridge, Plant};
use jounce_spec::Spec;

/// Returns a warning where nothing drives and nothing moves.
pub(super) fn no_drive(spec: &Spec, result: &RunResult) -> Option<Warning> {
    (spec.drive.is_empty() && result.is_trivial()).then_some(Warning::NoDrive)
}

/// Returns a warning for each force that moves no mode.
pub(super) fn drives(spec: &Spec, plant: &Plant) -> Vec<Warning> {
    let system = &plant.system;
    let sines = system.drives.iter();
    let sines = sines.map(|drive| (&drive.name, &drive.shape, &drive.base));
    let signals = system.signals.iter();
    let signals = signals.map(|signal| (&signal.name, &signal.shape, &signal.base));
    let is_still = |shape: &[f64]| shape.iter().all(|share| *share == 0.0);
    sines
        .chain(signals)
        .filter(|(name, ..)| spec.drive.contains_key(*name))
        .filter(|(_, shape, base)| base.is_none() && is_still(shape))
        .map(|(drive, ..)| Warning::Ineffective {
            drive: drive.clone(),
        })
        .collect()
}

/// Returns a warning for each device that never starts.
pub(super) fn devices(plant: &Plant, result: &RunResult) -> Vec<Warning> {
    let never = |(k, bridge): (usize, &Bridge)| {
        let regulator = bridge.regulator()?;
        let device = (result.devices.iter()).find(|device| device.name == bridge.name)?;
        let storage = plant.electrical.bridges[k].storage?;
        let storage_v = *result.end.voltage_v.get(storage)?;
        device.cold_start_s.is_none().then(|| Warning::NeverStarts {
            circuit: bridge.name.clone(),
            storage_v,
            start_v: regulator.start_v,
        })
    };
    let bridges = plant.system.bridges.iter().enumerate();
    bridges.filter_map(never).collect()
}
