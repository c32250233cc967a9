//! Errors of reading a file.

use std::path::PathBuf;

use jounce_io::store;

use crate::recording::{GridError, Issue, IssuePlace};

/// A file that cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The file cannot be opened.
    #[error("{}", store::unreadable(path, reason))]
    Open {
        /// The file.
        path: PathBuf,
        /// Error of the operating system.
        reason: std::io::Error,
    },
    /// The format is unknown.
    #[error("{}: {why}; supported formats: CSV and text, Parquet, NPY, NPZ, MAT, HDF5, TDMS, WAV, \
        UFF and LVM", path.display())]
    Format {
        /// The file.
        path: PathBuf,
        /// Description of the file.
        why: String,
    },
    /// The file is damaged, truncated, or of a variant that jounce does not read.
    #[error("{}: as {format}, {}{why}", path.display(), at(*place))]
    Damaged {
        /// The file.
        path: PathBuf,
        /// The format.
        format: &'static str,
        /// Position in the file.
        place: Option<IssuePlace>,
        /// Fault and remedy.
        why: String,
    },
    /// The file contains no sampling times.
    #[error(
        "{}: no sampling times found: no column has a unit of time or the name of one, and no \
        rate is given (columns: {}{}); write `rate = \"... Hz\"`, or `time = \"COLUMN\"` and \
        under `[channel.\"COLUMN\"]` its `unit = \"s\"`, in {}",
        path.display(), columns.join(", "), note_text(about), notes.display()
    )]
    NoTime {
        /// The file.
        path: PathBuf,
        /// Columns of the file.
        columns: Vec<String>,
        /// Properties found of columns that are not times.
        about: Vec<String>,
        /// Path of the notes.
        notes: PathBuf,
    },
    /// The stamps are integers of an unknown unit.
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
        /// Typical step.
        step: f64,
        /// Path of the notes.
        notes: PathBuf,
    },
    /// The file contains times and no channel.
    #[error("{}: no channel remains apart from the time{}", path.display(), issue_text(issues))]
    NoChannel {
        /// The file.
        path: PathBuf,
        /// Issues found, including columns that were left out.
        issues: Vec<Issue>,
    },
    /// The file contains no time-domain recording, only frequency data or mode shapes.
    #[error("{} contains no recording over time", path.display())]
    NoRecord {
        /// The file.
        path: PathBuf,
    },
    /// The time stamps are invalid.
    #[error("{}: {fault}", path.display())]
    Grid {
        /// The file.
        path: PathBuf,
        /// The fault.
        fault: GridError,
    },
    /// The scratch file cannot be written or read.
    #[error("{}: {}", path.display(), reason_text(reason))]
    Scratch {
        /// The file.
        path: PathBuf,
        /// Error of the operating system.
        reason: std::io::Error,
    },
    /// The notes of the file are wrong; lists all faults.
    #[error("{}: {}", path.display(), faults.join("; "))]
    Notes {
        /// Path of the notes.
        path: PathBuf,
        /// One sentence for each fault.
        faults: Vec<String>,
    },
}

fn note_text(notes: &[String]) -> String {
    if notes.is_empty() {
        String::new()
    } else {
        format!("; {}", notes.join(", "))
    }
}

fn issue_text(issues: &[Issue]) -> String {
    let texts: Vec<String> = issues.iter().map(ToString::to_string).collect();
    if texts.is_empty() {
        String::new()
    } else {
        format!(
            " ({}); save channels and time with equal lengths",
            texts.join("; ")
        )
    }
}

fn at(place: Option<IssuePlace>) -> String {
    place.map(|place| format!("{place}: ")).unwrap_or_default()
}

fn reason_text(reason: &std::io::Error) -> String {
    let folder = crate::read::column::samples::folder();
    format!(
        "its numbers cannot be stored in {}: {}; set TMPDIR to a folder with room for 8 \
        bytes per number",
        folder.display(),
        store::reason(reason)
    )
}

/// Fault inside a file, before its path is known.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::read) struct Damage {
    pub place: Option<IssuePlace>,
    pub why: String,
}

impl From<std::io::Error> for Damage {
    fn from(reason: std::io::Error) -> Self {
        Self::new(reason_text(&reason))
    }
}

impl Damage {
    pub(in crate::read) fn new(why: impl Into<String>) -> Self {
        Self {
            place: None,
            why: why.into(),
        }
    }

    /// Error of a source that cannot be read to its end.
    pub(in crate::read) fn cut(reason: std::io::Error) -> Self {
        let why = if reason.kind() == std::io::ErrorKind::UnexpectedEof {
            "it ends too early".to_owned()
        } else {
            store::reason(&reason)
        };
        Self::new(format!("{why}; is the file truncated?"))
    }

    /// Adds a byte position unless a position is set.
    pub(in crate::read) fn at_byte(self, byte: u64) -> Self {
        let place = self.place.or(Some(IssuePlace::Byte(
            usize::try_from(byte).unwrap_or(usize::MAX),
        )));
        Self { place, ..self }
    }

    pub(in crate::read) fn at(place: IssuePlace, why: impl Into<String>) -> Self {
        Self {
            place: Some(place),
            why: why.into(),
        }
    }
}
