//! Errors of a design.

use jounce_analysis::{AnalysisError, JournalError};
use jounce_spec::{Fault, Faults, ReadError};
use std::path::PathBuf;

/// Error of a design.
#[derive(Debug, thiserror::Error)]
pub enum DesignError {
    /// The file cannot be read.
    #[error("{reason}")]
    Unreadable {
        /// Path of the file.
        path: PathBuf,
        /// Cause, with the path.
        reason: String,
    },
    /// All faults in the text of the design.
    #[error("{}", listed("", .0))]
    Faults(Vec<Fault>),
    /// The spec of the design cannot be read.
    #[error(transparent)]
    SpecFile(#[from] ReadError),
    /// The spec of the design has faults.
    #[error("{}", listed(&format!("{file}: "), faults.as_slice()))]
    Spec {
        /// Name of the spec.
        file: String,
        /// Its faults.
        faults: Faults,
    },
    /// The model of the spec cannot be built.
    #[error(transparent)]
    Analysis(#[from] AnalysisError),
    /// The journal of evaluations cannot be used.
    #[error(transparent)]
    Journal(#[from] JournalError),
    /// No design could be evaluated.
    #[error("none of {evaluations} designs could be evaluated; one of the reasons: {reason}")]
    NothingEvaluated {
        /// Number of evaluations.
        evaluations: usize,
        /// One of the reasons.
        reason: String,
    },
    /// The user stopped the search before the first design.
    #[error("the search was stopped before the first design")]
    Stopped,
}

fn listed(file: &str, faults: &[Fault]) -> String {
    let line = |fault: &Fault| format!("{file}{fault}");
    faults.iter().map(line).collect::<Vec<_>>().join("\n")
}
