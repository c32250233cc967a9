//! Details of errors of computations on recordings.

use super::ErrorDetails;
use impact_harvester_2019::experiment::ExperimentError;
use jounce_data::read::ArraysError;
use jounce_data::recording::{ChannelError, GridError, NoChannel};
use jounce_data::write::WriteError;
use jounce_experiment::fit::FitError;
use jounce_experiment::rig::RigError;
use jounce_experiment::segmentation::SegmentationError;
use jounce_experiment::solution::SolutionError;
use jounce_identification::contact::ContactError;
use jounce_identification::modal::ModalError;
use jounce_identification::response::ResponseError;
use jounce_signal::SignalError;
use jounce_signal::spectral::SpectralError;
use serde_json::{Value, json};

/// Errors of recordings that allow no result.
macro_rules! of_recordings {
    ($($error:ty),+) => {
        $(impl From<&$error> for ErrorDetails {
            fn from(error: &$error) -> Self {
                Self::of("RecordingError", error)
            }
        })+
    };
}

of_recordings!(
    ArraysError,
    GridError,
    SignalError,
    SpectralError,
    SegmentationError,
    ContactError,
    ModalError
);

impl From<&NoChannel> for ErrorDetails {
    fn from(error: &NoChannel) -> Self {
        let details = json!({ "wanted": error.wanted, "channels": error.channels });
        Self {
            details,
            ..Self::new("ArgumentError")
        }
    }
}

impl From<&ChannelError> for ErrorDetails {
    fn from(error: &ChannelError) -> Self {
        match error {
            ChannelError::Missing(error) => error.into(),
            _ => Self::new("ArgumentError"),
        }
    }
}

impl From<&ResponseError> for ErrorDetails {
    fn from(error: &ResponseError) -> Self {
        match error {
            ResponseError::Channel(error) => error.into(),
            error => Self::of("RecordingError", error),
        }
    }
}

impl From<&jounce_data::read::ReadError> for ErrorDetails {
    fn from(error: &jounce_data::read::ReadError) -> Self {
        use jounce_data::read::ReadError::{
            Damaged, Format, Grid, NoChannel, NoRecord, NoTime, Notes, Open, Scratch, StampUnit,
        };
        match error {
            Open { path, reason } | Scratch { path, reason } => Self::of_file(path, Some(reason)),
            Format { path, .. }
            | Damaged { path, .. }
            | NoTime { path, .. }
            | StampUnit { path, .. }
            | NoChannel { path, .. }
            | NoRecord { path }
            | Grid { path, .. }
            | Notes { path, .. } => Self::of_file(path, None),
        }
    }
}

impl From<&WriteError> for ErrorDetails {
    fn from(error: &WriteError) -> Self {
        match error {
            WriteError::NotFinite {
                channel,
                sample,
                value,
            } => {
                let details =
                    json!({ "channel": channel, "sample": sample, "value": value.to_string() });
                Self::new("RecordingError").with(details)
            }
            WriteError::Long {
                channel,
                text,
                length,
                most,
                ..
            } => {
                let details =
                    json!({ "channel": channel, "text": text, "length": length, "most": most });
                Self::new("RecordingError").with(details)
            }
            WriteError::NotAscii {
                channel,
                text,
                letter,
                ..
            } => {
                let details = json!({ "channel": channel, "text": text, "letter": letter });
                Self::new("RecordingError").with(details)
            }
            WriteError::Format { path } => Self::of_file(path, None),
            WriteError::Table(error) => Self::of("FileError", error),
            WriteError::Store(error) => Self::of("FileError", error),
            WriteError::Scratch(_) => Self::new("FileError"),
        }
    }
}

impl From<&RigError> for ErrorDetails {
    fn from(error: &RigError) -> Self {
        match error {
            RigError::Plant(error) => error.into(),
            RigError::Run(error) => error.into(),
            error => Self::new("ArgumentError").with(rig_details(error)),
        }
    }
}

fn rig_details(error: &RigError) -> Value {
    match error {
        RigError::Setting {
            name,
            value,
            allowed,
        } => json!({ "name": name, "value": value, "allowed": allowed }),
        RigError::Undamped { frequency_hz } => json!({ "frequency_hz": frequency_hz }),
        RigError::Long { samples, most } => json!({ "samples": samples, "most": most }),
        RigError::UnknownPoint { point, known } => json!({ "point": point, "known": known }),
        RigError::Bases { base, what } => json!({ "base": base, "what": what }),
        RigError::Recording(error) => serde_json::to_value(error).unwrap_or_default(),
        _ => Value::Null,
    }
}

impl From<&SolutionError> for ErrorDetails {
    fn from(error: &SolutionError) -> Self {
        match error {
            SolutionError::Key(fault) => fault.into(),
            SolutionError::Study(error) => error.into(),
            SolutionError::Plant(error) => error.into(),
            SolutionError::Run(error) => error.into(),
            SolutionError::Orbit(error) => error.into(),
            SolutionError::Lost { starts, .. } => {
                Self::new("ConvergenceError").with(json!({ "starts": starts }))
            }
            SolutionError::UnknownSolution { requested, known } => Self {
                details: json!({ "solution": requested, "known": known }),
                ..Self::new("ArgumentError")
            },
            _ => Self::new("ArgumentError"),
        }
    }
}

impl From<&ExperimentError> for ErrorDetails {
    fn from(error: &ExperimentError) -> Self {
        match error {
            ExperimentError::Reproduce(error) => error.into(),
            _ => Self::new("JounceError"),
        }
    }
}

impl From<&FitError> for ErrorDetails {
    fn from(error: &FitError) -> Self {
        match error {
            FitError::Value(fault) => fault.into(),
            FitError::Structure(error) => error.into(),
            FitError::Open { path, reason } => Self::of_file(path, Some(reason)),
            error => Self::new("FitError").with(fit_details(error)),
        }
    }
}

fn fit_details(error: &FitError) -> Value {
    match error {
        FitError::Features { faults } => json!({ "faults": faults }),
        FitError::Key { key, .. } | FitError::Twice { key } => json!({ "key": key }),
        FitError::Start { key, value } => json!({ "key": key, "value": value }),
        FitError::NoMode { number, modes } => json!({ "mode": number, "modes": modes }),
        FitError::Undamped {
            number,
            damping_ratio,
        } => json!({ "mode": number, "damping_ratio": damping_ratio }),
        FitError::Condition { place, key, .. } => json!({ "place": place, "key": key }),
        FitError::File { place, path, .. } => json!({ "place": place, "path": path }),
        FitError::NoPlace { name, known } => json!({ "name": name, "known": known }),
        FitError::NoPower { mean_power_w } => json!({ "mean_power_w": mean_power_w }),
        FitError::NoJump { key, low, high } => json!({ "key": key, "low": low, "high": high }),
        FitError::NoResiduals {
            name,
            features,
            taken,
        } => json!({ "name": name, "features": features, "taken": taken }),
        FitError::NotConverged { evaluations } | FitError::Stopped { evaluations } => {
            json!({ "evaluations": evaluations })
        }
        _ => Value::Null,
    }
}
