//! Details of errors: the exception of Python, and the numbers and names of the message.

mod recordings;

use super::Error;
use impact_harvester_2019::ReproduceError;
use jounce_analysis::AnalysisError;
use jounce_analysis::run::RunError;
use jounce_analysis::study::StudyError;
use jounce_design::DesignError;
use jounce_dynamics::SensitivityError;
use jounce_io::store::StoreError;
use jounce_io::table::TableError;
use jounce_model::linear::RandomError;
use jounce_model::plant::PlantError;
use jounce_model::structure::StructureError;
use jounce_orbits::OrbitError;
use jounce_spec::starter::UnknownKind;
use jounce_spec::{Fault, Faults, ReadError};
use serde::Serialize;
use serde_json::{Value, json};

/// Error number of a missing file on POSIX and Windows, `ENOENT`.
const NO_SUCH_FILE: i32 = 2;

/// Details of an error.
///
/// ```
/// let error = jounce::Harvester::from_text("gap = 1", ".").unwrap_err();
/// assert_eq!(jounce::ErrorDetails::from(&error).class, "SpecError");
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ErrorDetails {
    /// Class of the error, the name of its exception in Python.
    pub class: &'static str,
    /// Numbers and names of the message by key; null without any.
    pub details: Value,
}

impl ErrorDetails {
    /// Returns the details of an error without numbers.
    fn new(class: &'static str) -> Self {
        Self {
            class,
            details: Value::Null,
        }
    }

    /// Adds the numbers and names of the message.
    fn with(self, details: Value) -> Self {
        Self { details, ..self }
    }

    /// Returns the details of a file that cannot be used; `errno` where the system gives one.
    fn of_file(path: &std::path::Path, reason: Option<&std::io::Error>) -> Self {
        let errno = reason.and_then(std::io::Error::raw_os_error);
        Self::new("FileError").with(json!({ "path": path, "errno": errno }))
    }

    /// Returns the details of an error whose type names its numbers.
    fn of(class: &'static str, error: &impl Serialize) -> Self {
        Self::new(class).with(serde_json::to_value(error).unwrap_or(Value::Null))
    }

    fn of_faults(faults: &[Fault]) -> Self {
        Self::new("SpecError").with(json!({ "faults": faults }))
    }
}

impl From<&Error> for ErrorDetails {
    fn from(error: &Error) -> Self {
        match error {
            Error::Read(error) => error.into(),
            Error::Spec(faults) | Error::Range { faults, .. } => faults.into(),
            Error::Analysis(error) => error.into(),
            Error::Orbit(error) => error.into(),
            Error::Noise(error) => error.into(),
            Error::Starter(error) => error.into(),
            Error::Fit(error) => error.into(),
            Error::Reproduce(error) => error.as_ref().into(),
            Error::File(error) => error.into(),
            Error::Journal(error) => Self::of("FileError", error),
            Error::Table(error) => error.into(),
            Error::Picture(error) => Self::of("FileError", error),
            Error::Design(error) => error.as_ref().into(),
            Error::Study(error) => error.as_ref().into(),
            Error::Option { option, value, .. } => {
                Self::new("ArgumentError").with(json!({ "option": option, "value": value }))
            }
            Error::Options(errors) => {
                let faults = errors.iter().map(ToString::to_string);
                Self::new("ArgumentError").with(json!({ "faults": faults.collect::<Vec<_>>() }))
            }
            Error::Exchange(error) => Self::new("ArgumentError").with(json!({ "faults": error.0 })),
            Error::Grid(_) => Self::new("ArgumentError").with(json!({ "option": "grid" })),
            Error::NoDrive { .. } | Error::DriveAtRest { .. } | Error::Linear => {
                Self::new("ArgumentError")
            }
            Error::Rig(error) => error.into(),
            Error::Segmentation(error) => error.into(),
            Error::Solution(error) => error.as_ref().into(),
            Error::Signal(_)
            | Error::Threads(_)
            | Error::Stopped
            | Error::Continuation(_)
            | Error::Recording(_) => Self::new("JounceError"),
            Error::ReadRecording(error) => error.into(),
            Error::Arrays(error) => error.into(),
            Error::RecordingGrid(error) => error.into(),
            Error::NoChannel(error) => error.into(),
            Error::Channel { .. } => Self::new("ArgumentError"),
            Error::NoRecording { path, .. } => Self::of_file(path, None),
            Error::WithoutChannel { .. } | Error::NotLoaded { .. } | Error::NotOverTime { .. } => {
                Self::new("RecordingError")
            }
            Error::Scratch(_) => Self::new("FileError"),
            Error::Write(error) => error.into(),
            Error::Spectral(error) => error.into(),
            Error::Response(error) => error.into(),
            Error::Modal(error) => error.into(),
        }
    }
}

