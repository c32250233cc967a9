//! Failures of a run, and the checks of its initial state.

use super::StartState;
use jounce_dynamics::IntegrationError;
use jounce_model::contact::Law;
use jounce_model::plant::Plant;
use jounce_spec::Quantity;

/// Relative displacement by which an initial state may lie inside a rigid stop: saved states are
/// rounded.
const START_ROUNDOFF: f64 = 1e-9;

/// Failure of a run.
#[derive(Debug, Clone, PartialEq, thiserror::Error, serde::Serialize)]
#[serde(untagged)]
pub enum RunError {
    /// See [`IntegrationError`].
    #[error(transparent)]
    Integration(#[from] IntegrationError),
    /// The start state does not fit the harvester.
    #[error("{}", differences([(*modes, *wanted_modes), (*patches, *wanted_patches), (*drives, *wanted_drives)]))]
    StateDoesNotFit {
        /// Modes of the state.
        modes: usize,
        /// Patches of the state.
        patches: usize,
        /// Drives of the state.
        drives: usize,
        /// Modes of the harvester.
        wanted_modes: usize,
        /// Patches of the harvester.
        wanted_patches: usize,
        /// Drives of the harvester.
        wanted_drives: usize,
    },
    /// The run starts inside a rigid stop.
    #[error(
        "stop.{stop}.gap: the run starts {} inside this stop, and nothing enters a rigid one; give a larger gap, a run.start outside it, or a law that yields",
        Quantity::Length.write_rounded(*depth_m, 4)
    )]
    StartsInside {
        /// Name of the stop.
        stop: String,
        /// Depth inside the stop, m.
        depth_m: f64,
    },
    /// The plant cannot be built with the drive angles of the state.
    #[error(transparent)]
    Plant(#[from] jounce_model::plant::PlantError),
}

/// Names the counts of a start state that differ from those of the harvester; without one, a value is
/// wrong.
fn differences(counts: [(usize, usize); 3]) -> String {
    let names = ["modes", "electrical states", "drives"];
    let differs = names
        .iter()
        .zip(counts)
        .filter(|(_, (own, wanted))| own != wanted);
    let texts: Vec<String> = differs
        .map(|(name, (own, wanted))| format!("{own} {name}, here {wanted}"))
        .collect();
    match texts.is_empty() {
        true => "the start state holds a value that is not finite".to_owned(),
        false => format!(
            "the start state is of another harvester: {}",
            texts.join("; ")
        ),
    }
}

/// Checks that a start state has the variables of the harvester.
pub(super) fn check(plant: &Plant, start: &StartState) -> Result<(), RunError> {
    if start.fits(plant) {
        return Ok(());
    }
    Err(RunError::StateDoesNotFit {
        modes: start.displacement.len(),
        patches: start.voltage_v.len() + start.current_a.len(),
        drives: start.drive_angle_rad.len(),
        wanted_modes: plant.system.modes.len(),
        wanted_patches: plant.electrical.len(),
        wanted_drives: plant.system.drives.len(),
    })
}

/// Checks that no point lies inside a rigid stop by more than roundoff.
pub fn check_outside(plant: &Plant, displacement: &[f64]) -> Result<(), RunError> {
    let stops = plant.system.stops.iter().enumerate();
    for (index, stop) in stops.filter(|(_, stop)| matches!(stop.law, Law::Rigid(_))) {
        let (along, base_m) = (
            stop.shape.iter().zip(displacement),
            plant.approached_m(index, 0.0),
        );
        let nothing = (base_m, stop.gap_m.abs() + base_m.abs());
        let (position_m, reach_m) = along.fold(nothing, |(sum, size), (s, q)| {
            (sum + s * q, size + (s * q).abs())
        });
        if position_m - stop.gap_m > START_ROUNDOFF * reach_m {
            return Err(RunError::StartsInside {
                stop: stop.name.clone(),
                depth_m: position_m - stop.gap_m,
            });
        }
    }
    Ok(())
}
