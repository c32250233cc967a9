//! Arguments of commands that read a recording.

use crate::failure::Failure;
use crate::option_names::on_command_line;
use crate::output;
use crate::spec_arguments::OutputArguments;
use clap::Args;
use jounce::parts::{Issue, Manifest, UsesChannels, file_sha256, unreadable};
use jounce::{Error, ReadOptions, Recording};
use serde::Serialize;
use std::path::PathBuf;

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
    /// Reads the recording, with the channels that a computation uses.
    pub fn recording(&self, usage: &impl UsesChannels) -> Result<Recording, Failure> {
        Ok(Recording::read_for(&self.file, &self.read, usage)?)
    }

    /// Returns the manifest of a result.
    pub fn manifest(&self, command: &str, options: &impl Serialize) -> Result<Manifest, Failure> {
        manifest(
            command,
            std::slice::from_ref(&self.file),
            &self.read,
            options,
        )
    }
}

/// Returns the manifest of a result from recordings: their names and the SHA-256 of their bytes, in
/// order, the options that read them, and those of the command.
pub fn manifest(
    command: &str,
    files: &[PathBuf],
    read: &ReadOptions,
    options: &impl Serialize,
) -> Result<Manifest, Failure> {
    let name = |file: &PathBuf| {
        file.file_name()
            .map_or_else(String::new, |name| name.to_string_lossy().into_owned())
    };
    let names: Vec<String> = files.iter().map(name).collect();
    let hashes = files
        .iter()
        .map(|file| file_sha256(file).map_err(|error| Failure::Input(unreadable(file, &error))))
        .collect::<Result<Vec<_>, _>>()?;
    let manifest = Manifest::new("")
        .with("command", command)
        .with("recording", names.join(" "))
        .with("recording_sha256", hashes.join(" "));
    let manifest = manifest.with_options(read).map_err(Error::from)?;
    Ok(manifest.with_options(options).map_err(Error::from)?)
}

/// Returns a result; on an error, prints the issues of the complete recordings.
pub fn or_issues<T>(result: Result<T, Error>, recordings: &[Recording]) -> Result<T, Failure> {
    result.map_err(|error| {
        print_recording_issues(recordings);
        error.into()
    })
}

/// Prints on stderr the issues of complete recordings: they may explain an error, which may come
/// from the wrong recording.
pub fn print_recording_issues(recordings: &[Recording]) {
    let issues = recordings.iter().flat_map(Recording::issues);
    print_issues(issues.filter(|issue| issue.channel.is_none()));
}

/// Prints issues of recordings on stderr. A sentence is printed once, with the number of recordings
/// it holds for. An issue that changes no number of a result is a note.
pub fn print_issues<'a>(issues: impl IntoIterator<Item = &'a Issue>) {
    let mut messages: Vec<(String, usize)> = Vec::new();
    for issue in issues {
        let text = match issue.kind.is_note() {
            true => format!("note: {issue}"),
            false => on_command_line(&issue.to_string()),
        };
        match messages.iter_mut().find(|(message, _)| *message == text) {
            Some((_, times)) => *times += 1,
            None => messages.push((text, 1)),
        }
    }
    for (text, times) in messages {
        match times {
            1 => output::note(text),
            _ => output::note(format!("{text} (in {times} recordings)")),
        }
    }
}
