//! From a spec to something that can be marched, keeping what a changed key leaves as it was.

use super::ModelAtStart;
use crate::drive::RandomStream;
use crate::integrate::{Control, Kernel};
use crate::plant::{Plant, PlantError, System};
use crate::run::{RunError, StartState};
use crate::spec::{DriveSignal, Spec, Start};
use crate::structure::{self, Modes, StructureError};
use std::path::Path;
use std::sync::Arc;

/// Why a study, or one of its points, cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum AnalysisError {
    /// The structure.
    #[error(transparent)]
    Structure(#[from] StructureError),
    /// The plant.
    #[error(transparent)]
    Plant(#[from] PlantError),
    /// The march.
    #[error(transparent)]
    Run(#[from] RunError),
    /// A value of the swept key that the spec does not allow.
    #[error("{0}")]
    Value(#[from] crate::spec::Fault),
    /// A drive that never repeats itself, where answers that do are asked for.
    #[error(
        "drive `{drive}` does not repeat itself, so that there is no periodic answer to look for; use `jounce run` for one march of it, or `jounce ensemble` for many realisations of noise"
    )]
    Aperiodic {
        /// Name of the drive.
        drive: String,
    },
    /// A key that periodic answers do not depend on.
    #[error(
        "{key} says how one run is marched, and periodic answers do not depend on it: give a key of the harvester or of its drive, as drive.NAME.frequency, stop.NAME.gap or circuit.NAME.resistance"
    )]
    OfRuns {
        /// Path of the key.
        key: String,
    },
    /// An ensemble without noise.
    #[error(
        "an ensemble needs noise: give a drive `signal = \"noise\"`; `jounce run` marches what is not random"
    )]
    NoNoise,
    /// The journal of finished points.
    #[error(transparent)]
    Journal(#[from] super::JournalError),
    /// A start state that cannot be read.
    #[error(
        "the start state {path} cannot be used: {reason}; write one with `jounce run SPEC --save-state FILE`"
    )]
    StartFile {
        /// The file.
        path: String,
        /// What is wrong.
        reason: String,
    },
}

/// A spec with its kernel.
#[derive(Debug)]
pub struct Model {
    /// The spec.
    pub spec: Spec,
    /// Its kernel.
    pub kernel: Kernel,
    modes: Arc<Modes>,
}

impl Model {
    /// Solves the structure and diagonalises the plant.
    ///
    /// # Errors
    /// [`AnalysisError::Structure`], [`AnalysisError::Plant`].
    pub fn new(spec: Spec) -> Result<Self, AnalysisError> {
        Self::watched(spec, &Control::default())
    }

    /// The same, all marches made from it watched. Once the control says so, no noise is made any more either, so that what was made under
    /// a control that is stopped serves no other one.
    ///
    /// # Errors
    /// As [`Model::new`].
    pub fn watched(spec: Spec, control: &Control) -> Result<Self, AnalysisError> {
        let modes = Arc::new(structure::modes(&spec)?);
        let system = System::assemble_unless(&spec, Arc::clone(&modes), &|| control.is_stopped())?;
        let kernel = Kernel::new(Plant::new(system)?)?.with_control(control);
        Ok(Self {
            spec,
            kernel,
            modes,
        })
    }

    /// The same harvester and tables under another control.
    ///
    /// # Errors
    /// [`AnalysisError::Plant`].
    pub fn with_control(&self, control: &Control) -> Result<Self, AnalysisError> {
        let kernel = self
            .kernel
            .with_drives(self.kernel.plant.system.drives.clone())?
            .with_control(control);
        Ok(Self {
            spec: self.spec.clone(),
            kernel,
            modes: Arc::clone(&self.modes),
        })
    }

