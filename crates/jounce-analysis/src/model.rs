//! From a spec to a model that can be integrated; a changed key rebuilds only the parts that depend
//! on it.

use super::ModelAtStart;
use crate::run::{RunError, StartFileError, StartState};
use jounce_control::Control;
use jounce_dynamics::Kernel;
use jounce_model::plant::{Plant, PlantError, System};
use jounce_model::structure::{self, Modes, StructureError};
use jounce_signal::RandomStream;
use jounce_spec::{DriveSignal, Spec, Start};
use std::path::Path;
use std::sync::Arc;

/// Error of an analysis or of one of its points.
#[derive(Debug, thiserror::Error)]
pub enum AnalysisError {
    /// Error of the structure.
    #[error(transparent)]
    Structure(#[from] StructureError),
    /// Error of the plant.
    #[error(transparent)]
    Plant(#[from] PlantError),
    /// Error of the integration.
    #[error(transparent)]
    Run(#[from] RunError),
    /// The spec does not allow this value of the swept key.
    #[error("{0}")]
    Value(#[from] jounce_spec::Fault),
    /// A part is aperiodic, but the analysis needs a periodic response.
    #[error(
        "{part} is not periodic, so there is no periodic response to find; integrate it with `jounce run` or, over a key, `jounce sweep`; where a drive is noise, `jounce ensemble` integrates many realisations"
    )]
    Aperiodic {
        /// The part: ``drive `NAME` `` or ``regulator `NAME` ``.
        part: String,
    },
    /// A sweep has a drive with noise.
    #[error(
        "drive `{drive}` is noise, and a sweep has one run at each value, which says little of its mean power; `jounce ensemble` integrates many realisations, and a study with `command = \"ensemble\"` does so over a key"
    )]
    SweptNoise {
        /// Name of the drive.
        drive: String,
    },
    /// Periodic responses do not depend on this key.
    #[error(
        "{key} is an option of a run, and periodic responses do not depend on it; give a key of the harvester or of its drive, such as drive.NAME.frequency, stop.NAME.gap or circuit.NAME.resistance"
    )]
    OfRuns {
        /// Path of the key.
        key: String,
    },
    /// The place of a fold has no derivative in closed form.
    #[error("the derivative of a fold by {key} is not known, because a circuit is rectified")]
    NoFoldDerivative {
        /// Path of the key.
        key: String,
    },
    /// The ensemble has no drive of noise.
    #[error("an ensemble needs noise: give a drive `signal = \"noise\"`, or compute one run")]
    NoNoise,
    /// Error of the journal of finished points.
    #[error(transparent)]
    Journal(#[from] super::JournalError),
    /// A state file cannot be used.
    #[error(transparent)]
    StartFile(#[from] StartFileError),
}

/// A spec with its kernel.
#[derive(Debug)]
pub struct Model {
    /// The spec.
    pub spec: Spec,
    /// Kernel of the spec.
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

    /// Builds a model whose integrations run under `control`. After cancellation no noise is
    /// generated either, so a model made under a cancelled control must not serve another one.
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

    /// Returns the model with its tables under another control.
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

    /// Returns the system of a changed spec; modes are reused when no body changed.
    ///
    /// # Errors
    /// [`AnalysisError::Structure`], [`AnalysisError::Plant`].
    pub fn system(&self, spec: &Spec) -> Result<System, AnalysisError> {
        let modes = if has_same_modes(&self.spec, spec) {
            Arc::clone(&self.modes)
        } else {
            Arc::new(structure::modes(spec)?)
        };
        let is_stopped = || self.kernel.control.is_stopped();
        Ok(System::assemble_unless(spec, modes, &is_stopped)?)
    }

    /// Returns the model of a changed spec. Modes are reused when no body changed, step tables when
    /// no circuit changed.
    ///
    /// # Errors
    /// As [`Model::new`].
    pub fn changed(&self, spec: Spec) -> Result<Self, AnalysisError> {
        if !has_same_modes(&self.spec, &spec) {
            return Self::watched(spec, &self.kernel.control);
        }
        let system = self.system(&spec)?;
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

    /// Returns the kernel with another realisation of its noise: number `member` of a seed.
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

    /// Returns the start state that the spec specifies; the path of a state file is relative to
    /// `folder`.
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
            Start::State(path) => Ok(StartState::read(&folder.join(path))?),
        }
    }

    /// Returns a kernel whose drives continue at the phase angles of a state.
    ///
    /// # Errors
    /// [`PlantError`], [`RunError::StateDoesNotFit`].
    pub fn from_state(&self, start: &StartState) -> Result<ModelAtStart<'_>, AnalysisError> {
        let model_drives = &self.kernel.plant.system.drives;
        if model_drives
            .iter()
            .zip(&start.drive_angle_rad)
            .all(|(drive, angle)| drive.phase_rad == *angle)
        {
            return Ok(ModelAtStart::Same(&self.kernel));
        }
        let mut drives = model_drives.clone();
        drives
            .iter_mut()
            .zip(&start.drive_angle_rad)
            .for_each(|(drive, angle)| drive.phase_rad = *angle);
        Ok(ModelAtStart::Turned(Box::new(
            self.kernel.with_drives(drives)?,
        )))
    }
}

/// True where two specs have the same modes and shapes. A table of the spec is a part of the
/// comparison unless it is excluded here by name, so a new one does not compile before it is
/// either compared or excluded. Of the drives only the names of their bases matter.
pub fn has_same_modes(a: &Spec, b: &Spec) -> bool {
    /// The tables that determine the modes.
    fn structure(spec: &Spec) -> impl PartialEq + use<'_> {
        let Spec {
            beam,
            plate,
            patch,
            layer,
            mass,
            modal,
            damping,
            reduction,
            stop: _,
            circuit: _,
            regulator: _,
            device: _,
            drive: _,
            gravity: _,
            run: _,
            source: _,
        } = spec;
        let bodies = (beam, plate, patch, layer, mass, modal);
        (bodies, damping, reduction, spec.bases())
    }
    structure(a) == structure(b)
}
