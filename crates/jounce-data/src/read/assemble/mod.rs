//! Builds a recording from raw columns and notes: names, time, SI units, data-quality issues.

pub(super) mod time;

use std::io;
use std::path::Path;

use self::time::{MissingUnit, is_counter, is_time_column, time_column};
use crate::read::column::numbers::ColumnNumbers;
use crate::read::column::raw::{Header, Rate, Raw, RawColumn, SAME_RATE, TimeStamps};
use crate::read::heading::decibels::Decibels;
use crate::read::summary::{ChannelSummary, RecordingSummary, SamplePlaces};
use crate::read::{ChannelNotes, Notes, ReadError};
use crate::recording::{
    Grid, Issue, IssueKind, Over, Quantity, Series, Sizes, Stamped, Unit, inspect_samples,
    may_be_counts, sizes_with, typical_step,
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
    // A property of a channel given in the notes is not an assumption.
    let has_notes = |name: &String| {
        columns
            .iter()
            .zip(&column_notes)
            .any(|(column, column_notes)| {
                column == name && (column_notes.unit.is_some() || column_notes.name.is_some())
            })
    };
    issues.retain(|issue| {
        issue.kind != IssueKind::Assumed || !issue.channel.as_ref().is_some_and(has_notes)
    });
    if notes.over_frequency {
        raw.over = Over::Frequency;
    }
    let by_column = match &raw.stamps {
        TimeStamps::Column
        | TimeStamps::Named
        | TimeStamps::Rate(_)
        | TimeStamps::FromColumn { .. } => true,
        TimeStamps::Header(header) => header.stamps.is_none(),
        TimeStamps::Even { .. } | TimeStamps::Explicit(_) => false,
    };
    let time = if by_column {
        time_column(&mut raw, &column_notes, notes).map_err(scratch_error)?
    } else {
        None
    };
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
    let left_out = column_notes
        .iter()
        .any(|column_notes| column_notes.left_out);
    let mut channels = Vec::new();
    for (k, (column, column_notes)) in raw.columns.into_iter().zip(column_notes).enumerate() {
        if Some(k) == time || column_notes.left_out {
            continue;
        }
        match no_channel(&column, &column_notes, by_column).map_err(scratch_error)? {
            None => channels.push(channel_summary(column, column_notes, &mut issues)),
            Some(why) if why.is_empty() => {}
            Some(why) => issues.push(
                Issue::new(
                    IssueKind::Skipped,
                    1,
                    None,
                    format!("{why}; the column is not a channel"),
                )
                .of(&column.name),
            ),
        }
    }
    if channels.is_empty() && !left_out {
        return Err(ReadError::NoChannel {
            path: path.to_owned(),
            issues,
        });
    }
    for channel in &mut channels {
        let counts = may_be_counts(channel.quantity, channel.imaginary.is_some());
        let (result, sizes) = inspect_samples(&channel.values, counts).map_err(scratch_error)?;
        issues.extend(result.into_iter().map(|issue| issue.of(&channel.name)));
        let equal = if sizes.peak > 0.0 {
            time::describe_equal(&channel.values, &sample_places).map_err(scratch_error)?
        } else {
            None
        };
        issues.extend(equal.map(|message| {
            Issue::new(IssueKind::EqualsTime, channel.values.count(), None, message)
                .of(&channel.name)
        }));
        channel.sizes = sizes_with(sizes, &channel.values, channel.imaginary.as_ref())
            .map_err(scratch_error)?;
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
/// samples, or an unused time. A column named in the notes is always a channel.
fn no_channel(
    column: &RawColumn,
    column_notes: &ChannelNotes,
    by_column: bool,
) -> io::Result<Option<String>> {
    if column.left_out.is_some() || *column_notes != ChannelNotes::default() || !by_column {
        return Ok(column.left_out.clone());
    }
    if is_counter(column)? {
        return Ok(Some("it counts the samples".to_owned()));
    }
    let rises = is_time_column(column) && time::ascends(&column.values)?;
    Ok(rises
        .then(|| "it is a time that is not used, because the time comes from elsewhere".to_owned()))
}

/// Sample positions: from stamps, or from the first rate given by the notes or the file.
fn sample_places(
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
            let result = time::seconds(&mut raw.columns[k], column_notes, time_context, issues)
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
                let columns = raw
                    .columns
                    .iter()
                    .filter(|column| column.left_out.is_none())
                    .map(|column| column.name.clone())
                    .collect();
                let about = time::describe_time_candidates(&raw.columns).map_err(scratch_error)?;
                return Err(ReadError::NoTime {
                    path: path.to_owned(),
                    columns,
                    about,
                    notes: Notes::path_of(path),
                });
            };
            issues.extend(assumption);
            return even_places(path, start, step, count);
        }
    };
    by_stamps(path, stamps, raw.over, (rate.as_ref(), notes), issues)
}

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

/// Column in SI units, before inspection of its samples.
pub(in crate::read) fn channel_summary(
    mut column: RawColumn,
    column_notes: ChannelNotes,
    issues: &mut Vec<Issue>,
) -> ChannelSummary {
    if let Some(levels) = Decibels::read(&column.unit) {
        issues.push(column.convert_levels(levels));
    }
    let name = column_notes.name.unwrap_or(column.name);
    let unit_text = column_notes.unit.unwrap_or(column.unit);
    let scale = column_notes.scale.unwrap_or(1.0);
    let new_issue = |kind, count, message: String| Issue::new(kind, count, None, message).of(&name);
    if !unit_text.is_ascii() {
        issues.push(new_issue(
            IssueKind::NonAsciiUnit,
            1,
            format!("the unit {unit_text:?} contains characters outside ASCII"),
        ));
    }
    let unit = Unit::read(&unit_text);
    let factor = scale * unit.as_ref().map_or(1.0, |unit| unit.factor);
    if let Some(unit) = unit.as_ref().filter(|unit| unit.converts()) {
        let message = format!(
            "values in {unit_text} are multiplied by {} to give {}",
            unit.factor, unit.si
        );
        issues.push(new_issue(
            IssueKind::Converted,
            column.values.count(),
            message,
        ));
    }
    if unit.is_none() && !unit_text.trim().is_empty() && unit_text.trim() != "NONE" {
        issues.push(new_issue(
            IssueKind::UnknownUnit,
            1,
            format!("the unit {unit_text:?} is not known; values are unchanged"),
        ));
    }
    let (quantity, unit) = unit.map_or((Quantity::Unknown, unit_text.clone()), |unit| {
        (unit.quantity, unit.si.into_owned())
    });
    let RawColumn {
        mut values,
        mut imaginary,
        ..
    } = column;
    values.scale(factor);
    imaginary
        .iter_mut()
        .for_each(|numbers| numbers.scale(factor));
    let (place, direction) = (
        column_notes.place.unwrap_or(column.place),
        column_notes.direction.unwrap_or(column.direction),
    );
    let reference = column_notes.reference.unwrap_or(column.reference);
    let sizes = Sizes {
        rms: f64::NAN,
        peak: f64::NAN,
        mean: f64::NAN,
    };
    ChannelSummary {
        name,
        quantity,
        unit,
        place,
        direction,
        reference,
        sizes,
        values,
        imaginary,
    }
}