    /// The same for a changed spec: modes are kept when no body changed, step tables when no circuit did.
    ///
    /// # Errors
    /// As [`Model::new`].
    pub fn changed(&self, spec: Spec) -> Result<Self, AnalysisError> {
        if !same_bodies(&self.spec, &spec) {
            return Self::watched(spec, &self.kernel.control);
        }
        let system = System::assemble_unless(&spec, Arc::clone(&self.modes), &|| {
            self.kernel.control.is_stopped()
        })?;
        let signals = system.signals.clone();
        let kernel = match (
            self.spec.circuit == spec.circuit,
            self.spec.stop == spec.stop,
        ) {
            (true, true) => self.kernel.with_drives(system.drives)?,
            (true, false) if self.spec.drive == spec.drive => self.kernel.with_stops(system.stops),
            (true, false) => self
                .kernel
                .with_stops(system.stops)
                .with_drives(system.drives)?,
            (false, _) => {
                return Ok(Self {
                    kernel: Kernel::new(Plant::new(system)?)?.with_control(&self.kernel.control),
                    spec,
                    modes: Arc::clone(&self.modes),
                });
            }
        };
        let kernel = if kernel.plant.system.signals == signals {
            kernel
        } else {
            kernel.with_signals(signals)
        };
        Ok(Self {
            spec,
            kernel,
            modes: Arc::clone(&self.modes),
        })
    }

    /// The same with other realisations of its noise: number `member` of a seed.
    ///
    /// # Errors
    /// [`AnalysisError::NoNoise`].
    pub fn realised(&self, seed: u64, member: u64) -> Result<Kernel, AnalysisError> {
        let (mut spec, mut stream) = (self.spec.clone(), RandomStream::new(seed, member));
        let mut is_random = false;
        for drive in spec.drive.values_mut() {
            if let DriveSignal::Noise { seed, .. } = &mut drive.signal {
                *seed = stream.seed();
                is_random = true;
            }
        }
        if !is_random {
            return Err(AnalysisError::NoNoise);
        }
        Ok(self
            .kernel
            .with_signals(System::signals(&spec, &self.modes, &|| {
                self.kernel.control.is_stopped()
            })?))
    }

    /// The start that the spec asks for; a state file is read relative to `folder`.
    ///
    /// # Errors
    /// [`AnalysisError::StartFile`].
    pub fn start(&self, folder: &Path) -> Result<StartState, AnalysisError> {
        match &self.spec.run.start {
            Start::Rest => {
                Ok(StartState::rest(&self.kernel.plant).with_velocities(&self.spec, &self.modes))
            }
            Start::Linear => {
                Ok(StartState::linear(&self.kernel.plant).with_velocities(&self.spec, &self.modes))
            }
            Start::State(path) => {
                let path = folder.join(path);
                let fault = |reason: String| AnalysisError::StartFile {
                    path: path.display().to_string(),
                    reason,
                };
                let text =
                    std::fs::read_to_string(&path).map_err(|error| fault(error.to_string()))?;
                serde_json::from_str(&text).map_err(|error| fault(error.to_string()))
            }
        }
    }

    /// A kernel whose drives go on at the angles of a state.
    ///
    /// # Errors
    /// [`PlantError`], [`RunError::StateDoesNotFit`].
    pub fn from_state(&self, start: &StartState) -> Result<ModelAtStart<'_>, AnalysisError> {
        let own = &self.kernel.plant.system.drives;
        if own
            .iter()
            .zip(&start.drive_angle_rad)
            .all(|(drive, angle)| drive.phase_rad == *angle)
        {
            return Ok(ModelAtStart::Same(&self.kernel));
        }
        let mut drives = own.clone();
        drives
            .iter_mut()
            .zip(&start.drive_angle_rad)
            .for_each(|(drive, angle)| drive.phase_rad = *angle);
        Ok(ModelAtStart::Turned(Box::new(
            self.kernel.with_drives(drives)?,
        )))
    }
}

fn same_bodies(a: &Spec, b: &Spec) -> bool {
    a.beam == b.beam
        && a.patch == b.patch
        && a.layer == b.layer
        && a.mass == b.mass
        && a.modal == b.modal
        && a.damping == b.damping
        && a.reduction == b.reduction
        && a.bases() == b.bases()
}
