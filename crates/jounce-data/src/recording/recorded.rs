//! Recording: channels over one grid.

use super::choose::find_channel;
use super::{Channel, Grid, Issue, Over};

/// Channels of equal length over one grid of time or frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct Recording {
    /// Name: the file name, with the number of the data set if the file contains several.
    pub name: String,
    /// Independent variable of the samples.
    pub over: Over,
    /// Sample positions, s or Hz.
    pub grid: Grid,
    /// Channels, each with one sample per grid position.
    pub channels: Vec<Channel>,
    /// Data-quality issues and conversions.
    pub issues: Vec<Issue>,
}

/// Error of a channel that does not exist.
#[derive(Debug, Clone, PartialEq, thiserror::Error, serde::Serialize)]
#[error("there is no channel {wanted:?} in {recording}; give a name, {}, or a number from 1 to {}",
    channels.join(", "), channels.len())]
pub struct NoChannel {
    /// Requested channel.
    pub wanted: String,
    /// The recording.
    pub recording: String,
    /// Existing channels.
    pub channels: Vec<String>,
}

impl Recording {
    /// Returns the channel of a name, or of a number from 1.
    ///
    /// # Errors
    /// No such channel; the error lists the existing ones.
    pub fn channel(&self, requested: &str) -> Result<&Channel, NoChannel> {
        Ok(&self.channels[find_channel(&self.name, &self.heads(), requested)?])
    }

    /// Samples per second (over time) or per hertz (over frequency).
    pub fn rate(&self) -> f64 {
        self.grid.rate()
    }
}
