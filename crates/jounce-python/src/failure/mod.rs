//! Errors of the library as exceptions of `jounce.errors`, with their numbers.

mod measured;

use jounce::linear::RandomError;
use jounce::march::VariationError;
use jounce::orbit::OrbitError;
use jounce::plant::PlantError;
use jounce::reproduce::ReproduceError;
use jounce::run::RunError;
use jounce::spec::{Fault, Faults, ReadError};
use jounce::starter::UnknownKind;
use jounce::structure::StructureError;
use jounce::study::StudyError;
use jounce::survey::SurveyError;
use jounce_explorer::ExploreError;
use pyo3::prelude::*;
use serde_json::Value;

/// Why a call did not succeed; free of Python, so that it can be made on any thread.
#[derive(Debug)]
pub struct Failure {
    /// Name of the exception in `jounce.errors`.
    class: &'static str,
    message: String,
    /// Its numbers and names.
    details: Value,
}

impl Failure {
    /// A failure without numbers.
    pub fn new(class: &'static str, message: impl ToString) -> Self {
        Self { class, message: message.to_string(), details: Value::Null }
    }

    /// A failure whose error type names its numbers.
    fn of(class: &'static str, error: &(impl std::fmt::Display + serde::Serialize)) -> Self {
        Self { class, message: error.to_string(), details: serde_json::to_value(error).unwrap_or(Value::Null) }
    }

    /// Faults of a spec.
    pub fn faults(faults: &[Fault]) -> Self {
        let line = |fault: &Fault| match fault.line {
            0 => fault.message.clone(),
            line => format!("line {line}, column {}: {}", fault.column, fault.message),
        };
        let message = faults.iter().map(line).collect::<Vec<_>>().join("\n");
        Self { class: "SpecError", message, details: serde_json::json!({ "faults": faults }) }
    }

    /// The exception.
    pub fn raised(self, py: Python<'_>) -> PyErr {
        let make = || -> PyResult<PyErr> {
            let details = py.import("json")?.call_method1("loads", (self.details.to_string(),))?;
            let class = py.import("jounce.errors")?.getattr(self.class)?;
            Ok(PyErr::from_value(class.call1((&self.message, details))?))
        };
        make().unwrap_or_else(|error| error)
    }
}

impl From<Failure> for PyErr {
    fn from(failure: Failure) -> Self {
        Python::attach(|py| failure.raised(py))
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
            ReadError::NotText { ref fault, .. } => {
                Self { details: serde_json::json!({ "faults": [fault] }), ..Self::new("SpecError", &error) }
            }
            _ => Self::new("FileError", error),
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
            RandomError::Rectified { .. } | RandomError::Unsteady { .. } => Self::of("PlantError", &error),
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
            RunError::March(error) => Self::of("MarchError", &error),
            RunError::Plant(error) => error.into(),
            RunError::StateDoesNotFit { .. } | RunError::StartsInside { .. } => Self::of("StartError", &error),
        }
    }
}

impl From<StudyError> for Failure {
    fn from(error: StudyError) -> Self {
        match error {
            StudyError::Structure(error) => error.into(),
            StudyError::Plant(error) => error.into(),
            StudyError::Run(error) => error.into(),
            StudyError::Value(fault) => fault.into(),
            StudyError::StartFile { .. } => Self::new("StartError", error),
            StudyError::Journal(error) => Self::new("FileError", error),
            StudyError::Aperiodic { .. } => Self::new("OrbitError", error),
            StudyError::NoNoise => Self::new("ArgumentError", error),
        }
    }
}

impl From<SurveyError> for Failure {
    fn from(error: SurveyError) -> Self {
        match error {
            SurveyError::Study(error) => error.into(),
            SurveyError::Faults(faults) => Self::faults(&faults),
            SurveyError::Spec(faults) => faults.into(),
            error => Self::new("StudyError", error),
        }
    }
}

impl From<OrbitError<StudyError>> for Failure {
    fn from(error: OrbitError<StudyError>) -> Self {
        match error {
            OrbitError::Harvester(error) => error.into(),
            OrbitError::March(VariationError::March(error)) => Self::of("MarchError", &error),
            OrbitError::March(error) => Self::new("MarchError", error),
            OrbitError::Frequencies { .. } | OrbitError::Impulsive { .. } | OrbitError::Rectified { .. } | OrbitError::Free => {
                Self::new("OrbitError", error)
            }
            OrbitError::Multipliers { .. } => Self::new("ConvergenceError", error),
        }
    }
}

impl From<ReproduceError> for Failure {
    fn from(error: ReproduceError) -> Self {
        match error {
            ReproduceError::Folder { .. } | ReproduceError::Store(_) | ReproduceError::Table(_) | ReproduceError::Picture(_) => {
                Self::new("FileError", error)
            }
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
