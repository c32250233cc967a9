//! Reads instrument files into recordings.
//!
//! | format | read by |
//! |---|---|
//! | CSV and text with any header | the crate `csv` for the fields; this module finds the lines and columns of numbers |
//! | Parquet | the crate `parquet` |
//! | HDF5, MAT v7.3 | the crate `hdf5-pure` |
//! | MAT v5, including structs and cells | this module: the libraries read no structs |
//! | NPY, NPZ | this module; archives by the crate `rawzip` |
//! | TDMS | this module: the libraries hold the complete file in memory |
//! | WAV | this module: the libraries read no 64-bit samples |
//! | UFF 55, 58, 58b | this module: no maintained library reads it |
//! | LVM | this module: no maintained library reads it |
//!
//! A file of notes, `FILE.channels.toml`, supplies what the file lacks: see [`Notes`].
mod assemble;
mod column;
mod contents;
mod error;
mod format;
mod from_arrays;
mod heading;
mod magic;
mod notes;
mod summary;
mod vectors;

pub use column::numbers::ColumnNumbers;
pub use column::raw::RawChannel;
pub use contents::{
    Contents, ModeShape, file, record, record_summary, record_summary_with_notes, summary,
    summary_with_notes,
};
pub use error::ReadError;
pub use from_arrays::{ArraysError, recording_from_arrays};
pub use notes::written::{DIRECTION, PLACE, REFERENCE};
pub use notes::{ChannelNotes, Notes};
pub use summary::decimation::DecimatedRecording;
pub use summary::{ChannelSummary, FileSummary, RecordingSummary, SamplePlaces};
pub use vectors::{Vector, vectors};
