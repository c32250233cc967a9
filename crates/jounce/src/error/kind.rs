//! Kinds of errors.

use super::Error;
use jounce_analysis::run::RunError;
use jounce_analysis::study::StudyError;
use jounce_analysis::{AnalysisError, GridError};
use jounce_data::recording::ChannelError;
use jounce_design::DesignError;
use jounce_dynamics::IntegrationError;
use jounce_experiment::fit::FitError;
use jounce_experiment::rig::RigError;
use jounce_experiment::segmentation::SegmentationError;
use jounce_experiment::solution::SolutionError;
use jounce_orbits::OrbitError;
use jounce_signal::spectral::SpectralError;

/// Kinds of errors that a user treats differently.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ErrorKind {
    /// An option has a value that is not allowed; correct it.
    Option,
    /// The input is invalid; correct it.
    Input,
    /// The computation did not converge; change its settings.
    NotConverged,
    /// The user stopped the computation.
    Stopped,
}

impl Error {
    /// True where the start state of a run does not fit the harvester.
    pub fn is_of_start(&self) -> bool {
        matches!(
            self,
            Self::Analysis(AnalysisError::Run(RunError::StateDoesNotFit { .. }))
        )
    }

    /// Returns the kind.
    ///
    /// ```
    /// let error = jounce::Harvester::from_text("", ".").unwrap_err();
    /// assert_eq!(error.kind(), jounce::ErrorKind::Input);
    /// ```
    pub fn kind(&self) -> ErrorKind {
        match self {
            Self::Option { .. }
            | Self::Options(_)
            | Self::Range { .. }
            | Self::Channel {
                error: ChannelError::Unnamed { .. },
                ..
            }
            | Self::Starter(_)
            | Self::Rig(RigError::Setting { .. })
            | Self::Spectral(SpectralError::Overlap { .. }) => ErrorKind::Option,
            Self::Grid(error) if *error != GridError::NoStop => ErrorKind::Option,
            Self::Analysis(error) | Self::Orbit(OrbitError::Harvester(error)) => kind_of(error),
            Self::Study(error) => match error.as_ref() {
                StudyError::Study(error) => kind_of(error),
                _ => ErrorKind::Input,
            },
            Self::Design(error) => match error.as_ref() {
                DesignError::Analysis(error) => kind_of(error),
                DesignError::NothingEvaluated { .. } => ErrorKind::NotConverged,
                _ => ErrorKind::Input,
            },
            Self::Orbit(OrbitError::Integration(_) | OrbitError::Multipliers { .. }) => {
                ErrorKind::NotConverged
            }
            Self::Fit(FitError::NotConverged { .. }) => ErrorKind::NotConverged,
            Self::Rig(RigError::Run(error)) => kind_of_run(error),
            Self::Solution(error) => match error.as_ref() {
                SolutionError::Run(error) => kind_of_run(error),
                SolutionError::Study(error) => kind_of(error),
                SolutionError::Lost { .. } => ErrorKind::NotConverged,
                _ => ErrorKind::Input,
            },
            Self::Stopped
            | Self::Fit(FitError::Stopped { .. })
            | Self::Segmentation(SegmentationError::Stopped)
            | Self::Spectral(SpectralError::Stopped) => ErrorKind::Stopped,
            Self::Continuation(_) => ErrorKind::NotConverged,
            _ => ErrorKind::Input,
        }
    }
}

fn kind_of(error: &AnalysisError) -> ErrorKind {
    match error {
        AnalysisError::Run(error) => kind_of_run(error),
        AnalysisError::OfRuns { .. } => ErrorKind::Option,
        _ => ErrorKind::Input,
    }
}

fn kind_of_run(error: &RunError) -> ErrorKind {
    match error {
        RunError::Integration(IntegrationError::Stopped { .. }) => ErrorKind::Stopped,
        RunError::Integration(_) => ErrorKind::NotConverged,
        _ => ErrorKind::Input,
    }
}
