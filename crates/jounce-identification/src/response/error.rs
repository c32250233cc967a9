//! Errors of measuring frequency responses.

use jounce_data::recording::NoChannel;
use jounce_signal::spectral::SpectralError;

/// Error of computing frequency responses from recordings.
#[derive(Debug, Clone, PartialEq, thiserror::Error, serde::Serialize)]
#[serde(untagged)]
pub enum ResponseError {
    /// The channel does not exist.
    #[error(transparent)]
    Channel(#[from] NoChannel),
    /// No channel is a force.
    #[error(
        "{recording} has no channel in newtons: name the force channel, or an input of another \
        kind, such as the acceleration of the base (--input, input=); the channels are {}",
        channels.join(", ")
    )]
    NoForce {
        /// The recording.
        recording: String,
        /// Its channels.
        channels: Vec<String>,
    },
    /// The force has another unit.
    #[error(
        "channel {channel} of {recording} is in {unit}, not in newtons; choose another channel, \
        use it as the input if it excites without being a force (--input, input=), or correct its \
        unit in the notes of the recording"
    )]
    NotForce {
        /// The recording.
        recording: String,
        /// The channel.
        channel: String,
        /// Its unit.
        unit: String,
    },
    /// The unit of an input is missing or does not identify its quantity.
    #[error(
        "channel {channel} of {recording} has {}; an input must be in N, m/s^2, g, m/s, m, V or \
        Pa: give its unit in the notes of the recording",
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
    /// The input differs in quantity between recordings.
    #[error("the input {channel} is in {unit} in {}, but not in {}; give recordings of one kind \
        of input", recordings[1], recordings[0])]
    InputUnits {
        /// The channel.
        channel: String,
        /// Two recordings.
        recordings: [String; 2],
        /// Unit in the second one.
        unit: String,
    },
    /// The input is a pulse but not a force.
    #[error(
        "the input {channel} of {recording} is not continuous as a shaker's is: hits are sought \
        in forces only; record noise or a sweep, or treat it as a shaker's (--shaker, shaker=True)"
    )]
    Pulse {
        /// The recording.
        recording: String,
        /// The channel.
        channel: String,
    },
    /// Some of several force locations are missing.
    #[error(
        "the force acts at several places ({}), but the place is missing in {}; responses to \
        different places are different functions: give the place of every force in the notes of \
        its recording",
        places.join(", "),
        silent.join(", ")
    )]
    Places {
        /// Known locations.
        places: Vec<String>,
        /// Recordings without a location.
        silent: Vec<String>,
    },
    /// A sensor changes location between recordings under one name.
    #[error(
        "channel {channel} is at {}; responses at different places must not be averaged: give the \
        recordings of one place of the sensor at a time",
        places.join(", and at ")
    )]
    Moved {
        /// The channel.
        channel: String,
        /// Two of its locations, each with a recording.
        places: [String; 2],
    },
    /// There is no channel other than the input.
    #[error("{recording} has no channel other than the input {force}")]
    NoResponse {
        /// The recording.
        recording: String,
        /// The force.
        force: String,
    },
    /// The input is also requested as a response.
    #[error(
        "{force} of {recording} is the input, and cannot respond to itself: name another channel, \
        or another input"
    )]
    OwnResponse {
        /// The recording.
        recording: String,
        /// The force.
        force: String,
    },
    /// The spectra have no phase.
    #[error(
        "{recording} is over frequency and has no complex channel: a response function has a real \
        and an imaginary part; specify the contents of its columns (--functions re-im or \
        size-degrees, functions=)"
    )]
    NotComplex {
        /// The recording.
        recording: String,
    },
    /// Columns to be read as functions are over time.
    #[error(
        "{recording} is read as a recording over time; write over = \"frequency\" in the notes of \
        the file, and time = \"1\" for its column"
    )]
    OverTime {
        /// The recording.
        recording: String,
    },
    /// The columns are not in pairs.
    #[error(
        "{recording} has {} real columns ({}), but a response function needs two: leave the \
        others out in the notes of the file",
        channels.len(),
        channels.join(", ")
    )]
    Unpaired {
        /// The recording.
        recording: String,
        /// Its real channels.
        channels: Vec<String>,
    },
    /// The response functions have unequal frequencies.
    #[error("{first} and {other} have unequal frequencies; give response functions of one test")]
    Frequencies {
        /// The first recording.
        first: String,
        /// The other recording.
        other: String,
    },
    /// A decay has too few samples.
    #[error(
        "{recording} leaves {samples} samples for a decay; at least {needed} are needed: give a longer span, longer lags or a finer record"
    )]
    Short {
        /// The recording.
        recording: String,
        /// Remaining samples.
        samples: usize,
        /// Required samples.
        needed: usize,
    },
    /// The lags are too long for the record.
    #[error(
        "lags of {lags_s} s are too long for {recording}; the limit is a quarter of it, {most_s} s"
    )]
    Lags {
        /// The recording.
        recording: String,
        /// Requested maximum lag, s.
        lags_s: f64,
        /// Limit, s.
        most_s: f64,
    },
    /// The recording is not an amplitude spectrum.
    #[error(
        "{recording} is not an amplitude spectrum from which a correlation can be computed: \
        {reason}"
    )]
    NotAmplitude {
        /// The recording.
        recording: String,
        /// The fault.
        reason: &'static str,
    },
    /// There is no recording.
    #[error("there is no recording to compute responses from")]
    Nothing,
    /// The samples do not allow the analysis.
    #[error(transparent)]
    Spectral(#[from] SpectralError),
}
