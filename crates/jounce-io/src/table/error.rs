//! Errors of tables and their files.

use std::path::PathBuf;

use crate::store::StoreError;

/// Error of a table or of its file.
#[derive(Debug, thiserror::Error, serde::Serialize)]
#[serde(untagged)]
pub enum TableError {
    /// A column does not fit the columns before it.
    #[error(
        "column \"{column}\" has {rows} rows, the table has {expected}; all columns of a table are equally long"
    )]
    Lengths {
        /// Name of the column.
        column: String,
        /// Rows of the column.
        rows: usize,
        /// Rows of the table.
        expected: usize,
    },
    /// Two columns have one name, or a column has no name.
    #[error("column name \"{column}\" is empty or used twice")]
    Name {
        /// Name of the column.
        column: String,
    },
    /// Options of a result that JSON cannot hold.
    #[error("cannot store the options of a result: {reason}")]
    Options {
        /// Message of the library.
        reason: String,
    },
    /// The file extension is not a known format.
    #[error("the extension of \"{path}\" is not a known format; use .csv, .parquet or .json")]
    Format {
        /// Path of the file.
        path: PathBuf,
    },
    /// A format library refused the content.
    #[error("cannot write \"{path}\": {reason}")]
    Encode {
        /// Path of the file.
        path: PathBuf,
        /// Message of the library.
        reason: String,
    },
    /// The file could not be read back.
    #[error("cannot read the table \"{path}\": {reason}")]
    Read {
        /// Path of the file.
        path: PathBuf,
        /// Reason of the failure.
        reason: String,
    },
    /// The file could not be stored.
    #[error(transparent)]
    Store(#[from] StoreError),
}
