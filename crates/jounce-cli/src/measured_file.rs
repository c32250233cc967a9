//! Arguments of commands that read a recording.

use crate::failure::Failure;
use crate::spec_arguments::OutputArguments;
use clap::Args;
use jounce_core::spec::Quantity as Unit;
use jounce_core::table::Manifest;
use jounce_measure::read::{self, ChannelSummary, RecordingSummary};
use jounce_measure::recording::{
    ChannelError, Issue, IssueKind, Quantity, Recording, choose_channel, find_channel,
};
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
    pub output: OutputArguments,
}

impl MeasuredFile {
    /// Returns the [`summary()`] of the file.
    pub fn summary(&self) -> Result<RecordingSummary, Failure> {
        summary(&self.file)
    }

    /// Returns the manifest of a result.
    pub fn manifest(&self, command: &str) -> Result<Manifest, Failure> {
        manifest(command, std::slice::from_ref(&self.file))
    }
}

/// Reads the first recording over time in a file, at even times and without missing samples.
pub fn record(file: &Path) -> Result<Recording, Failure> {
    Ok(read::record(file)?.into_even()?)
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
        print_issues(&recording.findings, Some(&[]));
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

/// Returns the first varying channel of a quantity, else the first varying channel, else the first
/// channel of the quantity.
pub fn first_live(recording: &RecordingSummary, quantity: Quantity) -> Option<usize> {
    let is_constant = |name: &str| {
        recording
            .findings
            .iter()
            .any(|f| f.kind == IssueKind::Constant && f.channel.as_deref() == Some(name))
    };
    let is_live = |channel: &&(usize, &ChannelSummary)| {
        channel.1.sizes.peak > 0.0 && !is_constant(&channel.1.name)
    };
    let channels: Vec<(usize, &ChannelSummary)> = recording.channels.iter().enumerate().collect();
    let preferred = channels
        .iter()
        .filter(is_live)
        .find(|(_, channel)| channel.quantity == quantity);
    preferred
        .or_else(|| channels.iter().find(is_live))
        .or_else(|| {
            channels
                .iter()
                .find(|(_, channel)| channel.quantity == quantity)
        })
        .or(channels.first())
        .map(|(k, _)| *k)
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
) -> Result<Recording, Failure> {
    let recording = recording
        .into_recording_of(channels)
        .map_err(|fault| Failure::Input(format!("the scratch file cannot be read: {fault}")))?;
    let uniform = recording.into_even()?;
    print_issues(&uniform.findings, None);
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

/// Reads two quantities of an option, as in `0.2s:3s`.
pub fn parse_interval(option: &str, text: &str, quantity: Unit) -> Result<(f64, f64), Failure> {
    let example = if quantity == Unit::Time {
        "0.2s:3s"
    } else {
        "500Hz:4300Hz"
    };
    let usage_error = || {
        Failure::usage(format!(
            "{option} {text}: write FROM:TO, as in {example}, the smaller one first"
        ))
    };
    let (from, to) = text.split_once(':').ok_or_else(usage_error)?;
    let read = |text: &str| {
        quantity
            .read(text)
            .map_err(|error| Failure::usage(format!("{option} {text}: {error}")))
    };
    let (from, to) = (read(from)?, read(to)?);
    if from < to {
        Ok((from, to))
    } else {
        Err(usage_error())
    }
}

/// Prints on stderr the issues of recordings and of the channels in use (without a list, of all
/// channels). A sentence is printed once, with the number of recordings it holds for. An issue that
/// changes no number of a result is a note.
pub fn print_issues(findings: &[Issue], used: Option<&[&str]>) {
    let is_relevant = |finding: &&Issue| match (&finding.channel, used) {
        (Some(channel), Some(used)) => used.contains(&channel.as_str()),
        _ => true,
    };
    let mut messages: Vec<(String, usize)> = Vec::new();
    for finding in findings.iter().filter(is_relevant) {
        let text = if finding.kind.is_note() {
            format!("note: {finding}")
        } else {
            finding.to_string()
        };
        match messages.iter_mut().find(|(message, _)| *message == text) {
            Some((_, times)) => *times += 1,
            None => messages.push((text, 1)),
        }
    }
    for (text, times) in messages {
        if times > 1 {
            eprintln!("{text} (in {times} recordings)");
        } else {
            eprintln!("{text}");
        }
    }
}
