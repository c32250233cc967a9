//! Options of reading a recording.

use crate::error::Error;
use crate::options::{check_above_zero, defaults, frequency_hz};
use jounce_data::read::Notes;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Options of [`crate::Recording::read`].
#[derive(Debug, Clone, PartialEq, clap::Args, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ReadOptions {
    /// Sampling rate, as in 25600Hz; the times of the file are not used. By default the times of
    /// the file.
    #[arg(long = "sample-rate", value_name = "FREQUENCY", value_parser = frequency_hz)]
    pub sample_rate_hz: Option<f64>,
}

impl Default for ReadOptions {
    fn default() -> Self {
        defaults()
    }
}

impl ReadOptions {
    /// Returns the notes of a file with these options.
    pub(crate) fn notes(&self, path: &Path) -> Result<Notes, Error> {
        let mut notes = Notes::for_file(path)?;
        if let Some(rate_hz) = self.sample_rate_hz {
            notes.rate_hz = Some(check_above_zero("sample_rate", rate_hz, "Hz")?);
        }
        Ok(notes)
    }
}
