//! Conditions of periodic orbits: a drive that moves, and a common period of all drives.

use crate::error::Error;
use crate::harvester::Harvester;
use jounce_analysis::AnalysisError;
use jounce_model::plant::Plant;
use jounce_orbits::OrbitError;
use jounce_spec::NumericKey;

/// Returns the key of the frequency of the first drive, and its value, Hz; `what` needs the drive.
pub fn frequency(harvester: &Harvester, what: &'static str) -> Result<(NumericKey, f64), Error> {
    let drive = harvester.spec().drive.iter().next();
    let (name, drive) = drive.ok_or(Error::NoDrive { what })?;
    let aperiodic = || AnalysisError::Aperiodic {
        part: format!("drive `{name}`"),
    };
    let value = drive.frequency_hz().ok_or_else(aperiodic)?;
    Ok((
        harvester
            .file()
            .numeric_key(&format!("drive.{name}.frequency"))?,
        value,
    ))
}

/// Checks that a drive moves and that all drives have a common period; `what` needs both.
///
/// # Errors
/// [`Error::DriveAtRest`]: the only orbit is rest. [`Error::Analysis`] and [`Error::Orbit`]: there is
/// no common period.
pub fn check_drives(plant: &Plant, what: &'static str) -> Result<(), Error> {
    if let Some(part) = plant.system.aperiodic() {
        return Err(AnalysisError::Aperiodic { part }.into());
    }
    if plant.period_s().is_none() {
        let frequencies = plant.tones.len();
        return Err(OrbitError::<AnalysisError>::Frequencies { frequencies }.into());
    }
    let moves = plant
        .system
        .drives
        .iter()
        .any(|drive| drive.amplitude_n != 0.0);
    if moves {
        Ok(())
    } else {
        Err(Error::DriveAtRest { what })
    }
}
