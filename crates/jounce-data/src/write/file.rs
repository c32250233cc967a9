//! Writes a recording in the format of the file extension.

use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};

use jounce_io::store::{self, StoreError};
use jounce_io::table::{Manifest, Record, Table, TableError};

use super::{columns, uff58};
use crate::read::RecordingSummary;
use crate::recording::Recording;

/// Error of writing a recording.
#[derive(Debug, thiserror::Error)]
pub enum WriteError {
    /// The extension is unknown.
    #[error("\"{}\": the extension must be .uff (UFF 58 in ASCII), .parquet or .csv", path.display())]
    Format {
        /// The file.
        path: PathBuf,
    },
    /// The recording contains samples that the format does not support.
    #[error(
        "sample {sample} of {channel} is {value}; UFF supports only finite numbers: interpolate \
        it first, or write Parquet or CSV"
    )]
    NotFinite {
        /// The channel.
        channel: String,
        /// Index of the sample, from 0.
        sample: usize,
        /// Value.
        value: f64,
    },
    /// A text is too long for the columns of the format.
    #[error(
        "the {what} of {channel}, {text:?}, has {length} characters; the limit of UFF is {most}: \
        give a shorter one, in the notes of the recording or as the point of the spec, or write \
        Parquet or CSV"
    )]
    Long {
        /// Channel or recording.
        channel: String,
        /// Kind of the text.
        what: &'static str,
        /// The text.
        text: String,
        /// Number of its characters.
        length: usize,
        /// Maximum number of characters.
        most: usize,
    },
    /// A text has a letter outside the character set of the format.
    #[error(
        "the {what} of {channel}, {text:?}, contains {letter:?}; UFF supports only ASCII: give \
        another one in the notes of the recording, or write Parquet or CSV"
    )]
    NotAscii {
        /// Channel or recording.
        channel: String,
        /// Kind of the text.
        what: &'static str,
        /// The text.
        text: String,
        /// First such letter.
        letter: char,
    },
    /// The scratch file cannot be read.
    #[error("the scratch file cannot be read: {}", jounce_io::store::reason(.0))]
    Scratch(#[from] std::io::Error),
    /// A table cannot be built or written.
    #[error(transparent)]
    Table(#[from] TableError),
    /// The destination cannot be written.
    #[error(transparent)]
    Store(#[from] StoreError),
}

/// Writes a recording atomically, in the format of the extension of `path`: `.uff` (or `.unv`),
/// `.parquet`, `.csv` (with its notes). Values are in SI units.
///
/// # Errors
/// Another extension, samples or units that the format does not support, a destination that cannot
/// be written.
pub fn write(recording: &Recording, path: &Path) -> Result<(), WriteError> {
    write_summary(&recording.clone().into(), path, None)
}

/// Writes a recording whose numbers need not be in memory, piece by piece, with the record of the
/// command, for which UFF has no place.
///
/// # Errors
/// Those of [`write()`], and a scratch file that cannot be read.
pub fn write_summary(
    recording: &RecordingSummary,
    path: &Path,
    record: Option<Record>,
) -> Result<(), WriteError> {
    match path.extension().and_then(|extension| extension.to_str()) {
        Some("uff" | "unv") => uff(recording, path),
        Some(extension @ ("parquet" | "csv")) => Table::write_joined(
            path,
            &Manifest {
                record,
                ..columns::manifest(recording)
            },
            columns::tables(recording, extension == "csv"),
        ),
        _ => Err(WriteError::Format {
            path: path.to_owned(),
        }),
    }
}

fn uff(recording: &RecordingSummary, path: &Path) -> Result<(), WriteError> {
    let mut first_error = None;
    let stored = store::write_from(path, |file| {
        uff58::encode(recording, BufWriter::new(file)).map_err(|error| {
            first_error = Some(error);
            io::Error::other("the recording could not be written")
        })
    });
    first_error.map_or(Ok(()), Err)?;
    Ok(stored?)
}
