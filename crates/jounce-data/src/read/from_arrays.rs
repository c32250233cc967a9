//! Builds recordings from samples in memory, measured or read by another program.

use crate::read::assemble;
use crate::read::column::raw::RawChannel;
use crate::recording::{Grid, Over, Recording, inspect};

/// Error of samples that cannot form a recording.
#[derive(Debug, Clone, PartialEq, thiserror::Error, serde::Serialize)]
#[serde(untagged)]
pub enum ArraysError {
    /// No channel.
    #[error("there is no channel; give at least one")]
    NoChannel,
    /// The scratch file cannot be read back.
    #[error("the samples cannot be stored: {reason}")]
    Kept {
        /// Error of the operating system.
        reason: String,
    },
    /// Channels of unequal length.
    #[error(
        "channel {channel} has {samples} samples for {places} times or frequencies; the numbers \
        must be equal"
    )]
    Length {
        /// The channel.
        channel: String,
        /// Number of samples.
        samples: usize,
        /// Number of grid positions.
        places: usize,
    },
}

/// Builds a recording from channels with units in instrument notation. Values are converted to SI
/// and inspected for issues, as for a file.
///
/// # Errors
/// No channel, or a channel whose length differs from the grid.
pub fn recording_from_arrays(
    name: &str,
    over: Over,
    grid: Grid,
    channels: Vec<RawChannel>,
) -> Result<Recording, ArraysError> {
    if channels.is_empty() {
        return Err(ArraysError::NoChannel);
    }
    let places = grid.len();
    let lengths = |channel: &RawChannel| {
        [
            channel.values.len(),
            channel.imaginary.as_ref().map_or(places, Vec::len),
        ]
    };
    for channel in &channels {
        if let Some(samples) = lengths(channel)
            .into_iter()
            .find(|samples| *samples != places)
        {
            return Err(ArraysError::Length {
                channel: channel.name.clone(),
                samples,
                places,
            });
        }
    }
    let mut issues = Vec::new();
    let channel_summary = |channel: RawChannel| {
        assemble::channel_summary(channel.into(), Default::default(), &mut issues).into_channel()
    };
    let channels = channels
        .into_iter()
        .map(channel_summary)
        .collect::<std::io::Result<Vec<_>>>()
        .map_err(|fault| ArraysError::Kept {
            reason: fault.to_string(),
        })?;
    issues.extend(channels.iter().flat_map(inspect));
    Ok(Recording {
        name: name.to_owned(),
        over,
        grid,
        channels,
        issues,
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::recording::{IssueKind, Quantity};

    fn one(unit: &str, values: Vec<f64>) -> Vec<RawChannel> {
        vec![RawChannel::new("a", unit, values)]
    }

    #[test]
    fn samples_are_converted_to_si_and_checked() {
        let grid = Grid::even(0.0, 0.5, 3).unwrap();
        let recording = recording_from_arrays(
            "x",
            Over::Time,
            grid.clone(),
            one("g", vec![1.0, f64::NAN, -2.0]),
        )
        .unwrap();
        assert_eq!(
            (
                recording.channels[0].quantity,
                recording.channels[0].values[0]
            ),
            (Quantity::Acceleration, 9.806_65)
        );
        let kinds: Vec<IssueKind> = recording.issues.iter().map(|issue| issue.kind).collect();
        assert_eq!(kinds, [IssueKind::Converted, IssueKind::NotANumber]);
        assert_eq!(
            recording_from_arrays("x", Over::Time, grid.clone(), Vec::new()),
            Err(ArraysError::NoChannel)
        );
        let length_error = ArraysError::Length {
            channel: "a".into(),
            samples: 2,
            places: 3,
        };
        assert_eq!(
            recording_from_arrays("x", Over::Time, grid, one("g", vec![1.0, 2.0])),
            Err(length_error)
        );
    }
}
