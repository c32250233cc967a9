//! Builds a recording from raw columns and notes: names, time, SI units, data-quality issues.

mod channel;
pub(super) mod rise;
mod sample_places;
pub(super) mod time;
mod time_unit;

pub(super) use channel::channel_summary;

use std::io;
use std::path::Path;

use self::rise::{ascends, is_counter, rounded, uniform_step};
use self::sample_places::sample_places;
use self::time::{describe_equal, is_time_column, time_column};
use crate::read::column::raw::{Raw, RawColumn};
use crate::read::{ChannelNotes, ChannelSummary, Notes, ReadError, RecordingSummary, SamplePlaces};
use crate::recording::{
    Issue, IssueKind, Over, Series as _, Unit, inspect_samples, may_be_counts, sizes_with,
};

/// Builds the recording of a data set.
pub(in crate::read) fn recording(
    path: &Path,
    name: String,
    mut raw: Raw,
    notes: &Notes,
) -> Result<RecordingSummary, ReadError> {
    raw.columns = pair_columns(raw.columns);
    let columns: Vec<String> = raw
        .columns
        .iter()
        .map(|column| column.name.clone())
        .collect();
    let column_notes: Vec<ChannelNotes> = columns
        .iter()
        .enumerate()
        .map(|(k, name)| notes.for_channel(name, k + 1))
        .collect();
    check_notes(path, notes, &columns)?;
    let scratch_error = |reason| ReadError::Scratch {
        path: path.to_owned(),
        reason,
    };
    let mut issues = std::mem::take(&mut raw.issues);
    drop_noted_assumptions(&mut issues, &columns, &column_notes);
    if notes.over_frequency {
        raw.over = Over::Frequency;
    }
    let by_column = raw.stamps.may_be_in_a_column();
    let time = time_column(&mut raw, &column_notes, notes).map_err(scratch_error)?;
    let time_notes = time
        .and_then(|k| column_notes.get(k))
        .cloned()
        .unwrap_or_default();
    let sample_places = sample_places(
        path,
        &mut raw,
        time.map(|k| (k, &time_notes)),
        notes,
        &mut issues,
    )?;
    let left_out = column_notes.iter().any(|of_column| of_column.left_out);
    let noted = raw.columns.into_iter().zip(column_notes);
    let rate_hz = by_column.then_some(notes.rate_hz);
    let mut channels = channels(noted, time, rate_hz, &mut issues).map_err(scratch_error)?;
    if channels.is_empty() && !left_out {
        return Err(ReadError::NoChannel {
            path: path.to_owned(),
            issues,
        });
    }
    for channel in &mut channels {
        inspect_channel(channel, &sample_places, &mut issues).map_err(scratch_error)?;
    }
    Ok(RecordingSummary {
        name,
        over: raw.over,
        places: sample_places,
        channels,
        issues,
    })
}

/// Joins a column `NAME.im` that follows `NAME.re` in the same unit to it, as the imaginary part of
/// a complex channel.
fn pair_columns(columns: Vec<RawColumn>) -> Vec<RawColumn> {
    let mut columns_out: Vec<RawColumn> = Vec::new();
    for column in columns {
        let is_real = |previous: &&mut RawColumn| {
            let stems = previous
                .name
                .strip_suffix(".re")
                .zip(column.name.strip_suffix(".im"));
            stems.is_some_and(|(re, im)| re == im)
                && previous.unit == column.unit
                && previous.imaginary.is_none()
                && column.imaginary.is_none()
        };
        match columns_out.last_mut().filter(is_real) {
            Some(real) => {
                real.name.truncate(real.name.len() - ".re".len());
                real.imaginary = Some(column.values);
            }
            None => columns_out.push(column),
        }
    }
    columns_out
}

/// Refuses notes that name a column which does not exist.
fn check_notes(path: &Path, notes: &Notes, columns: &[String]) -> Result<(), ReadError> {
    let exists = |key: &String| {
        columns.contains(key)
            || key
                .parse::<usize>()
                .is_ok_and(|number| (1..=columns.len()).contains(&number))
    };
    let missing_keys = notes
        .channels
        .keys()
        .chain(&notes.time)
        .filter(|key| !exists(key));
    let faults: Vec<String> = missing_keys
        .map(|key| {
            format!(
                "there is no column {key:?}; the columns are {}",
                columns.join(", ")
            )
        })
        .collect();
    if faults.is_empty() {
        Ok(())
    } else {
        Err(ReadError::Notes {
            path: Notes::path_of(path),
            faults,
        })
    }
}

