//! Reads the recording of a drive from its file.

use std::path::Path;

use jounce_data::read::{self, Notes, ReadError, RecordingSummary};
use jounce_data::recording::{Channel, IssueKind, Quantity, Unit};

use super::{Recording, RecordingError, driving_channel};
use crate::{Drive, DriveSignal};

/// Largest relative difference between the sampling rate of a file and that of the spec.
const MAX_RATE_ERROR: f64 = 1e-3;

/// The faulty key of a drive, and one sentence with a remedy.
type KeyFault = (&'static str, String);

impl Recording {
    /// Reads the file of a drive.
    ///
    /// # Errors
    /// The faulty key, and one sentence with the file and a remedy.
    pub(crate) fn read(path: &Path, drive: &Drive) -> Result<Self, KeyFault> {
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
        let mut summary = summary(path, *sample_rate_hz).map_err(|error| match error {
            ReadError::NoTime { .. } | ReadError::StampUnit { .. } => (
                "file",
                format!("{error}; or give the drive a `sample_rate`"),
            ),
            error => ("file", error.to_string()),
        })?;
        let number = driving_channel(
            (&summary.name, &summary.heads(), &summary.issues),
            channel.as_deref(),
            quantity,
        )
        .map_err(|error| of_file(&error))?;
        check_rate(&summary, path, *sample_rate_hz)?;
        let head = summary.channels[number].head();
        let assumed = if unit.is_none() {
            head.assumed_unit_issue(quantity)
        } else {
            None
        };
        summary.issues.extend(assumed);
        let measured = summary
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
}

/// Refuses a rate of the spec that differs from the rate of the file.
fn check_rate(
    summary: &RecordingSummary,
    path: &Path,
    requested_hz: Option<f64>,
) -> Result<(), KeyFault> {
    let differs = |rate_hz: &f64| (rate_hz / summary.rate() - 1.0).abs() > MAX_RATE_ERROR;
    let Some(requested_hz) = requested_hz.filter(differs) else {
        return Ok(());
    };
    let message = format!(
        "{} is sampled at {:.6} Hz, not at `sample_rate` = {requested_hz} Hz; correct one of them",
        path.display(),
        summary.rate()
    );
    Err(("sample_rate", message))
}

/// Reads the first time-domain recording of a file, at the given rate if neither the file nor its
/// notes contain usable times.
fn summary(path: &Path, sample_rate_hz: Option<f64>) -> Result<RecordingSummary, ReadError> {
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
