//! Recording of a drive: one evenly sampled channel of a file, in the SI unit of the drive.

use std::path::Path;
use std::sync::Arc;

use jounce_data::read::{self, Notes, ReadError, RecordingSummary};
use jounce_data::recording::{
    Channel, ChannelHead, Grid, Issue, IssueKind, NoChannel, Over, Quantity, Recording as Measured,
    Unit, find_channel,
};

use super::{Drive, DriveKind, DriveSignal};

/// Largest relative difference between the sampling rate of a file and that of the spec.
const MAX_RATE_ERROR: f64 = 1e-3;

/// Largest residual of a constant channel due to roundoff, relative to its mean.
const CONSTANT_ROUNDOFF: f64 = 1e-12;

/// Evenly sampled signal.
#[derive(Debug, Clone, PartialEq)]
pub struct Recording {
    /// Time between samples, s.
    pub step_s: f64,
    /// Values in SI, at least two. If the channel has no unit or a unit of another quantity, the
    /// drive defines their unit.
    pub values: Arc<[f64]>,
    /// Mean of the channel in the same unit, retained or removed.
    pub mean: f64,
    /// Data-quality issues of the recording and this channel, and the corrections applied to them.
    pub issues: Vec<Issue>,
}

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

impl DriveKind {
    /// Returns the quantity that a channel must measure to be the signal of the drive.
    pub fn measured(self) -> Quantity {
        match self {
            Self::Force => Quantity::Force,
            Self::BaseAcceleration => Quantity::Acceleration,
            Self::BaseDisplacement => Quantity::Displacement,
        }
    }

    /// True if the mean of a recording is part of the drive. The mean of an accelerometer is
    /// gravity and offset; the mean of a force is a load.
    pub fn keeps_mean(self) -> bool {
        self == Self::Force
    }
}

