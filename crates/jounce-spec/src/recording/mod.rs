//! Recording of a drive: one evenly sampled channel of a file, in the SI unit of the drive.

mod driving_channel;
mod error;
mod read;

use std::sync::Arc;

use jounce_data::recording::{
    Channel, Grid, Issue, IssueKind, Over, Quantity, Recording as Measured,
};

pub use driving_channel::driving_channel;
pub use error::RecordingError;

use crate::{DriveKind, DriveSignal, Spec};

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
        let step_s = even_step_s(measured, channel, quantity)?;
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
            step_s,
            values,
            mean,
            issues,
        })
    }

    /// Returns the time from the first sample to the last, s.
    pub fn duration_s(&self) -> f64 {
        self.step_s * (self.values.len() - 1) as f64
    }
}

impl Spec {
    /// Returns the data-quality issues of the recordings of the drives, with the name of the drive.
    pub fn issues(&self) -> impl Iterator<Item = (&str, &Issue)> {
        self.drive.iter().flat_map(|(name, drive)| {
            let issues = match &drive.signal {
                DriveSignal::Recording {
                    record: Some(record),
                    ..
                } => &record.issues[..],
                _ => &[],
            };
            issues.iter().map(move |issue| (name.as_str(), issue))
        })
    }

    /// Returns the drives whose recordings go on after the run, with the time of the last sample, s.
    pub fn cut_recordings(&self) -> impl Iterator<Item = (&str, f64)> {
        self.drive.iter().filter_map(|(name, drive)| {
            let DriveSignal::Recording {
                start_s,
                record: Some(record),
                ..
            } = &drive.signal
            else {
                return None;
            };
            let ends_s = start_s + record.duration_s();
            (ends_s - self.run.duration_s >= record.step_s).then_some((name.as_str(), ends_s))
        })
    }
}

/// Step of a recording over time that has enough samples, all of them finite, of a channel of the
/// quantity.
fn even_step_s(
    measured: &Measured,
    channel: &Channel,
    quantity: Quantity,
) -> Result<f64, RecordingError> {
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
    Ok(*step)
}
