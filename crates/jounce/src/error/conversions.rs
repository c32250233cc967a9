//! Errors of the layers below as errors of the façade.

use super::Error;
use impact_harvester_2019::ReproduceError;
use impact_harvester_2019::experiment::ExperimentError;
use jounce_analysis::AnalysisError;
use jounce_analysis::run::{RunError, StartFileError};
use jounce_analysis::study::StudyError;
use jounce_continuation::ContinuationError;
use jounce_design::DesignError;
use jounce_dynamics::{IntegrationError, SensitivityError};
use jounce_experiment::solution::SolutionError;
use jounce_model::plant::PlantError;
use jounce_model::structure::StructureError;
use jounce_orbits::OrbitError;
use jounce_spec::Fault;

impl From<Fault> for Error {
    fn from(fault: Fault) -> Self {
        Self::Spec(fault.into())
    }
}

impl From<StartFileError> for Error {
    fn from(error: StartFileError) -> Self {
        Self::Analysis(error.into())
    }
}

impl From<RunError> for Error {
    fn from(error: RunError) -> Self {
        Self::Analysis(error.into())
    }
}

impl From<OrbitError<AnalysisError>> for Error {
    fn from(error: OrbitError<AnalysisError>) -> Self {
        match error {
            OrbitError::Integration(SensitivityError::Integration(IntegrationError::Stopped {
                ..
            })) => Self::Stopped,
            error => Self::Orbit(error),
        }
    }
}

impl From<ContinuationError<OrbitError<AnalysisError>>> for Error {
    fn from(error: ContinuationError<OrbitError<AnalysisError>>) -> Self {
        match error {
            ContinuationError::Family(error) => error.into(),
            error => Self::Continuation(Box::new(error)),
        }
    }
}

impl From<DesignError> for Error {
    fn from(error: DesignError) -> Self {
        match error {
            DesignError::Stopped => Self::Stopped,
            error => Self::Design(Box::new(error)),
        }
    }
}

impl From<StudyError> for Error {
    fn from(error: StudyError) -> Self {
        Self::Study(Box::new(error))
    }
}

impl From<SolutionError> for Error {
    fn from(error: SolutionError) -> Self {
        Self::Solution(Box::new(error))
    }
}

impl From<ExperimentError> for Error {
    fn from(error: ExperimentError) -> Self {
        Self::Reproduce(Box::new(error))
    }
}

impl From<ReproduceError> for Error {
    fn from(error: ReproduceError) -> Self {
        ExperimentError::from(error).into()
    }
}

impl From<StructureError> for Error {
    fn from(error: StructureError) -> Self {
        Self::Analysis(error.into())
    }
}

impl From<PlantError> for Error {
    fn from(error: PlantError) -> Self {
        Self::Analysis(error.into())
    }
}
