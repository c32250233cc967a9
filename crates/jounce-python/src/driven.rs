//! Checks of the drives for studies of orbits: a common period and a nonzero amplitude.

use crate::failure::Failure;
use jounce_core::analysis::AnalysisError;
use jounce_core::orbit::OrbitError;
use jounce_core::plant::Plant;

/// Refuses a harvester whose only orbit is rest, or whose drives have no common period.
pub fn check(plant: &Plant, what: &str) -> Result<(), Failure> {
    if let Some(drive) = plant.system.aperiodic() {
        return Err(AnalysisError::Aperiodic {
            drive: drive.to_owned(),
        }
        .into());
    }
    let has_moving_drive = plant
        .system
        .drives
        .iter()
        .any(|drive| drive.amplitude_n != 0.0);
    match (plant.period_s(), has_moving_drive) {
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
