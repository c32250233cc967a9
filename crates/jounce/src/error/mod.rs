//! Errors of the computations.

mod conversions;
mod details;
mod kind;

pub use details::ErrorDetails;
pub use kind::ErrorKind;

use impact_harvester_2019::experiment::ExperimentError;
use jounce_analysis::study::StudyError;
use jounce_analysis::{AnalysisError, GridError, JournalError};
use jounce_continuation::ContinuationError;
use jounce_data::read::ArraysError;
use jounce_data::recording::{ChannelError, NoChannel};
use jounce_data::write::WriteError;
use jounce_design::DesignError;
use jounce_experiment::fit::FitError;
use jounce_experiment::rig::RigError;
use jounce_experiment::segmentation::SegmentationError;
use jounce_experiment::solution::SolutionError;
use jounce_identification::modal::ModalError;
use jounce_identification::response::ResponseError;
use jounce_io::store::StoreError;
use jounce_io::table::TableError;
use jounce_model::exchange::ExchangeFaults;
use jounce_model::linear::RandomError;
use jounce_orbits::OrbitError;
use jounce_plot::PictureError;
use jounce_signal::SignalError;
use jounce_signal::spectral::SpectralError;
use jounce_spec::starter::UnknownKind;
use jounce_spec::{Fault, Faults, ReadError};

