//! Writes recordings to files: UFF 58 (ASCII), Parquet and CSV.
mod columns;
mod file;
mod uff58;

pub use file::{WriteError, write, write_summary};
