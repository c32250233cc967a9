//! Why a file gives no recording.

use std::path::PathBuf;

use crate::recording::{GridError, Issue, IssuePlace};

/// A file that cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// It cannot be opened.
    #[error("{}: {reason}", path.display())]
    Open {
        /// The file.
        path: PathBuf,
        /// What the system says.
        reason: std::io::Error,
    },
    /// It is none of the formats.
    #[error("{}: {why}; CSV and text, Parquet, NPY, NPZ, MAT, HDF5, TDMS, WAV, UFF and LVM can be read", path.display())]
    Format {
        /// The file.
        path: PathBuf,
        /// What it is instead.
        why: String,
    },
    /// It is damaged, cut, or of a kind that its format allows and jounce does not read.
    #[error("{}: as {format}, {}{why}", path.display(), at(*place))]
    Damaged {
        /// The file.
        path: PathBuf,
        /// The format.
        format: &'static str,
        /// Where.
        place: Option<IssuePlace>,
        /// What is wrong, and what to do.
        why: String,
    },
    /// Nothing tells when the samples were taken.
    #[error(
        "{}: nothing tells when the samples were taken: no column has a unit of time or the name of one, and no rate is given (columns: {}{}); write \
         `rate = \"... Hz\"`, or `time = \"COLUMN\"` and under `[channel.\"COLUMN\"]` its `unit = \"s\"`, in {}",
        path.display(), columns.join(", "), noted(about), notes.display()
    )]
    NoTime {
        /// The file.
        path: PathBuf,
        /// Its columns.
        columns: Vec<String>,
        /// What is known of columns that are no time.
        about: Vec<String>,
        /// Where the notes belong.
        notes: PathBuf,
    },
    /// Its stamps are whole numbers of an unknown unit.
    #[error(
        "{}: the stamps of {column:?} are whole numbers without a unit, {step} from one to the next: in s that is {:.6} Hz, in ms {:.6} Hz, in us {:.6} Hz; \
         write under `[channel.\"{column}\"]` its `unit = \"s\"`, `\"ms\"` or `\"us\"` in {}",
        path.display(), 1.0 / step, 1e3 / step, 1e6 / step, notes.display()
    )]
    StampUnit {
        /// The file.
        path: PathBuf,
        /// The column.
        column: String,
        /// Its usual step.
        step: f64,
        /// Where the notes belong.
        notes: PathBuf,
    },
    /// It tells times and nothing else.
    #[error("{}: no channel is left beside the time{}", path.display(), noticed(findings))]
    NoChannel {
        /// The file.
        path: PathBuf,
        /// What was noticed, columns that were left out among it.
        findings: Vec<Issue>,
    },
    /// It holds nothing over time, only over frequency or mode shapes.
    #[error("{} holds no recording over time", path.display())]
    NoRecord {
        /// The file.
        path: PathBuf,
    },
    /// Its time stamps are no times.
    #[error("{}: {fault}", path.display())]
    Grid {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        fault: GridError,
    },
    /// Its numbers cannot be kept or found again in the scratch file.
    #[error("{}: {}", path.display(), kept(reason))]
    Scratch {
        /// The file.
        path: PathBuf,
        /// What the system says.
        reason: std::io::Error,
    },
    /// The notes beside it are wrong; all faults.
    #[error("{}: {}", path.display(), faults.join("; "))]
    Notes {
        /// The notes.
        path: PathBuf,
        /// One sentence each.
        faults: Vec<String>,
    },
}

fn noted(about: &[String]) -> String {
    if about.is_empty() {
        String::new()
    } else {
        format!("; {}", about.join(", "))
    }
}

fn noticed(findings: &[Issue]) -> String {
    let told: Vec<String> = findings.iter().map(ToString::to_string).collect();
    if told.is_empty() {
        String::new()
    } else {
        format!(
            " ({}); save channels and time equally long",
            told.join("; ")
        )
    }
}

fn at(place: Option<IssuePlace>) -> String {
    place.map(|place| format!("{place}: ")).unwrap_or_default()
}

fn kept(reason: &std::io::Error) -> String {
    let folder = super::samples::folder();
    format!(
        "its numbers cannot be kept in {}: {reason}; set TMPDIR to a folder with room for 8 bytes per number",
        folder.display()
    )
}

/// What is wrong inside a file, before its name is known.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Damage {
    pub place: Option<IssuePlace>,
    pub why: String,
}

impl From<std::io::Error> for Damage {
    fn from(reason: std::io::Error) -> Self {
        Self::new(kept(&reason))
    }
}

impl Damage {
    pub(super) fn new(why: impl Into<String>) -> Self {
        Self {
            place: None,
            why: why.into(),
        }
    }

    /// A source that cannot be read to its end.
    pub(super) fn cut(reason: std::io::Error) -> Self {
        let why = if reason.kind() == std::io::ErrorKind::UnexpectedEof {
            "it ends too early".to_owned()
        } else {
            reason.to_string()
        };
        Self::new(format!("{why}; was the file cut?"))
    }

    /// The same at a byte, where it has no place yet.
    pub(super) fn at_byte(self, byte: u64) -> Self {
        let place = self.place.or(Some(IssuePlace::Byte(
            usize::try_from(byte).unwrap_or(usize::MAX),
        )));
        Self { place, ..self }
    }

    pub(super) fn at(place: IssuePlace, why: impl Into<String>) -> Self {
        Self {
            place: Some(place),
            why: why.into(),
        }
    }
}