impl From<&Faults> for ErrorDetails {
    fn from(faults: &Faults) -> Self {
        Self::of_faults(faults.as_slice())
    }
}

impl From<&Fault> for ErrorDetails {
    fn from(error: &Fault) -> Self {
        Self::of_faults(std::slice::from_ref(error))
    }
}

impl From<&ReadError> for ErrorDetails {
    fn from(error: &ReadError) -> Self {
        match error {
            ReadError::NotText { fault, .. } => Self {
                details: json!({ "faults": [fault] }),
                ..Self::new("SpecError")
            },
            ReadError::Unreadable { path, source } => Self::of_file(path, Some(source)),
            ReadError::Missing { path } => {
                let details = json!({ "path": path, "errno": NO_SUCH_FILE });
                Self::new("FileError").with(details)
            }
            ReadError::Folder { path } | ReadError::TooLarge { path } => Self::of_file(path, None),
        }
    }
}

impl From<&StructureError> for ErrorDetails {
    fn from(error: &StructureError) -> Self {
        Self::of("StructureError", error)
    }
}

impl From<&PlantError> for ErrorDetails {
    fn from(error: &PlantError) -> Self {
        Self::of("PlantError", error)
    }
}

impl From<&RandomError> for ErrorDetails {
    fn from(error: &RandomError) -> Self {
        match error {
            RandomError::Structure(error) => error.into(),
            RandomError::Plant(error) => error.into(),
            RandomError::NoNoise => Self::new("ArgumentError"),
            RandomError::Rectified { .. } | RandomError::Unsteady { .. } => {
                Self::of("PlantError", error)
            }
        }
    }
}

impl From<&UnknownKind> for ErrorDetails {
    fn from(error: &UnknownKind) -> Self {
        Self::of("ArgumentError", error)
    }
}

impl From<&RunError> for ErrorDetails {
    fn from(error: &RunError) -> Self {
        match error {
            RunError::Integration(error) => Self::of("IntegrationError", error),
            RunError::Plant(error) => error.into(),
            RunError::StateDoesNotFit { .. } | RunError::StartsInside { .. } => {
                Self::of("StartError", error)
            }
        }
    }
}

impl From<&AnalysisError> for ErrorDetails {
    fn from(error: &AnalysisError) -> Self {
        match error {
            AnalysisError::Structure(error) => error.into(),
            AnalysisError::Plant(error) => error.into(),
            AnalysisError::Run(error) => error.into(),
            AnalysisError::Value(fault) => fault.into(),
            AnalysisError::StartFile(file) => {
                Self::new("StartError").with(json!({ "path": file.path }))
            }
            AnalysisError::Journal(error) => Self::of("FileError", error),
            AnalysisError::Aperiodic { part } => {
                Self::new("OrbitError").with(json!({ "part": part }))
            }
            AnalysisError::SweptNoise { drive } => {
                Self::new("ArgumentError").with(json!({ "part": format!("drive `{drive}`") }))
            }
            AnalysisError::OfRuns { key } => Self::new("ArgumentError").with(json!({ "key": key })),
            AnalysisError::NoFoldDerivative { key } => {
                Self::new("OrbitError").with(json!({ "key": key }))
            }
            AnalysisError::NoNoise => Self::new("ArgumentError"),
        }
    }
}

