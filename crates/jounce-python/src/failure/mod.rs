//! Conversion of errors of the library to exceptions of `jounce.errors`, with their numbers.

mod measured;

use jounce_core::analysis::AnalysisError;
use jounce_core::integrate::{Control, SensitivityError};
use jounce_core::linear::RandomError;
use jounce_core::orbit::OrbitError;
use jounce_core::plant::PlantError;
use jounce_core::reproduce::ReproduceError;
use jounce_core::run::RunError;
use jounce_core::spec::{Fault, Faults, ReadError};
use jounce_core::starter::UnknownKind;
use jounce_core::store::StoreError;
use jounce_core::structure::StructureError;
use jounce_core::study::StudyError;
use jounce_core::table::TableError;
use jounce_explorer::ExploreError;
use pyo3::prelude::*;
use serde_json::{Value, json};

/// Error number of a missing file on POSIX and Windows, `ENOENT`.
const NO_SUCH_FILE: i32 = 2;

/// Reason why a call did not succeed; independent of Python, so that any thread can create it.
#[derive(Debug)]
pub struct Failure {
    /// Name of the exception in `jounce.errors`.
    class: &'static str,
    message: String,
    /// Numbers and names of the message.
    details: Value,
}

impl Failure {
    /// Returns a failure without numbers.
    pub fn new(class: &'static str, message: impl ToString) -> Self {
        Self {
            class,
            message: message.to_string(),
            details: Value::Null,
        }
    }

    /// Adds the numbers and names of the message.
    #[must_use]
    pub fn with(self, details: Value) -> Self {
        Self { details, ..self }
    }

    /// Returns the failure of a file that cannot be used; `errno` where the system gives one.
    fn of_file(
        error: impl ToString,
        path: &std::path::Path,
        reason: Option<&std::io::Error>,
    ) -> Self {
        let errno = reason.and_then(std::io::Error::raw_os_error);
        Self::new("FileError", error).with(json!({ "path": path, "errno": errno }))
    }

    /// Returns a failure whose error type names its numbers.
    pub fn of(class: &'static str, error: &(impl std::fmt::Display + serde::Serialize)) -> Self {
        Self {
            class,
            message: error.to_string(),
            details: serde_json::to_value(error).unwrap_or(Value::Null),
        }
    }

    /// Returns a result if it is complete.
    pub fn unless_stopped<T>(control: &Control, result: T) -> Result<T, Self> {
        if control.is_stopped() {
            Err(Self::stopped())
        } else {
            Ok(result)
        }
    }

    /// Returns the failure of a stopped call without a result.
    pub fn stopped() -> Self {
        Self::new("JounceError", "stopped")
    }

    /// Returns a failure by faults of a spec.
    pub fn faults(faults: &[Fault]) -> Self {
        let line = |fault: &Fault| match fault.line {
            0 => fault.message.clone(),
            line => format!("line {line}, column {}: {}", fault.column, fault.message),
        };
        let message = faults.iter().map(line).collect::<Vec<_>>().join("\n");
        Self {
            class: "SpecError",
            message,
            details: json!({ "faults": faults }),
        }
    }

    /// Returns the exception.
    pub fn into_exception(self, py: Python<'_>) -> PyErr {
        let make = || -> PyResult<PyErr> {
            let details = py
                .import("json")?
                .call_method1("loads", (self.details.to_string(),))?;
            let class = py.import("jounce.errors")?.getattr(self.class)?;
            Ok(PyErr::from_value(class.call1((&self.message, details))?))
        };
        make().unwrap_or_else(|error| error)
    }
}

impl From<Failure> for PyErr {
    fn from(failure: Failure) -> Self {
        Python::attach(|py| failure.into_exception(py))
    }
}

impl From<jounce::Error> for Failure {
    fn from(error: jounce::Error) -> Self {
        use jounce::Error;
        match error {
            Error::Read(error) => error.into(),
            Error::Spec(faults) => faults.into(),
            Error::Analysis(error) => error.into(),
            Error::Orbit(error) => error.into(),
            Error::Noise(error) => error.into(),
            Error::Starter(error) => error.into(),
            Error::Fit(error) => error.into(),
            Error::Reproduce(error) => (*error).into(),
            Error::File(error) => error.into(),
            Error::Journal(error) => Self::of("FileError", &error),
            Error::Table(error) => error.into(),
            Error::Option {
                option, ref value, ..
            } => {
                Self::new("ArgumentError", &error).with(json!({ "option": option, "value": value }))
            }
            Error::Grid(_) => Self::new("ArgumentError", &error).with(json!({ "option": "grid" })),
            Error::NoDrive { .. } | Error::DriveAtRest { .. } => Self::new("ArgumentError", &error),
            Error::Rig(error) => error.into(),
            Error::Segmentation(error) => error.into(),
            Error::Solution(error) => error.into(),
            Error::Signal(_) | Error::Threads(_) | Error::Stopped => {
                Self::new("JounceError", &error)
            }
            Error::ReadRecording(error) => error.into(),
            Error::Arrays(error) => error.into(),
            Error::RecordingGrid(error) => error.into(),
            Error::NoChannel(error) => error.into(),
            Error::Channel { .. } => Self::new("ArgumentError", &error),
            Error::NoRecording { ref path, .. } => Self::of_file(&error, path, None),
            Error::WithoutChannel { .. } | Error::NotLoaded { .. } | Error::NotOverTime { .. } => {
                Self::new("RecordingError", &error)
            }
            Error::Scratch(_) => Self::new("FileError", &error),
            Error::Write(error) => error.into(),
            Error::Spectral(error) => error.into(),
            Error::Response(error) => error.into(),
            Error::Modal(error) => error.into(),
        }
    }
}

