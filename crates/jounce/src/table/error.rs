//! What can be wrong with a table or its file.

use std::path::PathBuf;

use crate::store::StoreError;

/// A fault of a table or of its file.
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
        /// Its rows.
        rows: usize,
        /// The rows of the table.
        expected: usize,
    },
    /// Two columns with one name, or a column without a name.
    #[error("column name \"{column}\" is empty or used twice")]
    Name {
        /// The name.
        column: String,
    },
    /// The ending of the file name says no known format.
    #[error("cannot tell the format of \"{path}\" from its name; use .csv, .parquet or .json")]
    Format {
        /// The path.
        path: PathBuf,
    },
    /// A format library refused the content.
    #[error("cannot write \"{path}\": {reason}")]
    Encode {
        /// The path.
        path: PathBuf,
        /// What it said.
        reason: String,
    },
    /// The file could not be read back.
    #[error("cannot read the table \"{path}\": {reason}")]
    Read {
        /// The path.
        path: PathBuf,
        /// What is wrong with it.
        reason: String,
    },
    /// The file could not be stored.
    #[error(transparent)]
    Store(#[from] StoreError),
}
