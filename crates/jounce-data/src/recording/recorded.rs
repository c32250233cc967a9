//! A recording: channels over one grid.

use super::choose::named;
use super::{Channel, Grid, Issue, Over};

/// Channels of equal length over one grid of time or frequency.
#[derive(Debug, Clone, PartialEq)]
pub struct Recording {
    /// Its name: that of the file, with the number of the data set where a file holds several.
    pub name: String,
    /// What the samples are taken over.
    pub over: Over,
    /// Where the samples lie, s or Hz.
    pub grid: Grid,
    /// The channels, each with one sample for each place of the grid.
    pub channels: Vec<Channel>,
    /// Everything that was noticed or done.
    pub findings: Vec<Issue>,
}

/// A channel that a recording does not have.
#[derive(Debug, Clone, PartialEq, thiserror::Error, serde::Serialize)]
#[error("there is no channel {wanted:?} in {recording}; its channels are {}; a number from 1 will do too", channels.join(", "))]
pub struct NoChannel {
    /// What was asked for.
    pub wanted: String,
    /// The recording.
    pub recording: String,
    /// Its channels.
    pub channels: Vec<String>,
}

impl Recording {
    /// The channel of that name, or of that number from 1.
    ///
    /// # Errors
    /// No such channel; the error lists those that there are.
    pub fn channel(&self, wanted: &str) -> Result<&Channel, NoChannel> {
        Ok(&self.channels[named(&self.name, &self.heads(), wanted)?])
    }

    /// Samples per second (over time) or per hertz (over frequency).
    pub fn rate(&self) -> f64 {
        self.grid.rate()
    }
}
