//! Conversion of errors of the library to exceptions of `jounce.errors`, with their numbers.

use jounce::parts::{Fault, Faults};
use jounce::{Control, Error, ErrorDetails};
use jounce_explorer::ExploreError;
use pyo3::prelude::*;
use serde_json::Value;

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

    /// Returns the exception.
    pub fn into_exception(self, py: Python<'_>) -> PyErr {
        let make = || -> PyResult<PyErr> {
            let details = py
                .import("json")?
                .call_method1("loads", (self.details.to_string(),))?;
            let class = py.import("jounce._errors")?.getattr(self.class)?;
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

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        let ErrorDetails { class, details } = ErrorDetails::from(&error);
        let message = match (class, details["faults"].as_array()) {
            ("SpecError", Some(faults)) => lines(faults),
            _ => error.to_string(),
        };
        Self::new(class, in_python(&message)).with(details)
    }
}

/// Writes commands and overrides of the command line in a text of the library as in Python:
/// "`jounce frf`" as "`frf`", and "--set stop.tip.gap=1 mm" as "stop.tip.gap=1 mm".
fn in_python(text: &str) -> String {
    let part = |(index, part): (usize, &str)| {
        let command = part
            .strip_prefix("jounce ")
            .filter(|command| !command.contains(' '));
        match (index % 2, command) {
            (0, _) => part.replace("--set ", ""),
            (_, Some(command)) => command.to_owned(),
            _ => part.to_owned(),
        }
    };
    let parts: Vec<String> = text.split('`').enumerate().map(part).collect();
    parts.join("`")
}

/// Returns a line for each fault; one of an override has no place in a file.
fn lines(faults: &[Value]) -> String {
    let line = |fault: &Value| {
        let message = fault["message"].as_str().unwrap_or_default();
        match fault["line"].as_u64() {
            Some(0) | None => message.to_owned(),
            Some(line) => format!("line {line}, column {}: {message}", fault["column"]),
        }
    };
    faults.iter().map(line).collect::<Vec<_>>().join("\n")
}

/// Errors that the library returns alone.
macro_rules! of_library {
    ($($error:ty),+) => {
        $(impl From<$error> for Failure {
            fn from(error: $error) -> Self {
                Error::from(error).into()
            }
        })+
    };
}

of_library!(Fault, Faults);

impl From<ExploreError> for Failure {
    fn from(error: ExploreError) -> Self {
        match error {
            ExploreError::Spec(error) => error.into(),
            error => Self::new("ExploreError", error),
        }
    }
}
