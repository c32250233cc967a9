//! Initial state of the run of a rig.

use std::path::Path;

use jounce_analysis::run::StartState;
use jounce_analysis::{AnalysisError, Model};
use jounce_model::plant::{Plant, System};
use jounce_model::structure::Modes;
use jounce_spec::{Spec, Start};

/// Returns the start that `run.start` of a spec names, for modes with held bodies; a state file is
/// relative to `folder`.
///
/// # Errors
/// A plant that cannot be built, a state file that cannot be read or does not match.
pub fn start_of_run(
    spec: &Spec,
    modes: &Modes,
    folder: &Path,
) -> Result<StartState, AnalysisError> {
    let plant = || Plant::new(System::assemble(spec, modes.clone())?);
    Ok(match spec.run.start {
        Start::Rest => StartState::rest(&plant()?),
        Start::Linear => StartState::linear(&plant()?),
        Start::State(_) => Model::new(spec.clone())?.start(folder)?,
    })
}