/// Returns the number of the driving channel: the channel with the given name or number. Without a
/// name it is the only varying channel of the quantity, or the only varying channel without a unit.
///
/// # Errors
/// The named channel does not exist, or no channel fits, or several do.
pub fn driving_channel(
    (recording, heads, issues): (&str, &[ChannelHead<'_>], &[Issue]),
    channel: Option<&str>,
    quantity: Quantity,
) -> Result<usize, RecordingError> {
    if let Some(channel) = channel {
        return Ok(find_channel(recording, heads, channel)?);
    }
    let is_constant = |name: &str| {
        issues
            .iter()
            .any(|f| f.kind == IssueKind::Constant && f.channel.as_deref() == Some(name))
    };
    let moves = |k: &usize| !is_constant(heads[*k].name);
    let measuring: Vec<usize> = (0..heads.len())
        .filter(|k| heads[*k].quantity == quantity)
        .filter(moves)
        .collect();
    let silent = || {
        (0..heads.len())
            .filter(|k| heads[*k].may_be(quantity))
            .filter(moves)
            .collect()
    };
    let fitting = if measuring.is_empty() {
        silent()
    } else {
        measuring
    };
    let name = |head: &ChannelHead<'_>| {
        if head.has_unit() {
            format!("{} ({})", head.name, head.unit)
        } else {
            head.name.to_owned()
        }
    };
    match fitting[..] {
        [only] => Ok(only),
        [] => Err(RecordingError::None {
            channels: heads.iter().map(name).collect(),
            wanted: quantity.si_unit(),
        }),
        _ => Err(RecordingError::Several {
            channels: fitting.iter().map(|k| name(&heads[*k])).collect(),
        }),
    }
}

impl Recording {
    /// Returns an evenly sampled channel as the signal of a drive that multiplies it by `scale`;
    /// the mean is removed unless `keep_mean`.
    ///
    /// # Errors
    /// [`RecordingError`].
    pub fn of(
        measured: &Measured,
        channel: &str,
        kind: DriveKind,
        (scale, keep_mean): (f64, bool),
    ) -> Result<Self, RecordingError> {
        let channel = measured.channel(channel)?;
        let quantity = kind.measured();
        if !channel.head().may_be(quantity) {
            let (channel, unit) = (channel.name.clone(), channel.unit.clone());
            return Err(RecordingError::Unit {
                channel,
                unit,
                wanted: quantity.si_unit(),
            });
        }
        let (Grid::Even { step, count, .. }, Over::Time) = (&measured.grid, measured.over) else {
            return Err(RecordingError::NotEven {
                recording: measured.name.clone(),
            });
        };
        if *count < 2 {
            return Err(RecordingError::Few {
                recording: measured.name.clone(),
            });
        }
        if channel.values.iter().any(|value| !value.is_finite()) {
            return Err(RecordingError::NotANumber {
                channel: channel.name.clone(),
            });
        }
        let mean = channel.values.iter().sum::<f64>() / channel.values.len() as f64;
        let offset = if keep_mean { 0.0 } else { mean };
        let values: Arc<[f64]> = channel.values.iter().map(|value| value - offset).collect();
        let largest = values
            .iter()
            .fold(0.0, |largest: f64, value| largest.max(value.abs()));
        if largest <= CONSTANT_ROUNDOFF * mean.abs() {
            return Err(RecordingError::Still {
                channel: channel.name.clone(),
                mean,
                unit: quantity.si_unit(),
            });
        }
        let of_another = |name: &String| {
            *name != channel.name && measured.channels.iter().any(|other| other.name == *name)
        };
        let belongs = |issue: &&Issue| !issue.channel.as_ref().is_some_and(of_another);
        let mut issues: Vec<Issue> = measured.issues.iter().filter(belongs).cloned().collect();
        if offset.abs() > CONSTANT_ROUNDOFF * largest {
            let about = format!(
                "its mean of {:.5} {} is removed",
                scale * mean,
                quantity.si_unit()
            );
            issues.push(
                Issue::new(IssueKind::MeanRemoved, values.len(), None, about).of(&channel.name),
            );
        }
        Ok(Self {
            step_s: *step,
            values,
            mean,
            issues,
        })
    }

    /// Reads the file of a drive.
    ///
    /// # Errors
    /// The faulty key, and one sentence with the file and a remedy.
    pub(super) fn read(path: &Path, drive: &Drive) -> Result<Self, (&'static str, String)> {
        let DriveSignal::Recording {
            channel,
            unit,
            scale,
            keep_mean,
            sample_rate_hz,
            ..
        } = &drive.signal
        else {
            return Err(("signal", "the signal is not a recording".to_owned()));
        };
        let path_text = path.display();
        let of_file = |error: &dyn std::fmt::Display| ("file", format!("{path_text}: {error}"));
        let quantity = drive.kind.measured();
        let mut survey = survey(path, *sample_rate_hz).map_err(|error| match error {
            ReadError::NoTime { .. } | ReadError::StampUnit { .. } => (
                "file",
                format!("{error}; or give the drive a `sample_rate`"),
            ),
            error => ("file", error.to_string()),
        })?;
        let number = driving_channel(
            (&survey.name, &survey.heads(), &survey.issues),
            channel.as_deref(),
            quantity,
        )
        .map_err(|error| of_file(&error))?;
        if let Some(requested_hz) = sample_rate_hz
            .filter(|requested_hz| (requested_hz / survey.rate() - 1.0).abs() > MAX_RATE_ERROR)
        {
            let message = format!(
                "{path_text} is sampled at {:.6} Hz, not at `sample_rate` = {requested_hz} Hz; correct one of them",
                survey.rate()
            );
            return Err(("sample_rate", message));
        }
        let head = survey.channels[number].head();
        let assumed = if unit.is_none() {
            head.assumed_unit_issue(quantity)
        } else {
            None
        };
        survey.issues.extend(assumed);
        let measured = survey
            .into_recording_of(&[number])
            .map_err(|error| of_file(&error))?;
        let mut measured = measured.into_even().map_err(|error| of_file(&error))?;
        let channel = &mut measured.channels[0];
        if let Some(unit) = unit {
            in_unit(channel, unit, quantity).map_err(|message| ("unit", message))?;
            measured
                .issues
                .retain(|issue| issue.kind != IssueKind::RawCounts);
        }
        let channel = &measured.channels[0];
        let (name, keep_mean) = (
            channel.name.clone(),
            keep_mean.unwrap_or(drive.kind.keeps_mean()),
        );
        Self::of(&measured, &name, drive.kind, (*scale, keep_mean)).map_err(|error| of_file(&error))
    }

    /// Returns the time from the first sample to the last, s.
    pub fn duration_s(&self) -> f64 {
        self.step_s * (self.values.len() - 1) as f64
    }
}

/// Reads the first time-domain recording of a file, at the given rate if neither the file nor its
/// notes contain usable times.
fn survey(path: &Path, sample_rate_hz: Option<f64>) -> Result<RecordingSummary, ReadError> {
    match (read::record_summary(path), sample_rate_hz) {
        (
            Err(ReadError::NoTime { .. } | ReadError::StampUnit { .. } | ReadError::Grid { .. }),
            Some(rate_hz),
        ) => read::record_summary_with_notes(
            path,
            &Notes {
                rate_hz: Some(rate_hz),
                ..Notes::for_file(path)?
            },
        ),
        (found, _) => found,
    }
}

/// Converts the values of a channel from a unit that its file does not contain.
fn in_unit(channel: &mut Channel, unit: &str, quantity: Quantity) -> Result<(), String> {
    let known = Unit::read(unit).filter(|known| known.quantity == quantity);
    let known = known.ok_or_else(|| {
        format!(
            "`unit` = {unit:?} does not convert to {}",
            quantity.si_unit()
        )
    })?;
    if channel.quantity == quantity {
        return Err(RecordingError::UnitTwice {
            channel: channel.name.clone(),
            unit: channel.unit.clone(),
        }
        .to_string());
    }
    channel
        .values
        .iter_mut()
        .for_each(|value| *value *= known.factor);
    (channel.quantity, channel.unit) = (quantity, quantity.si_unit().to_owned());
    Ok(())
}
