//! Failures of commands and their exit codes.

use crate::option_names::on_command_line;
use crate::output::{self, line};
use jounce::parts::{DesignError, Fault, StudyError};
use jounce::{Error, ErrorKind};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Exit code of a command that the user stopped, as in shells.
const INTERRUPTED: u8 = 130;

/// Exit code of a result that is not the stored one.
const DIFFERENT: u8 = 1;

/// Exit code of a computation that did not converge.
const NOT_CONVERGED: u8 = 3;

/// Exit code of an invalid input.
const INVALID: u8 = 4;

/// Reason why a command did not succeed.
#[derive(Debug)]
pub enum Failure {
    /// A result that is not the stored one, already printed: exit code 1.
    Different(String),
    /// Wrong usage: exit code 2.
    Usage(String),
    /// Faults in a spec: exit code 4.
    Faults(PathBuf, Vec<Fault>),
    /// Faults in a spec, one a line, printed as they are: exit code 4.
    InvalidSpec(String),
    /// Invalid input of another kind, or an output that cannot be written: exit code 4.
    Input(String),
    /// A computation that did not converge: exit code 3.
    NotConverged(String),
    /// A result without any complete part, already printed: exit code 3.
    Incomplete(String),
    /// Stopped by the user; finished work is stored: exit code 130.
    Interrupted(String),
    /// Stopped by the user, the finished part of the result already printed: exit code 130.
    Partial(String),
}

impl Failure {
    /// Returns a failure by wrong usage.
    pub fn usage(message: String) -> Self {
        Failure::Usage(message)
    }

    /// Returns a failure by faults of a spec file.
    pub fn faults(path: &Path, faults: Vec<Fault>) -> Self {
        Failure::Faults(path.to_path_buf(), faults)
    }

    /// Prints the failure and returns the exit code.
    pub fn report(self, json: bool) -> ExitCode {
        let (code, text, faults) = match self {
            Failure::Partial(text) => {
                output::note(text);
                return ExitCode::from(INTERRUPTED);
            }
            Failure::Incomplete(text) => {
                output::note(text);
                return ExitCode::from(NOT_CONVERGED);
            }
            Failure::Different(text) => {
                output::note(text);
                return ExitCode::from(DIFFERENT);
            }
            Failure::InvalidSpec(text) => {
                output::note(text);
                return ExitCode::from(INVALID);
            }
            Failure::Usage(text) => (2, text, Vec::new()),
            Failure::NotConverged(text) => (NOT_CONVERGED, text, Vec::new()),
            Failure::Input(text) => (INVALID, text, Vec::new()),
            Failure::Interrupted(text) => (INTERRUPTED, text, Vec::new()),
            Failure::Faults(path, faults) => (INVALID, fault_lines(&path, &faults), faults),
        };
        output::note(&text);
        if json {
            line(serde_json::json!({ "error": text, "exit_code": code, "faults": faults }));
        }
        ExitCode::from(code)
    }
}

/// Formats the faults of a file, one a line.
pub fn fault_lines(path: &Path, faults: &[Fault]) -> String {
    let lines: Vec<String> = faults.iter().map(|fault| fault_line(path, fault)).collect();
    lines.join("\n")
}

/// Formats a fault with the name of its file.
fn fault_line(path: &Path, fault: &Fault) -> String {
    match fault.set {
        Some(_) => fault.to_string(),
        None if fault.line == 0 => format!("{}: {fault}", path.display()),
        None => format!("{}:{fault}", path.display()),
    }
}

/// Returns the failure of a file of a study or a design; faults in it get its name.
pub fn of_file(path: &Path, error: Error) -> Failure {
    match error {
        Error::Design(error) => match *error {
            DesignError::Faults(faults) => Failure::faults(path, faults),
            error => Error::from(error).into(),
        },
        Error::Study(error) => match *error {
            StudyError::Faults(faults) => Failure::faults(path, faults),
            error => Error::from(error).into(),
        },
        error => error.into(),
    }
}

/// Returns the message of an error, with options as arguments.
fn text_of(error: &Error) -> String {
    match error {
        Error::Option { option, .. } | Error::Range { option, .. } => {
            let text = error.to_string();
            let rest = text.strip_prefix(option).unwrap_or(&text);
            on_command_line(&format!("`{option}`{rest}"))
        }
        Error::Options(errors) => {
            let lines: Vec<String> = errors.iter().map(text_of).collect();
            lines.join("\n")
        }
        Error::Channel { .. } => on_command_line(&error.to_string()),
        Error::Grid(_) => format!("--{error}"),
        _ => error.to_string(),
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        let text = text_of(&error);
        match error.kind() {
            ErrorKind::Option => Failure::Usage(text),
            ErrorKind::NotConverged => Failure::NotConverged(text),
            ErrorKind::Stopped => Failure::Interrupted(text),
            ErrorKind::Input => Failure::Input(text),
        }
    }
}
