//! Arguments of commands that take a recording.

use crate::failure::Failure;
use clap::Args;
use jounce::spec::Quantity as Unit;
use jounce_measure::read::{self, Contents};
use jounce_measure::recording::{Channel, Over, Quantity, Recording};
use std::path::PathBuf;

/// A recording and the form of the answer.
#[derive(Debug, Args)]
pub struct MeasuredFile {
    /// The recording: CSV or text, Parquet, NPY, MAT v5, UFF or LVM; notes beside it in FILE.channels.toml.
    pub file: PathBuf,
    /// Prints one JSON object on stdout.
    #[arg(long)]
    pub json: bool,
}

impl MeasuredFile {
    /// Everything in the file.
    pub fn contents(&self) -> Result<Contents, Failure> {
        Ok(read::file(&self.file)?)
    }

    /// The first recording over time, at even times and without missing samples.
    pub fn record(&self) -> Result<Recording, Failure> {
        let recordings = self.contents()?.recordings;
        let record = recordings.into_iter().find(|recording| recording.over == Over::Time);
        let none = || Failure::Input(format!("{} holds no recording over time", self.file.display()));
        Ok(record.ok_or_else(none)?.even()?)
    }
}

/// The channel of a name or number; without one, the only channel or the first of a quantity.
pub fn channel<'a>(recording: &'a Recording, wanted: Option<&str>, quantity: Quantity, option: &str) -> Result<&'a Channel, Failure> {
    if let Some(wanted) = wanted {
        return Ok(recording.channel(wanted)?);
    }
    let of_quantity = recording.channels.iter().find(|channel| channel.quantity == quantity);
    let only = recording.channels.first().filter(|_| recording.channels.len() == 1);
    of_quantity.or(only).ok_or_else(|| {
        let names: Vec<&str> = recording.channels.iter().map(|channel| channel.name.as_str()).collect();
        Failure::usage(format!("name the channel with {option}; there are {}", names.join(", ")))
    })
}

/// A positive quantity of an option.
pub fn positive(option: &str, text: &str, quantity: Unit) -> Result<f64, Failure> {
    let fault = |reason: String| Failure::usage(format!("{option} {text}: {reason}"));
    let value = quantity.read(text).map_err(|error| fault(error.to_string()))?;
    if value > 0.0 && value.is_finite() { Ok(value) } else { Err(fault("it must be above 0".to_owned())) }
}

/// Tells on stderr what was noticed and done.
pub fn tell_findings(recording: &Recording) {
    for finding in &recording.findings {
        eprintln!("{finding}");
    }
}