impl From<&DesignError> for ErrorDetails {
    fn from(error: &DesignError) -> Self {
        match error {
            DesignError::Unreadable { path, .. } => {
                Self::new("DesignError").with(json!({ "path": path }))
            }
            DesignError::Faults(faults) => Self::of_faults(faults),
            DesignError::SpecFile(error) => error.into(),
            DesignError::Spec { faults, .. } => faults.into(),
            DesignError::Analysis(error) => error.into(),
            DesignError::Journal(error) => Self::of("FileError", error),
            DesignError::Stopped => Self::new("JounceError"),
            DesignError::NothingEvaluated { evaluations, .. } => {
                Self::new("DesignError").with(json!({ "evaluations": evaluations }))
            }
        }
    }
}

impl From<&StudyError> for ErrorDetails {
    fn from(error: &StudyError) -> Self {
        match error {
            StudyError::Study(error) => error.into(),
            StudyError::Faults(faults) => Self::of_faults(faults),
            StudyError::Spec { faults, .. } => faults.into(),
            error => Self::new("StudyError").with(study_details(error)),
        }
    }
}

fn study_details(error: &StudyError) -> Value {
    match error {
        StudyError::Unreadable { path, .. } | StudyError::Damaged { path, .. } => {
            json!({ "path": path })
        }
        StudyError::OtherStudy {
            folder,
            found,
            wanted,
        } => json!({ "folder": folder, "found": found, "wanted": wanted }),
        StudyError::NoStudy { folder } | StudyError::Folder { folder, .. } => {
            json!({ "folder": folder })
        }
        StudyError::Busy { folder, shard } => json!({ "folder": folder, "shard": shard }),
        StudyError::Missing {
            missing,
            parts,
            first,
        } => json!({ "missing": missing, "parts": parts, "first": first }),
        _ => Value::Null,
    }
}

impl From<&OrbitError<AnalysisError>> for ErrorDetails {
    fn from(error: &OrbitError<AnalysisError>) -> Self {
        match error {
            OrbitError::Harvester(error) => error.into(),
            OrbitError::Integration(SensitivityError::Integration(error)) => {
                Self::of("IntegrationError", error)
            }
            OrbitError::Integration(_) => Self::new("IntegrationError"),
            OrbitError::Frequencies { frequencies } | OrbitError::Summed { frequencies } => {
                Self::new("OrbitError").with(json!({ "frequencies": frequencies }))
            }
            OrbitError::Impulsive { stop } => Self::new("OrbitError").with(json!({ "stop": stop })),
            OrbitError::Rectified { circuit } => {
                Self::new("OrbitError").with(json!({ "circuit": circuit }))
            }
            OrbitError::Free => Self::new("OrbitError"),
            OrbitError::Multipliers { frequency_hz } => {
                Self::new("ConvergenceError").with(json!({ "frequency_hz": frequency_hz }))
            }
        }
    }
}

impl From<&TableError> for ErrorDetails {
    fn from(error: &TableError) -> Self {
        Self::of("FileError", error)
    }
}

impl From<&StoreError> for ErrorDetails {
    fn from(error: &StoreError) -> Self {
        Self::of("FileError", error)
    }
}

impl From<&ReproduceError> for ErrorDetails {
    fn from(error: &ReproduceError) -> Self {
        match error {
            ReproduceError::Folder { path, .. } => Self::of_file(path.as_ref(), None),
            ReproduceError::Store(error) => Self::of("FileError", error),
            ReproduceError::Table(error) => Self::of("FileError", error),
            ReproduceError::Picture(error) => Self::of("FileError", error),
            _ => Self::new("JounceError"),
        }
    }
}
