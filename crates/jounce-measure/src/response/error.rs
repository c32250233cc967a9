//! Why recordings give no frequency response.

use crate::spectral::SpectralError;
use jounce_data::recording::NoChannel;

/// Recordings that give no frequency response.
#[derive(Debug, Clone, PartialEq, thiserror::Error, serde::Serialize)]
#[serde(untagged)]
pub enum ResponseError {
    /// No such channel.
    #[error(transparent)]
    Channel(#[from] NoChannel),
    /// No channel that is a force.
    #[error(
        "{recording} has no channel in newtons: name that of the force, or the input of another kind, as the acceleration of the base (--input, \
         input=); there are {}",
        channels.join(", ")
    )]
    NoForce {
        /// The recording.
        recording: String,
        /// Its channels.
        channels: Vec<String>,
    },
    /// A force in another unit.
    #[error(
        "channel {channel} of {recording} is in {unit}, not in newtons; choose another one, give it as the input where it excites without being a \
         force (--input, input=), or correct its unit in the notes beside it"
    )]
    NotForce {
        /// The recording.
        recording: String,
        /// The channel.
        channel: String,
        /// Its unit.
        unit: String,
    },
    /// An input without a unit that tells what it is.
    #[error(
        "channel {channel} of {recording} tells {}; an input must be in N, m/s^2, g, m/s, m, V or Pa: give its unit in the notes beside the \
         recording",
        if unit.is_empty() { "no unit".to_owned() } else { format!("the unit {unit}") }
    )]
    NotInput {
        /// The recording.
        recording: String,
        /// The channel.
        channel: String,
        /// Its unit.
        unit: String,
    },
    /// An input that is one quantity in one recording and another one in the next.
    #[error("the input {channel} is in {unit} in {}, and not in {}; give recordings of one kind of input", recordings[1], recordings[0])]
    InputUnits {
        /// The channel.
        channel: String,
        /// Two recordings.
        recordings: [String; 2],
        /// Its unit in the second one.
        unit: String,
    },
    /// A pulse of what is no force.
    #[error(
        "the input {channel} of {recording} does not go on as a shaker's does: hits are sought in forces only; record noise or a sweep, or take \
         it for that of a shaker (--shaker, shaker=True)"
    )]
    Pulse {
        /// The recording.
        recording: String,
        /// The channel.
        channel: String,
    },
    /// Forces at several places, some of which are not told.
    #[error(
        "the force acts at several places ({}), and {} tell none; responses to different places are different functions: give the place of \
         every force in the notes beside its recording",
        places.join(", "),
        silent.join(", ")
    )]
    Places {
        /// The places that are told.
        places: Vec<String>,
        /// The recordings that tell none.
        silent: Vec<String>,
    },
    /// A sensor that moves from recording to recording under one name.
    #[error(
        "channel {channel} sits at {}; responses at different places must not be averaged: give the recordings of one place of the sensor \
         at a time",
        places.join(", and at ")
    )]
    Moved {
        /// The channel.
        channel: String,
        /// Two of its places, each with a recording.
        places: [String; 2],
    },
    /// Nothing beside the input.
    #[error("{recording} holds no channel beside the input {force}")]
    NoResponse {
        /// The recording.
        recording: String,
        /// The force.
        force: String,
    },
    /// The input as a response to itself.
    #[error(
        "{force} of {recording} is the input, and cannot respond to itself: name a channel beside it, or another input"
    )]
    OwnResponse {
        /// The recording.
        recording: String,
        /// The force.
        force: String,
    },
    /// Spectra without phase.
    #[error(
        "{recording} is over frequency and holds no complex channel: a response function has a real and an imaginary part; tell what its columns \
         hold (--functions re-im or size-degrees, functions=)"
    )]
    NotComplex {
        /// The recording.
        recording: String,
    },
    /// Columns that are to be functions over what is told to be a time.
    #[error(
        "{recording} is read as a recording over time; write over = \"frequency\" in the notes beside the file, and time = \"1\" for its column"
    )]
    OverTime {
        /// The recording.
        recording: String,
    },
    /// Columns that are no pairs.
    #[error(
        "{recording} has {} real columns ({}), and two make a response function: leave the others out in the notes beside the file",
        channels.len(),
        channels.join(", ")
    )]
    Unpaired {
        /// The recording.
        recording: String,
        /// Its real channels.
        channels: Vec<String>,
    },
    /// Response functions over unequal frequencies.
    #[error("{first} and {other} lie at unequal frequencies; give response functions of one test")]
    Frequencies {
        /// The first recording.
        first: String,
        /// Another one.
        other: String,
    },
    /// A decay of too few samples.
    #[error(
        "{recording} leaves {samples} samples for a decay; at least {needed} are needed: give a longer span, longer lags or a finer record"
    )]
    Short {
        /// The recording.
        recording: String,
        /// What is left.
        samples: usize,
        /// What is needed.
        needed: usize,
    },
    /// Lags too long for their record.
    #[error(
        "lags of {lags_s} s are too long for {recording}; at most a quarter of it will do, {most_s} s"
    )]
    Lags {
        /// The recording.
        recording: String,
        /// Longest lag asked for, s.
        lags_s: f64,
        /// The most, s.
        most_s: f64,
    },
    /// No amplitude spectrum.
    #[error("{recording} is no amplitude spectrum to take a correlation from: {reason}")]
    NotAmplitude {
        /// The recording.
        recording: String,
        /// What is wrong.
        reason: &'static str,
    },
    /// No recording at all.
    #[error("there is no recording to take responses from")]
    Nothing,
    /// What the samples cannot answer.
    #[error(transparent)]
    Spectral(#[from] SpectralError),
}
