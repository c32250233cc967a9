//! One channel of a recording, as a file with times and values.

use crate::error::Error;
use jounce_data::read;
use jounce_data::recording::{Channel, Issue, Recording};
use std::fmt::Write as _;
use std::path::Path;

/// One channel of a recording, as a file with times and values.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ChannelFile {
    /// Name and unit of the channel.
    pub channel: String,
    /// Data-quality issues of the recording and this channel.
    pub issues: Vec<String>,
}

impl ChannelFile {
    /// Reads a recording over time in any format, and writes one of its channels to a file of times
    /// and values. Several channels need the name of one, or its number.
    ///
    /// # Errors
    /// [`Error::Recording`] for a file that is no recording, a missing channel, or a target that
    /// cannot be written. The message names the file of the recording without its folder.
    pub fn write(recording: &Path, channel: Option<&str>, target: &Path) -> Result<Self, Error> {
        let name = recording.file_name().unwrap_or_default().to_string_lossy();
        let folder = recording.parent().unwrap_or(Path::new("")).join("");
        let read = read::record(recording).map_err(|error| {
            let message = error.to_string();
            Error::Recording(message.replace(&folder.display().to_string(), ""))
        })?;
        let of_name = |error: &dyn std::error::Error| Error::Recording(format!("{name}: {error}"));
        let even = read.into_even().map_err(|error| of_name(&error))?;
        let channel = match (channel, &even.channels[..]) {
            (Some(channel), _) => even.channel(channel).map_err(|error| of_name(&error))?,
            // Any quantity is allowed, since the scale converts it.
            (None, [only]) => only,
            (None, _) => return Err(of_name(&even.unnamed())),
        };
        std::fs::write(target, times_and_values(&even, channel))
            .map_err(|error| of_name(&error))?;
        let concerns = |issue: &&Issue| {
            let other = |of: &String| *of != channel.name;
            !issue.channel.as_ref().is_some_and(other)
        };
        let about = |issue: &Issue| issue.about.clone();
        Ok(Self {
            channel: match channel.unit.as_str() {
                "" => channel.name.clone(),
                unit => format!("{} in {unit}", channel.name),
            },
            issues: even.issues.iter().filter(concerns).map(about).collect(),
        })
    }
}

fn times_and_values(recording: &Recording, channel: &Channel) -> String {
    let mut text = "time (s),value\n".to_owned();
    for (position, value) in recording.grid.places().iter().zip(&channel.values) {
        let _ = writeln!(text, "{position:?},{value:?}");
    }
    text
}