/// Returns why a column other than the time is not a channel: an index column, a count of the
/// samples, or an unused time. A column named in the notes is always a channel. `rate_hz` is the
/// rate of the notes; `None` where no column can be the time.
fn no_channel(
    column: &RawColumn,
    column_notes: &ChannelNotes,
    rate_hz: Option<Option<f64>>,
) -> io::Result<Option<String>> {
    let is_noted = *column_notes != ChannelNotes::default();
    let Some(rate_hz) = rate_hz.filter(|_| column.left_out.is_none() && !is_noted) else {
        return Ok(column.left_out.clone());
    };
    if is_counter(column)? {
        return Ok(Some("it counts the samples".to_owned()));
    }
    if !is_time_column(column) || !ascends(&column.values)? {
        return Ok(None);
    }
    let unit_s = Unit::read(&column.unit).map_or(1.0, |unit| unit.factor);
    let own_hz = uniform_step(&column.values)?.map(|step| rounded(1.0 / (step * unit_s)));
    Ok(Some(match (rate_hz, own_hz) {
        (Some(rate_hz), Some(own_hz)) => {
            format!(
                "its times, which give {own_hz} Hz, are replaced by the given rate of {rate_hz} Hz"
            )
        }
        (Some(rate_hz), None) => {
            format!("its times are replaced by the given rate of {rate_hz} Hz")
        }
        (None, _) => {
            "it is a time that is not used, because the time comes from elsewhere".to_owned()
        }
    }))
}

/// Removes assumptions about channels whose unit or name the notes give.
fn drop_noted_assumptions(
    issues: &mut Vec<Issue>,
    columns: &[String],
    column_notes: &[ChannelNotes],
) {
    let has_notes = |name: &String| {
        columns
            .iter()
            .zip(column_notes)
            .any(|(column, column_notes)| {
                column == name && (column_notes.unit.is_some() || column_notes.name.is_some())
            })
    };
    issues.retain(|issue| {
        issue.kind != IssueKind::Assumed || !issue.channel.as_ref().is_some_and(has_notes)
    });
}

/// Channels of all columns except the time and those left out, with the issues of each.
fn channels(
    columns: impl Iterator<Item = (RawColumn, ChannelNotes)>,
    time: Option<usize>,
    rate_hz: Option<Option<f64>>,
    issues: &mut Vec<Issue>,
) -> io::Result<Vec<ChannelSummary>> {
    let mut channels = Vec::new();
    for (k, (column, column_notes)) in columns.enumerate() {
        if Some(k) == time || column_notes.left_out {
            continue;
        }
        match no_channel(&column, &column_notes, rate_hz)? {
            None => channels.push(channel_summary(column, column_notes, issues)),
            Some(why) if why.is_empty() => {}
            Some(why) => {
                let message = format!("{why}; the column is not a channel");
                issues.push(Issue::new(IssueKind::Skipped, 1, None, message).of(&column.name));
            }
        }
    }
    Ok(channels)
}

/// Determines the sizes of a channel and reports its data-quality issues.
fn inspect_channel(
    channel: &mut ChannelSummary,
    places: &SamplePlaces,
    issues: &mut Vec<Issue>,
) -> io::Result<()> {
    let counts = may_be_counts(channel.quantity, channel.imaginary.is_some());
    let (result, sizes) = inspect_samples(&channel.values, counts)?;
    issues.extend(result.into_iter().map(|issue| issue.of(&channel.name)));
    let equal = if sizes.peak > 0.0 {
        describe_equal(&channel.values, places)?
    } else {
        None
    };
    issues.extend(equal.map(|message| {
        Issue::new(IssueKind::EqualsTime, channel.values.count(), None, message).of(&channel.name)
    }));
    channel.sizes = sizes_with(sizes, &channel.values, channel.imaginary.as_ref())?;
    Ok(())
}
