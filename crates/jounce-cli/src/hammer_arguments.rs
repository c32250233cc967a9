//! Arguments of a test, which `frf --measured` and `modes --measured` share.

use crate::failure::Failure;
use crate::measured_file::manifest;
use clap::Args;
use jounce::parts::Manifest;
use jounce::{MeasuredFrfOptions, ReadOptions, Recording};
use std::path::PathBuf;

/// Arguments of a hammer test.
#[derive(Debug, Args)]
pub struct HammerArguments {
    /// Recordings of a hammer or shaker test instead of a spec: input and responses over time, with
    /// one or more hits or a continuous input, at one or more excitation points; or one file of
    /// response functions over frequency. CSV or text, Parquet, NPY, NPZ, MAT, HDF5, TDMS, WAV, UFF
    /// or LVM; by default the spec is used.
    #[arg(long, value_name = "FILE", num_args = 1..)]
    pub measured: Vec<PathBuf>,
    #[command(flatten)]
    read: ReadOptions,
    #[command(flatten)]
    pub options: MeasuredFrfOptions,
}

impl HammerArguments {
    /// Reads the recordings.
    pub fn recordings(&self) -> Result<Vec<Recording>, Failure> {
        Ok(Recording::read_test(&self.measured, &self.read)?)
    }

    /// Returns the manifest of a result.
    pub fn manifest(&self, command: &str) -> Result<Manifest, Failure> {
        manifest(command, &self.measured, &self.read, &self.options)
    }
}