/// Reason why a computation has no result. The message names the value, what is allowed, and what
/// to try.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A spec file cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The spec has faults: all of them, with their places.
    #[error(transparent)]
    Spec(#[from] Faults),
    /// An option has a value that is not allowed.
    #[error("{option} is {value}; {expected}")]
    Option {
        /// Name of the option.
        option: &'static str,
        /// Its value, as text.
        value: String,
        /// The allowed values and what to try.
        expected: String,
    },
    /// Several options have values that are not allowed.
    #[error("{}", lines(.0))]
    Options(Vec<Self>),
    /// The key or the range of an option has faults.
    #[error("{option} is {value}; {}", reasons(.faults))]
    Range {
        /// Name of the option.
        option: &'static str,
        /// Its value, as text.
        value: String,
        /// The faults.
        faults: Faults,
    },
    /// The grid of starts cannot be read.
    #[error("grid: {0}")]
    Grid(#[from] GridError),
    /// The spec has no drive.
    #[error("{what} needs a drive: add [drive.NAME] to the spec")]
    NoDrive {
        /// What needs it.
        what: &'static str,
    },
    /// The amplitude of every drive is 0.
    #[error(
        "drive.amplitude is 0, but {what} needs a drive that moves: give it an amplitude greater than 0"
    )]
    DriveAtRest {
        /// What needs it.
        what: &'static str,
    },
    /// The harvester has neither a stop nor a circuit, so its response is linear.
    #[error(
        "the harvester has neither a stop nor a circuit, so its response is linear: compute its frequency response, or add a [stop.NAME] or a [circuit.NAME]"
    )]
    Linear,
    /// The model has no solution, or a run failed.
    #[error(transparent)]
    Analysis(#[from] AnalysisError),
    /// The search for an orbit failed.
    #[error(transparent)]
    Orbit(OrbitError<AnalysisError>),
    /// The spec has no linear response to noise.
    #[error(transparent)]
    Noise(#[from] RandomError),
    /// There is no starter of a kind.
    #[error(transparent)]
    Starter(#[from] UnknownKind),
    /// The fit has no result.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// The paper cannot be reproduced.
    #[error(transparent)]
    Reproduce(Box<ExperimentError>),
    /// The orbit at a point of a branch cannot be computed again.
    #[error(transparent)]
    Continuation(Box<ContinuationError<OrbitError<AnalysisError>>>),
    /// A recording of the page cannot be read or has no such channel.
    #[error("{0}")]
    Recording(String),
    /// The journal of finished points cannot be used.
    #[error(transparent)]
    Journal(#[from] JournalError),
    /// A file cannot be written.
    #[error(transparent)]
    File(#[from] StoreError),
    /// A table cannot be created.
    #[error(transparent)]
    Table(#[from] TableError),
    /// A figure cannot be written.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// A design problem has faults, or no design can be evaluated.
    #[error(transparent)]
    Design(Box<DesignError>),
    /// A study, its folder or a part of it cannot be used.
    #[error(transparent)]
    Study(Box<StudyError>),
    /// A signal is too short or holds a value that is not finite.
    #[error(transparent)]
    Signal(#[from] SignalError),
    /// Matrices of another program have faults, or a model has no equivalent circuit.
    #[error(transparent)]
    Exchange(#[from] ExchangeFaults),
    /// A virtual test cannot be simulated.
    #[error(transparent)]
    Rig(#[from] RigError),
    /// A recording cannot be cut into segments.
    #[error(transparent)]
    Segmentation(#[from] SegmentationError),
    /// The solutions of a model cannot be found.
    #[error(transparent)]
    Solution(Box<SolutionError>),
    /// A recording cannot be read.
    #[error(transparent)]
    ReadRecording(#[from] jounce_data::read::ReadError),
    /// The scratch file of a recording cannot be used.
    #[error("the scratch file cannot be used: {}", jounce_io::store::reason(.0))]
    Scratch(#[source] std::io::Error),
    /// Samples cannot form a recording.
    #[error(transparent)]
    Arrays(#[from] ArraysError),
    /// The times or frequencies of a recording have no rate.
    #[error(transparent)]
    RecordingGrid(#[from] jounce_data::recording::GridError),
    /// A channel does not exist.
    #[error(transparent)]
    NoChannel(#[from] NoChannel),
    /// An option names no suitable channel.
    #[error("{}", of_channel(option, error))]
    Channel {
        /// Name of the option.
        option: &'static str,
        /// The reason.
        error: ChannelError,
    },
    /// A recording has no channel.
    #[error("{recording} has no channel")]
    WithoutChannel {
        /// The recording.
        recording: String,
    },
    /// A file contains no recording.
    #[error(
        "{} contains no recording to write, only {shapes} mode shapes; recordings can be written",
        path.display()
    )]
    NoRecording {
        /// The file.
        path: std::path::PathBuf,
        /// Number of its mode shapes.
        shapes: usize,
    },
    /// A channel was not loaded.
    #[error("the channel {channel} was not loaded; read the recording with all channels")]
    NotLoaded {
        /// The channel.
        channel: String,
    },
    /// A recording is over frequency.
    #[error("{recording} is not a recording over time")]
    NotOverTime {
        /// The recording.
        recording: String,
    },
    /// A recording cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// The analysis of samples is not possible.
    #[error(transparent)]
    Spectral(#[from] SpectralError),
    /// Frequency responses or decays cannot be computed.
    #[error(transparent)]
    Response(#[from] ResponseError),
    /// Modes cannot be identified.
    #[error(transparent)]
    Modal(#[from] ModalError),
    /// The threads cannot be started.
    #[error("the threads cannot be started: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
    /// The control stopped the computation before it had a result.
    #[error("stopped before the first result")]
    Stopped,
}

impl Error {
    /// Returns the only error of some, or all of them as one.
    pub(crate) fn of_options(mut errors: Vec<Self>) -> Self {
        match errors.len() {
            1 => errors.swap_remove(0),
            _ => Self::Options(errors),
        }
    }

    /// Returns the error of an option.
    pub(crate) fn option(
        option: &'static str,
        value: impl ToString,
        expected: impl Into<String>,
    ) -> Self {
        Self::Option {
            option,
            value: value.to_string(),
            expected: expected.into(),
        }
    }
}

/// Returns the reason why a channel does not suit, with the option that names another one.
fn of_channel(option: &str, error: &ChannelError) -> String {
    match error {
        ChannelError::Unit { .. } | ChannelError::Counts { .. } => {
            format!("{error}, or name another channel with `{option}`")
        }
        _ => format!("`{option}`: {error}"),
    }
}

/// Returns the messages of errors, one in each line.
fn lines(errors: &[Error]) -> String {
    let lines: Vec<String> = errors.iter().map(ToString::to_string).collect();
    lines.join("\n")
}

/// Returns the reasons of faults of a key, without the name of the key in front.
fn reasons(faults: &Faults) -> String {
    let reason = |fault: &Fault| {
        let text = fault.message.strip_prefix(fault.key.as_str());
        let text = text.and_then(|text| text.strip_prefix(": "));
        text.unwrap_or(&fault.message).to_owned()
    };
    let reasons: Vec<String> = faults.as_slice().iter().map(reason).collect();
    reasons.join("; ")
}
