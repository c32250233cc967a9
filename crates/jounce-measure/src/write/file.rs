//! One function that writes a recording in the format that a name tells.

use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};

use jounce::store::{self, StoreError};
use jounce::table::{Table, TableError};

use super::{columns, uff58};
use jounce_data::read::RecordingSummary;
use jounce_data::recording::Recording;

/// A recording that cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum WriteError {
    /// Another ending.
    #[error("\"{}\": the ending tells the format: .uff (UFF 58 in ASCII), .parquet or .csv", path.display())]
    Format {
        /// The file.
        path: PathBuf,
    },
    /// A recording with samples that the format cannot hold.
    #[error(
        "sample {sample} of {channel} is {value}; UFF holds finite numbers only: bridge it first, or write Parquet or CSV"
    )]
    NotFinite {
        /// The channel.
        channel: String,
        /// The sample, from 0.
        sample: usize,
        /// Its value.
        value: f64,
    },
    /// A text that the columns of the format would cut to another one.
    #[error(
        "the {what} of {channel}, {text:?}, has {length} characters; UFF holds {most}: give a shorter one, in the notes beside the recording or as the \
         point of the spec, or write Parquet or CSV"
    )]
    Long {
        /// The channel, or the recording.
        channel: String,
        /// What is too long.
        what: &'static str,
        /// The text.
        text: String,
        /// Its characters.
        length: usize,
        /// Characters that the format holds.
        most: usize,
    },
    /// A text with a letter that the format has not.
    #[error(
        "the {what} of {channel}, {text:?}, holds {letter:?}; UFF holds ASCII only: give another one in the notes beside the recording, or write \
         Parquet or CSV"
    )]
    NotAscii {
        /// The channel, or the recording.
        channel: String,
        /// What holds it.
        what: &'static str,
        /// The text.
        text: String,
        /// The first such letter.
        letter: char,
    },
    /// Numbers that cannot be found again in the scratch file.
    #[error("the scratch file cannot be read: {0}")]
    Scratch(#[from] std::io::Error),
    /// A table that cannot be made or written.
    #[error(transparent)]
    Table(#[from] TableError),
    /// A place that cannot be written.
    #[error(transparent)]
    Store(#[from] StoreError),
}

/// Writes a recording whole or not at all, in the format that the ending of `path` names: `.uff` (or `.unv`), `.parquet`, `.csv` (with
/// its notes). What is written is in SI.
///
/// # Errors
/// Another ending, samples or units that the format cannot hold, a place that cannot be written.
pub fn write(recording: &Recording, path: &Path) -> Result<(), WriteError> {
    write_surveyed(&recording.clone().into(), path)
}

/// The same for a recording whose numbers need not lie in memory: it is written piece by piece.
///
/// # Errors
/// As [`write()`], and a scratch file that cannot be read.
pub fn write_surveyed(recording: &RecordingSummary, path: &Path) -> Result<(), WriteError> {
    match path.extension().and_then(|ending| ending.to_str()) {
        Some("uff" | "unv") => uff(recording, path),
        Some(ending @ ("parquet" | "csv")) => Table::write_joined(
            path,
            &columns::manifest(recording),
            columns::tables(recording, ending == "csv"),
        ),
        _ => Err(WriteError::Format {
            path: path.to_owned(),
        }),
    }
}

fn uff(recording: &RecordingSummary, path: &Path) -> Result<(), WriteError> {
    let mut failure = None;
    let stored = store::write_from(path, |file| {
        uff58::encode(recording, BufWriter::new(file)).map_err(|error| {
            failure = Some(error);
            io::Error::other("the recording could not be written")
        })
    });
    failure.map_or(Ok(()), Err)?;
    Ok(stored?)
}
