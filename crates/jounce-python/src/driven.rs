//! Checks of the drives for studies of orbits: a common period and a nonzero amplitude.

use crate::failure::Failure;
use crate::spec::Spec;
use jounce_core::analysis::AnalysisError;
use jounce_core::orbit::OrbitError;
use jounce_core::plant::Plant;
use jounce_core::spec::NumericKey;

/// Returns the key of the first drive's frequency, and its value in Hz; `what` is the study that
/// needs it.
pub fn frequency(spec: &Spec, what: &str) -> Result<(NumericKey, f64), Failure> {
    let none = || {
        Failure::new(
            "ArgumentError",
            format!("{what} needs a drive: add [drive.NAME] to the spec"),
        )
    };
    let (name, drive) = spec.spec().drive.iter().next().ok_or_else(none)?;
    let value = drive
        .frequency_hz()
        .ok_or_else(|| AnalysisError::Aperiodic {
            drive: name.clone(),
        })?;
    Ok((spec.key(&format!("drive.{name}.frequency"))?, value))
}

/// Refuses a harvester whose only orbit is rest, or whose drives have no common period.
pub fn check(plant: &Plant, what: &str) -> Result<(), Failure> {
    if let Some(drive) = plant.system.aperiodic() {
        return Err(AnalysisError::Aperiodic {
            drive: drive.to_owned(),
        }
        .into());
    }
    let moving = plant
        .system
        .drives
        .iter()
        .any(|drive| drive.amplitude_n != 0.0);
    match (plant.period_s(), moving) {
        (Some(_), true) => Ok(()),
        (Some(_), false) => Err(Failure::new(
            "ArgumentError",
            format!("the amplitude of the drive is 0; {what} needs a drive that moves"),
        )),
        (None, _) => Err(OrbitError::<AnalysisError>::Frequencies {
            frequencies: plant.tones.len(),
        }
        .into()),
    }
}
