//! Positions of the samples, from stamps, the notes or a rate of the file.

use std::io;
use std::path::Path;

use super::rise::describe_time_candidates;
use super::time_unit::{MissingUnit, seconds};
use crate::read::column::numbers::ColumnNumbers;
use crate::read::column::raw::{Header, Rate, Raw, RawColumn, SAME_RATE, TimeStamps};
use crate::read::{ChannelNotes, Notes, ReadError, SamplePlaces};
use crate::recording::{Grid, Issue, IssueKind, Over, Series, Stamped, typical_step};

/// Sample positions: from stamps, or from the first rate given by the notes or the file.
pub(super) fn sample_places(
    path: &Path,
    raw: &mut Raw,
    time: Option<(usize, &ChannelNotes)>,
    notes: &Notes,
    issues: &mut Vec<Issue>,
) -> Result<SamplePlaces, ReadError> {
    let scratch_error = |reason| ReadError::Scratch {
        path: path.to_owned(),
        reason,
    };
    let count = raw
        .columns
        .first()
        .map_or(0, |column| column.values.count());
    let (rate, start, explicit_stamps) =
        match std::mem::replace(&mut raw.stamps, TimeStamps::Column) {
            TimeStamps::Even { start, step } => return even_places(path, start, step, count),
            TimeStamps::Explicit(stamps) => (None, 0.0, Some(stamps)),
            TimeStamps::Column | TimeStamps::Named => (None, 0.0, None),
            TimeStamps::Rate(rate) => (Some(rate), 0.0, None),
            TimeStamps::FromColumn { rate, .. } => (rate, 0.0, None),
            TimeStamps::Header(Header {
                rate,
                start,
                stamps,
            }) => (Some(rate), start, stamps),
        };
    let stamps = match (explicit_stamps, time) {
        (Some(stamps), _) => stamps,
        // A time column is not a channel, so its numbers may be moved out.
        (None, Some((k, column_notes))) => {
            let time_context = (raw.over, rate.as_ref(), notes.time.is_some());
            let result = seconds(&mut raw.columns[k], column_notes, time_context, issues)
                .map_err(scratch_error)?;
            result.map_err(|MissingUnit { column, step }| ReadError::StampUnit {
                path: path.to_owned(),
                column,
                step,
                notes: Notes::path_of(path),
            })?
        }
        (None, None) => {
            let Some((step, assumption)) = stated_step(rate.as_ref(), start, notes) else {
                return Err(no_time(path, &raw.columns).unwrap_or_else(scratch_error));
            };
            issues.extend(assumption);
            return even_places(path, start, step, count);
        }
    };
    by_stamps(path, stamps, raw.over, (rate.as_ref(), notes), issues)
}

/// Error of a file without times, with what its columns contain instead.
fn no_time(path: &Path, columns: &[RawColumn]) -> io::Result<ReadError> {
    let about = describe_time_candidates(columns)?;
    let named = columns.iter().filter(|column| column.left_out.is_none());
    Ok(ReadError::NoTime {
        path: path.to_owned(),
        columns: named.map(|column| column.name.clone()).collect(),
        about,
        notes: Notes::path_of(path),
    })
}

/// Positions of a uniform grid.
fn even_places(
    path: &Path,
    start: f64,
    step: f64,
    count: usize,
) -> Result<SamplePlaces, ReadError> {
    let grid_error = |grid_error| ReadError::Grid {
        path: path.to_owned(),
        fault: grid_error,
    };
    Grid::even(start, step, count)
        .map(|_| SamplePlaces::Even { start, step, count })
        .map_err(grid_error)
}

/// Reports a rate of the file that differs from another one.
fn differs(rate: Option<&Rate>, rate_hz: f64, description: &str, used: &str) -> Option<Issue> {
    let rate = rate.filter(|rate| rate.differs_from(rate_hz))?;
    let message = format!(
        "{} in the file is {} Hz, {description} {rate_hz:.6} Hz; {used} used",
        rate.source, rate.rate_hz
    );
    Some(Issue::new(IssueKind::HeaderDisagrees, 1, None, message))
}

/// Step given by the notes, else by the file, where no column is a time; with the issue to report.
fn stated_step(rate: Option<&Rate>, start: f64, notes: &Notes) -> Option<(f64, Option<Issue>)> {
    if let Some(rate_hz) = notes.rate_hz {
        return Some((
            1.0 / rate_hz,
            differs(rate, rate_hz, "the notes specify", "the notes are"),
        ));
    }
    let Rate { source, rate_hz } = rate?;
    let message = format!(
        "no column is a time; the samples are placed at {rate_hz} Hz, starting at {start} s, from \
        {source} in the file"
    );
    Some((
        1.0 / rate_hz,
        Some(Issue::new(IssueKind::Assumed, 1, None, message)),
    ))
}

/// Positions from stamps, in s or Hz, checked against rates of the file and the notes.
fn by_stamps(
    path: &Path,
    stamps: ColumnNumbers,
    over: Over,
    (rate, notes): (Option<&Rate>, &Notes),
    issues: &mut Vec<Issue>,
) -> Result<SamplePlaces, ReadError> {
    let scratch_error = |reason| ReadError::Scratch {
        path: path.to_owned(),
        reason,
    };
    let grid_error = |grid_error| ReadError::Grid {
        path: path.to_owned(),
        fault: grid_error,
    };
    let unit = if over == Over::Time { "s" } else { "Hz" };
    let stated_step = notes
        .rate_hz
        .or(rate.map(|rate| rate.rate_hz))
        .map(|rate_hz| 1.0 / rate_hz);
    let (result, sample_places) = match Stamped::of(&stamps, stated_step, unit)
        .map_err(scratch_error)?
        .map_err(grid_error)?
    {
        Stamped::Even {
            start,
            step,
            issues: of_stamps,
        } => {
            issues.extend(of_stamps);
            (1.0 / step, even_places(path, start, step, stamps.count())?)
        }
        Stamped::Uneven(of_stamps) => {
            issues.extend(of_stamps);
            let rate = 1.0 / typical_step(&stamps).map_err(scratch_error)?;
            (rate, SamplePlaces::Stamped { stamps, rate })
        }
    };
    issues.extend(differs(rate, result, "the stamps give", "the stamps are"));
    if let Some(rate_hz) = notes
        .rate_hz
        .filter(|rate_hz| (rate_hz / result - 1.0).abs() > SAME_RATE)
    {
        let message = format!(
            "the notes specify {rate_hz} Hz, the stamps give {result:.6} Hz; the stamps \
                are used"
        );
        issues.push(Issue::new(IssueKind::HeaderDisagrees, 1, None, message));
    }
    Ok(sample_places)
}
