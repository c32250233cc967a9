//! Reasons why a channel cannot drive a base or a point.

use jounce_data::recording::NoChannel;

/// Reason why a channel cannot drive a base or a point.
#[derive(Debug, Clone, PartialEq, thiserror::Error, serde::Serialize)]
#[serde(untagged)]
pub enum RecordingError {
    /// The channel measures another quantity.
    #[error(
        "channel {channel} is in {unit}, which does not convert to {wanted}; name another channel, or set `unit` to the unit of its values"
    )]
    Unit {
        /// The channel.
        channel: String,
        /// Its unit.
        unit: String,
        /// SI unit of the required quantity.
        wanted: &'static str,
    },
    /// The file already contains the unit.
    #[error(
        "the file gives channel {channel} a unit already (in SI {unit}); omit `unit`, or correct it in the notes next to the file"
    )]
    UnitTwice {
        /// The channel.
        channel: String,
        /// SI unit of the channel in the file.
        unit: String,
    },
    /// No channel is named and several fit.
    #[error("several channels fit ({}); name one with `channel`", channels.join(", "))]
    Several {
        /// Channels that fit.
        channels: Vec<String>,
    },
    /// No channel fits.
    #[error("no varying channel is without a unit or has one that converts to {wanted}; the channels are {}", channels.join(", "))]
    None {
        /// All channels.
        channels: Vec<String>,
        /// SI unit of the required quantity.
        wanted: &'static str,
    },
    /// The channel does not exist.
    #[error(transparent)]
    Missing(#[from] NoChannel),
    /// The channel is constant.
    #[error(
        "channel {channel} is constant at {mean} {unit} and excites nothing; name another channel"
    )]
    Still {
        /// The channel.
        channel: String,
        /// Its mean.
        mean: f64,
        /// SI unit of the mean.
        unit: &'static str,
    },
    /// The samples are not evenly spaced in time.
    #[error("{recording} is not evenly sampled in time; resample it first")]
    NotEven {
        /// The recording.
        recording: String,
    },
    /// Fewer than two samples.
    #[error("{recording} has fewer than two samples")]
    Few {
        /// The recording.
        recording: String,
    },
    /// A sample is not finite.
    #[error("channel {channel} has a sample that is not a finite number; fill its gaps first")]
    NotANumber {
        /// The channel.
        channel: String,
    },
}
