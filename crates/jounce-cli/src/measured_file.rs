//! Arguments of commands that read a recording.

use crate::failure::Failure;
use crate::output;
use crate::spec_arguments::OutputArguments;
use clap::Args;
use jounce::{Error, ReadOptions, Recording, UsesChannels};
use jounce_core::spec::Quantity as Unit;
use jounce_core::table::Manifest;
use jounce_measure::read::{self, RecordingSummary};
use jounce_measure::recording::{ChannelError, Issue, Quantity, choose_channel, find_channel};
use serde::Serialize;
use sha2::{Digest, Sha256};
use std::io::Read;
use std::path::{Path, PathBuf};

/// A recording and the output options.
#[derive(Debug, Args)]
pub struct MeasuredFile {
    /// The recording: CSV or text, Parquet, NPY, NPZ, MAT, HDF5, TDMS, WAV, UFF or LVM. Channel
    /// notes can stand in FILE.channels.toml next to it.
    pub file: PathBuf,
    #[command(flatten)]
    pub read: ReadOptions,
    #[command(flatten)]
    pub output: OutputArguments,
}

impl MeasuredFile {
    /// Returns the [`summary()`] of the file.
    pub fn summary(&self) -> Result<RecordingSummary, Failure> {
        summary(&self.file)
    }

    /// Reads the recording, with the channels that a computation uses.
    pub fn recording(&self, usage: &impl UsesChannels) -> Result<Recording, Failure> {
        Ok(Recording::read_for(&self.file, &self.read, usage)?)
    }

    /// Returns the manifest of a result.
    pub fn manifest(&self, command: &str) -> Result<Manifest, Failure> {
        manifest(command, std::slice::from_ref(&self.file))
    }
}

/// Returns the manifest of a result from recordings: their names and the SHA-256 of their bytes, in
/// order.
pub fn manifest(command: &str, files: &[PathBuf]) -> Result<Manifest, Failure> {
    let name = |file: &PathBuf| {
        file.file_name()
            .map_or_else(String::new, |name| name.to_string_lossy().into_owned())
    };
    let names: Vec<String> = files.iter().map(name).collect();
    let hashes = files
        .iter()
        .map(|file| hash_hex(file))
        .collect::<Result<Vec<_>, _>>()?;
    let manifest = Manifest::new("").with("command", command);
    Ok(manifest
        .with("recording", names.join(" "))
        .with("recording_sha256", hashes.join(" ")))
}

/// Adds the options of a result that are given to its manifest.
pub fn with_options(manifest: Manifest, options: &impl Serialize) -> Result<Manifest, Failure> {
    let options = output::to_json(options)?;
    let given = options.as_object().into_iter().flatten();
    let given = given.filter(|(_, value)| !value.is_null());
    Ok(
        given.fold(manifest, |manifest, (name, value)| match value.as_str() {
            Some(text) => manifest.with(name, text),
            None => manifest.with(name, value),
        }),
    )
}

/// Computes the SHA-256 of a file, read in blocks.
fn hash_hex(file: &Path) -> Result<String, Failure> {
    let fault = |reason: std::io::Error| Failure::Input(format!("{}: {reason}", file.display()));
    let mut input = std::fs::File::open(file).map_err(fault)?;
    let (mut hash, mut buffer) = (Sha256::new(), vec![0; 1 << 16]);
    loop {
        let count = input.read(&mut buffer).map_err(fault)?;
        if count == 0 {
            return Ok(hash
                .finalize()
                .iter()
                .map(|byte| format!("{byte:02x}"))
                .collect());
        }
        hash.update(&buffer[..count]);
    }
}

/// Returns the number of the channel of a name or number; without one, of the only channel or the
/// first of a quantity. If the channel has no unit, the assumption is added to the findings.
pub fn channel(
    recording: &mut RecordingSummary,
    name: Option<&str>,
    quantity: Quantity,
    option: &str,
) -> Result<usize, Failure> {
    let choice = choose_channel(&recording.name, &recording.heads(), name, quantity);
    if choice.is_err() {
        // The message names the recording, which may be the wrong one.
        print_issues(
            recording
                .findings
                .iter()
                .filter(|issue| issue.channel.is_none()),
        );
    }
    let number = choice.map_err(|error| match error {
        ChannelError::Missing(error) => error.into(),
        error @ ChannelError::Unnamed { .. } => Failure::usage(format!("{option}: {error}")),
        error @ ChannelError::Unit { .. } => Failure::Input(format!("{option}: {error}")),
    })?;
    let assumed = recording.channels[number]
        .head()
        .assumed_unit_issue(quantity);
    recording.findings.extend(assumed);
    Ok(number)
}

/// Returns the number of the channel of a name or number, of any quantity.
pub fn any_channel(recording: &RecordingSummary, name_or_number: &str) -> Result<usize, Failure> {
    Ok(find_channel(
        &recording.name,
        &recording.heads(),
        name_or_number,
    )?)
}

/// Reads the first recording over time in a file, without its samples in memory.
pub fn summary(file: &Path) -> Result<RecordingSummary, Failure> {
    Ok(read::record_summary(file)?)
}

/// Loads channels of a recording at even times and without missing samples; the others are not
/// loaded. Prints on stderr the issues of these channels and of the recording, and the corrections
/// made.
pub fn load_channels(
    recording: RecordingSummary,
    channels: &[usize],
) -> Result<jounce_measure::recording::Recording, Failure> {
    let recording = recording
        .into_recording_of(channels)
        .map_err(|fault| Failure::Input(format!("the scratch file cannot be read: {fault}")))?;
    let uniform = recording.into_even()?;
    print_issues(&uniform.findings);
    Ok(uniform)
}

/// Reads a positive quantity of an option.
pub fn parse_positive(option: &str, text: &str, quantity: Unit) -> Result<f64, Failure> {
    let fault = |reason: String| Failure::usage(format!("{option} {text}: {reason}"));
    let value = quantity
        .read(text)
        .map_err(|error| fault(error.to_string()))?;
    if value > 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err(fault("it must be above 0".to_owned()))
    }
}

/// Returns a result; on an error, prints the issues of the complete recordings on stderr, since the
/// cause may be the wrong recording.
pub fn or_issues<T>(result: Result<T, Error>, recordings: &[Recording]) -> Result<T, Failure> {
    result.map_err(|error| {
        let issues = recordings.iter().flat_map(Recording::issues);
        print_issues(issues.filter(|issue| issue.channel.is_none()));
        error.into()
    })
}

/// Prints issues of recordings on stderr. A sentence is printed once, with the number of recordings
/// it holds for. An issue that changes no number of a result is a note.
pub fn print_issues<'a>(issues: impl IntoIterator<Item = &'a Issue>) {
    let mut messages: Vec<(String, usize)> = Vec::new();
    for issue in issues {
        let text = match issue.kind.is_note() {
            true => format!("note: {issue}"),
            false => issue.to_string(),
        };
        match messages.iter_mut().find(|(message, _)| *message == text) {
            Some((_, times)) => *times += 1,
            None => messages.push((text, 1)),
        }
    }
    for (text, times) in messages {
        match times {
            1 => eprintln!("{text}"),
            _ => eprintln!("{text} (in {times} recordings)"),
        }
    }
}