impl From<Faults> for Failure {
    fn from(faults: Faults) -> Self {
        Self::faults(faults.as_slice())
    }
}

impl From<Fault> for Failure {
    fn from(fault: Fault) -> Self {
        Self::faults(&[fault])
    }
}

impl From<ReadError> for Failure {
    fn from(error: ReadError) -> Self {
        match error {
            ReadError::NotText { ref fault, .. } => Self {
                details: json!({ "faults": [fault] }),
                ..Self::new("SpecError", &error)
            },
            ReadError::Unreadable {
                ref path,
                ref source,
            } => Self::of_file(&error, path, Some(source)),
            ReadError::Missing { ref path } => {
                let details = json!({ "path": path, "errno": NO_SUCH_FILE });
                Self::new("FileError", &error).with(details)
            }
            ReadError::Directory { ref path } | ReadError::TooLarge { ref path } => {
                Self::of_file(&error, path, None)
            }
        }
    }
}

impl From<StructureError> for Failure {
    fn from(error: StructureError) -> Self {
        Self::of("StructureError", &error)
    }
}

impl From<PlantError> for Failure {
    fn from(error: PlantError) -> Self {
        Self::of("PlantError", &error)
    }
}

impl From<RandomError> for Failure {
    fn from(error: RandomError) -> Self {
        match error {
            RandomError::Structure(error) => error.into(),
            RandomError::Plant(error) => error.into(),
            RandomError::NoNoise => Self::new("ArgumentError", error),
            RandomError::Rectified { .. } | RandomError::Unsteady { .. } => {
                Self::of("PlantError", &error)
            }
        }
    }
}

impl From<UnknownKind> for Failure {
    fn from(error: UnknownKind) -> Self {
        Self::of("ArgumentError", &error)
    }
}

impl From<RunError> for Failure {
    fn from(error: RunError) -> Self {
        match error {
            RunError::Integration(error) => Self::of("IntegrationError", &error),
            RunError::Plant(error) => error.into(),
            RunError::StateDoesNotFit { .. } | RunError::StartsInside { .. } => {
                Self::of("StartError", &error)
            }
        }
    }
}

impl From<AnalysisError> for Failure {
    fn from(error: AnalysisError) -> Self {
        match error {
            AnalysisError::Structure(error) => error.into(),
            AnalysisError::Plant(error) => error.into(),
            AnalysisError::Run(error) => error.into(),
            AnalysisError::Value(fault) => fault.into(),
            AnalysisError::StartFile(ref file) => {
                Self::new("StartError", &error).with(json!({ "path": file.path }))
            }
            AnalysisError::Journal(error) => Self::of("FileError", &error),
            AnalysisError::Aperiodic { ref drive } => {
                Self::new("OrbitError", &error).with(json!({ "drive": drive }))
            }
            AnalysisError::OfRuns { ref key } => {
                Self::new("ArgumentError", &error).with(json!({ "key": key }))
            }
            AnalysisError::NoNoise => {
                let reason = "an ensemble needs noise: give a drive `signal = \"noise\"`; for other drives use Spec.run";
                Self::new("ArgumentError", reason)
            }
        }
    }
}

impl From<StudyError> for Failure {
    fn from(error: StudyError) -> Self {
        match error {
            StudyError::Study(error) => error.into(),
            StudyError::Faults(faults) => Self::faults(&faults),
            StudyError::Spec(faults) => faults.into(),
            error => Self::new("StudyError", &error).with(survey_details(&error)),
        }
    }
}

fn survey_details(error: &StudyError) -> Value {
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

impl From<OrbitError<AnalysisError>> for Failure {
    fn from(error: OrbitError<AnalysisError>) -> Self {
        match error {
            OrbitError::Harvester(error) => error.into(),
            OrbitError::Integration(SensitivityError::Integration(error)) => {
                Self::of("IntegrationError", &error)
            }
            OrbitError::Integration(error) => Self::new("IntegrationError", error),
            OrbitError::Frequencies { frequencies } | OrbitError::Summed { frequencies } => {
                Self::new("OrbitError", &error).with(json!({ "frequencies": frequencies }))
            }
            OrbitError::Impulsive { ref stop } => {
                Self::new("OrbitError", &error).with(json!({ "stop": stop }))
            }
            OrbitError::Rectified { ref circuit } => {
                Self::new("OrbitError", &error).with(json!({ "circuit": circuit }))
            }
            OrbitError::Free => Self::new("OrbitError", error),
            OrbitError::Multipliers { frequency_hz } => {
                Self::new("ConvergenceError", &error).with(json!({ "frequency_hz": frequency_hz }))
            }
        }
    }
}

impl From<TableError> for Failure {
    fn from(error: TableError) -> Self {
        Self::of("FileError", &error)
    }
}

impl From<StoreError> for Failure {
    fn from(error: StoreError) -> Self {
        Self::of("FileError", &error)
    }
}

impl From<ReproduceError> for Failure {
    fn from(error: ReproduceError) -> Self {
        match error {
            ReproduceError::Folder { ref path, .. } => Self::of_file(&error, path.as_ref(), None),
            ReproduceError::Store(error) => Self::of("FileError", &error),
            ReproduceError::Table(error) => Self::of("FileError", &error),
            ReproduceError::Picture(error) => Self::of("FileError", &error),
            error => Self::new("JounceError", error),
        }
    }
}

impl From<ExploreError> for Failure {
    fn from(error: ExploreError) -> Self {
        match error {
            ExploreError::Spec(error) => error.into(),
            error => Self::new("ExploreError", error),
        }
    }
}
