//! Errors of the computations.

use jounce_core::analysis::{AnalysisError, GridError, JournalError};
use jounce_core::continuation::ContinuationError;
use jounce_core::integrate::IntegrationError;
use jounce_core::orbit::OrbitError;
use jounce_core::plant::PlantError;
use jounce_core::run::{RunError, StartFileError};
use jounce_core::signal::SignalError;
use jounce_core::spec::{Fault, Faults, ReadError};
use jounce_core::table::TableError;

/// Reason why a computation has no result. The message names the value, what is allowed, and what
/// to try.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A spec file cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The spec has faults: all of them, with their places.
    #[error(transparent)]
    Spec(#[from] Faults),
    /// An option has a value that is not allowed.
    #[error("{option} is {value}; {expected}")]
    Option {
        /// Name of the option.
        option: &'static str,
        /// Its value, as text.
        value: String,
        /// The allowed values and what to try.
        expected: String,
    },
    /// The grid of starts cannot be read.
    #[error("grid: {0}")]
    Grid(#[from] GridError),
    /// The spec has no drive.
    #[error("{what} needs a drive: add [drive.NAME] to the spec")]
    NoDrive {
        /// What needs it.
        what: &'static str,
    },
    /// The amplitude of every drive is 0.
    #[error(
        "drive.amplitude is 0, but {what} needs a drive that moves: give it an amplitude greater than 0"
    )]
    DriveAtRest {
        /// What needs it.
        what: &'static str,
    },
    /// The model has no solution, or a run failed.
    #[error(transparent)]
    Analysis(#[from] AnalysisError),
    /// The search for an orbit failed.
    #[error(transparent)]
    Orbit(#[from] OrbitError<AnalysisError>),
    /// The orbit at a point of a branch cannot be computed again.
    #[error(transparent)]
    Continuation(#[from] ContinuationError<OrbitError<AnalysisError>>),
    /// A recording of the page cannot be read or has no such channel.
    #[error("{0}")]
    Recording(String),
    /// The journal of finished points cannot be used.
    #[error(transparent)]
    Journal(#[from] JournalError),
    /// A table cannot be created.
    #[error(transparent)]
    Table(#[from] TableError),
    /// A signal is too short or holds a value that is not finite.
    #[error(transparent)]
    Signal(#[from] SignalError),
    /// The threads cannot be started.
    #[error("the threads cannot be started: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
    /// The control stopped the computation before it had a result.
    #[error("stopped before the first result")]
    Stopped,
}

/// Kinds of errors that a user treats differently.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ErrorKind {
    /// The input is invalid; correct it.
    Input,
    /// The computation did not converge; change its settings.
    NotConverged,
    /// The user stopped the computation.
    Stopped,
}

impl Error {
    /// Returns the error of an option.
    pub(crate) fn option(
        option: &'static str,
        value: impl ToString,
        expected: impl Into<String>,
    ) -> Self {
        Self::Option {
            option,
            value: value.to_string(),
            expected: expected.into(),
        }
    }

    /// Returns the kind.
    ///
    /// ```
    /// let error = jounce::Harvester::from_text("", ".").unwrap_err();
    /// assert_eq!(error.kind(), jounce::ErrorKind::Input);
    /// ```
    pub fn kind(&self) -> ErrorKind {
        match self {
            Self::Analysis(error) | Self::Orbit(OrbitError::Harvester(error)) => kind_of(error),
            Self::Orbit(OrbitError::Integration(_) | OrbitError::Multipliers { .. }) => {
                ErrorKind::NotConverged
            }
            Self::Continuation(_) => ErrorKind::NotConverged,
            Self::Stopped => ErrorKind::Stopped,
            _ => ErrorKind::Input,
        }
    }
}

fn kind_of(error: &AnalysisError) -> ErrorKind {
    match error {
        AnalysisError::Run(RunError::Integration(IntegrationError::Stopped { .. })) => {
            ErrorKind::Stopped
        }
        AnalysisError::Run(RunError::Integration(_)) => ErrorKind::NotConverged,
        _ => ErrorKind::Input,
    }
}

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

impl From<PlantError> for Error {
    fn from(error: PlantError) -> Self {
        Self::Analysis(error.into())
    }
}
