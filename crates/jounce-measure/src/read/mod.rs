//! Files of instruments to recordings.
//!
//! | format | read by |
//! |---|---|
//! | CSV and text with any header | the crate `csv` for the fields; which lines and columns hold numbers is found here |
//! | Parquet | the crate `parquet` |
//! | NPY | the crate `npyz` |
//! | MAT v5 | the crate `matfile`; v7.3 is HDF5: save it as v5 or read it in Python |
//! | UFF 55, 58, 58b | here: no kept library reads it |
//! | LVM | here: no kept library reads it |
//!
//! A file of notes beside it, `FILE.channels.toml`, names what the file does not: see [`Notes`].
mod assemble;
mod contents;
mod decibels;
mod error;
mod given;
mod lvm;
mod mat;
mod moment;
mod name;
mod notes;
mod npy;
mod number;
mod numbers;
mod outline;
mod parquet;
mod part;
mod raw;
mod shelf;
mod survey;
mod text;
mod time;
mod uff;
mod verdict;
mod written;

pub use contents::{Contents, ModeShape, file, record, survey, survey_record};
pub use error::ReadError;
pub use given::{GivenError, given};
pub use notes::{ChannelNotes, Notes};
pub use numbers::Numbers;
pub use outline::Outline;
pub use raw::RawChannel;
pub use survey::{Places, Survey, Surveyed, SurveyedChannel};
pub(crate) use written::{DIRECTION, PLACE, REFERENCE};
