//! Initial state of a run.

use jounce_io::store::{self, StoreError};
use jounce_model::plant::Plant;
use jounce_model::structure::Modes;
use jounce_spec::{Spec, Start};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// A state file that cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error, Serialize)]
#[error("{reason}; write a start state with `jounce run SPEC --save-state FILE`")]
pub struct StartFileError {
    /// The file.
    pub path: PathBuf,
    /// The reason, with the path.
    pub reason: String,
}

/// State of a harvester at one time, in coordinates that do not depend on load, stop or drive.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StartState {
    /// Modal displacements `q`, kg^1/2 m.
    pub displacement: Vec<f64>,
    /// Modal velocities `q'`, kg^1/2 m/s.
    pub velocity: Vec<f64>,
    /// Voltage of each electrical node, V; a node is one patch unless several share a circuit.
    pub voltage_v: Vec<f64>,
    /// Current of each inductor, A.
    #[serde(default)]
    pub current_a: Vec<f64>,
    /// Angle of each drive (argument of its sine), rad; a run from this state continues it.
    pub drive_angle_rad: Vec<f64>,
}

/// Returns the digest of a spec with the text of the state file that it names, relative to `folder`.
/// Two specs with the same text have the same recordings and the same initial state. A file that
/// cannot be read counts as empty.
pub fn identity_text(spec: &Spec, folder: &Path) -> String {
    let state = match &spec.run.start {
        Start::State(path) => std::fs::read_to_string(folder.join(path)).unwrap_or_default(),
        Start::Rest | Start::Linear => String::new(),
    };
    format!("{}\n{state}", spec.hash_hex())
}

impl StartState {
    /// Reads a state that a run has saved.
    ///
    /// # Errors
    /// A file that cannot be read or holds no state.
    pub fn read(path: &Path) -> Result<Self, StartFileError> {
        let fault = |reason: String| StartFileError {
            path: path.to_path_buf(),
            reason,
        };
        let text = std::fs::read_to_string(path);
        let text = text.map_err(|error| fault(store::unreadable(path, &error)))?;
        let not_a_state = |_| fault(format!("{} holds no start state", path.display()));
        serde_json::from_str(&text).map_err(not_a_state)
    }

    /// Writes the state to a file, completely or not at all.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), StoreError> {
        let text = serde_json::to_string_pretty(self).unwrap_or_default();
        store::write(path, text.as_bytes())
    }

    /// Returns the state at rest, with each drive at its initial angle.
    pub fn rest(plant: &Plant) -> Self {
        let n = plant.system.modes.len();
        Self {
            displacement: vec![0.0; n],
            velocity: vec![0.0; n],
            voltage_v: vec![0.0; plant.electrical.nodes.len()],
            current_a: vec![0.0; plant.electrical.inductors.len()],
            drive_angle_rad: plant
                .system
                .drives
                .iter()
                .map(|drive| drive.phase_rad)
                .collect(),
        }
    }

    /// Returns the steady state of the harvester without its stops, under its sinusoidal drives and
    /// gravity. Free bodies have no steady state and are at rest.
    pub fn linear(plant: &Plant) -> Self {
        Self::from_blocks(plant, &plant.resting(), 0.0)
    }

    /// Converts a state in block coordinates at a time of a run whose drives started at their
    /// initial angles at time 0.
    pub fn from_blocks(plant: &Plant, y: &[f64], time_s: f64) -> Self {
        let n = plant.system.modes.len();
        let x = plant.to_physical(y, time_s);
        let angle = |drive: &jounce_model::plant::Drive| {
            (drive.phase_rad + std::f64::consts::TAU * (drive.frequency_hz * time_s).fract())
                .rem_euclid(std::f64::consts::TAU)
        };
        Self {
            displacement: x[..n].to_vec(),
            velocity: x[n..2 * n].to_vec(),
            voltage_v: x[2 * n..2 * n + plant.electrical.nodes.len()].to_vec(),
            current_a: x[2 * n + plant.electrical.nodes.len()..].to_vec(),
            drive_angle_rad: plant.system.drives.iter().map(angle).collect(),
        }
    }

    /// Returns the state with the initial velocities of the masses of a spec: `q' += m shape v`.
    /// `m` is the mass of the body and of all masses fixed to it.
    #[must_use]
    pub fn with_velocities(mut self, spec: &Spec, modes: &Modes) -> Self {
        for (name, mass) in &spec.mass {
            let (Some(velocity_m_s), Some(shape)) = (mass.velocity_m_s, modes.shape.get(name))
            else {
                continue;
            };
            let fixed = spec
                .mass
                .values()
                .filter(|other| other.stiffness_n_m.is_none() && spec.is_fixed_to(&other.on, name));
            let mass_kg = mass.mass_kg + fixed.map(|other| other.mass_kg).sum::<f64>();
            self.velocity
                .iter_mut()
                .zip(shape)
                .for_each(|(velocity, shape)| *velocity += mass_kg * shape * velocity_m_s);
        }
        self
    }

    /// Returns `(q, q', V, i)` as one vector.
    pub fn physical(&self) -> Vec<f64> {
        [
            self.displacement.as_slice(),
            &self.velocity,
            &self.voltage_v,
            &self.current_a,
        ]
        .concat()
    }

    /// True where the state has the dimensions of a plant and is finite.
    pub fn fits(&self, plant: &Plant) -> bool {
        let modes = &plant.system.modes;
        self.displacement.len() == modes.len()
            && self.velocity.len() == modes.len()
            && self.voltage_v.len() == plant.electrical.nodes.len()
            && self.current_a.len() == plant.electrical.inductors.len()
            && self.drive_angle_rad.len() == plant.system.drives.len()
            && self
                .physical()
                .iter()
                .chain(&self.drive_angle_rad)
                .all(|value| value.is_finite())
    }
}
