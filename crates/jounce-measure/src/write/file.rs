//! One function that writes a recording in the format that a name tells.

use std::path::{Path, PathBuf};

use jounce::store::{self, StoreError};
use jounce::table::TableError;

use super::{columns, uff58};
use crate::recording::Recording;

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
    #[error("sample {sample} of {channel} is {value}; UFF holds finite numbers only: bridge it first, or write Parquet or CSV")]
    NotFinite {
        /// The channel.
        channel: String,
        /// The sample, from 0.
        sample: usize,
        /// Its value.
        value: f64,
    },
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
/// Another ending, samples that the format cannot hold, a place that cannot be written.
pub fn write(recording: &Recording, path: &Path) -> Result<(), WriteError> {
    match path.extension().and_then(|ending| ending.to_str()) {
        Some("uff" | "unv") => Ok(store::write(path, uff58::encoded(recording)?.as_bytes())?),
        Some(ending @ ("parquet" | "csv")) => Ok(columns::table(recording, ending == "csv")?.write(path, &columns::manifest(recording))?),
        _ => Err(WriteError::Format { path: path.to_owned() }),
    }
}
