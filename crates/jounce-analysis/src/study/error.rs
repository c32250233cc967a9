//! Errors of a study.

use crate::AnalysisError;
use jounce_io::store::{StoreError, unwritable_folder};
use jounce_io::table::TableError;
use jounce_spec::{Fault, Faults, ReadError};
use std::path::PathBuf;

/// Error of a study or of one of its calls.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// The study file cannot be read.
    #[error("{reason}")]
    Unreadable {
        /// Path of the file.
        path: PathBuf,
        /// Cause, with the path.
        reason: String,
    },
    /// All faults in the text of the study.
    #[error("{}", listed(.0))]
    Faults(Vec<Fault>),
    /// The spec of the study cannot be read.
    #[error(transparent)]
    SpecFile(#[from] ReadError),
    /// The spec of the study has faults.
    #[error("{}", listed_in(file, faults))]
    Spec {
        /// Name of the spec.
        file: String,
        /// Its faults.
        faults: Faults,
    },
    /// No point of the study can be evaluated.
    #[error(transparent)]
    Study(#[from] AnalysisError),
    /// The folder holds the parts of another study.
    #[error(
        "\"{folder}\" holds another study ({found}, this one is {wanted}); give another folder, or remove that one"
    )]
    OtherStudy {
        /// The folder.
        folder: PathBuf,
        /// Digest of the study in the folder.
        found: String,
        /// Digest of this study.
        wanted: String,
    },
    /// The folder holds no study.
    #[error("\"{folder}\" holds no study; `jounce study run STUDY.toml --out FOLDER` makes one")]
    NoStudy {
        /// The folder.
        folder: PathBuf,
    },
    /// Another process works on the same shard.
    #[error(
        "another process works on shard {shard} of the study in \"{folder}\"; wait for it, or take another shard"
    )]
    Busy {
        /// The folder.
        folder: PathBuf,
        /// The shard.
        shard: String,
    },
    /// Unfinished parts.
    #[error(
        "{missing} of {parts} parts are missing, the first is number {first}; `jounce study run` computes them"
    )]
    Missing {
        /// Number of missing parts.
        missing: usize,
        /// Number of all parts.
        parts: usize,
        /// Number of the first missing part.
        first: usize,
    },
    /// A folder that cannot be created or written.
    #[error("{}", unwritable_folder(folder, reason))]
    Folder {
        /// The folder.
        folder: PathBuf,
        /// Cause.
        reason: String,
    },
    /// A damaged file.
    #[error(
        "\"{path}\" is damaged: {reason}; remove it and run the study again, which computes it anew"
    )]
    Damaged {
        /// The file.
        path: PathBuf,
        /// Fault.
        reason: String,
    },
    /// A table that cannot be created or written.
    #[error(transparent)]
    Table(#[from] TableError),
    /// A file that cannot be written.
    #[error(transparent)]
    Store(#[from] StoreError),
}

fn listed_in(file: &str, faults: &Faults) -> String {
    let line = |fault: &Fault| format!("{file}: {fault}");
    let lines: Vec<String> = faults.as_slice().iter().map(line).collect();
    lines.join("\n")
}

fn listed(faults: &[Fault]) -> String {
    faults
        .iter()
        .map(ToString::to_string)
        .collect::<Vec<_>>()
        .join("\n")
}
