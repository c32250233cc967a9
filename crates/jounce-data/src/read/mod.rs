//! Files of instruments to recordings.
//!
//! | format | read by |
//! |---|---|
//! | CSV and text with any header | the crate `csv` for the fields; which lines and columns hold numbers is found here |
//! | Parquet | the crate `parquet` |
//! | HDF5, MAT v7.3 | the crate `hdf5-pure` |
//! | MAT v5, structs and cells included | here: the libraries read no structs |
//! | NPY, NPZ | here, archives by the crate `rawzip` |
//! | TDMS | here: the libraries hold a file whole |
//! | WAV | here: the libraries read no 64-bit samples |
//! | UFF 55, 58, 58b | here: no kept library reads it |
//! | LVM | here: no kept library reads it |
//!
//! A file of notes beside it, `FILE.channels.toml`, names what the file does not: see [`Notes`].
mod arrays;
mod assemble;
mod contents;
mod decibels;
mod error;
mod given;
mod hdf5;
mod lvm;
mod magic;
mod mat;
mod moment;
mod name;
mod notes;
mod npy;
mod npz;
mod number;
mod numbers;
mod outline;
mod parquet;
mod part;
mod raw;
mod scalar;
mod shelf;
mod survey;
mod tdms;
mod text;
mod time;
mod uff;
mod verdict;
mod wav;
mod written;

pub use contents::{Contents, ModeShape, file, record, survey, survey_noted, survey_record, survey_record_noted};
pub use error::ReadError;
pub use given::{GivenError, given};
pub use notes::{ChannelNotes, Notes};
pub use numbers::Numbers;
pub use outline::Outline;
pub use raw::RawChannel;
pub use survey::{Places, Survey, Surveyed, SurveyedChannel};
pub use written::{DIRECTION, PLACE, REFERENCE};
