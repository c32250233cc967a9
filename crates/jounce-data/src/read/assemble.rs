//! Builds a recording from raw columns and notes: names, time, SI units, data-quality issues.

use std::io;
use std::path::Path;

use super::decibels::Decibels;
use super::numbers::ColumnNumbers;
use super::raw::{Header, Rate, Raw, RawColumn, SAME_RATE, TimeStamps};
use super::summary::{ChannelSummary, RecordingSummary, SamplePlaces};
use super::time::{self, MissingUnit, is_counter, is_time_column, time_column};
use super::{ChannelNotes, Notes, ReadError};
use crate::recording::{
    Grid, Issue, IssueKind, Over, Quantity, Series, Sizes, Stamped, Unit, inspected, may_be_counts,
    sizes_with, usual_step,
};

/// Builds the recording of a data set.
pub(super) fn recording(
    path: &Path,
    name: String,
    mut raw: Raw,
    notes: &Notes,
) -> Result<RecordingSummary, ReadError> {
    raw.columns = paired(raw.columns);
    let columns: Vec<String> = raw
        .columns
        .iter()
        .map(|column| column.name.clone())
        .collect();
    let said: Vec<ChannelNotes> = columns
        .iter()
        .enumerate()
        .map(|(k, name)| notes.of(name, k + 1))
        .collect();
    check_notes(path, notes, &columns)?;
    let lost = |reason| ReadError::Scratch {
        path: path.to_owned(),
        reason,
    };
    let mut findings = std::mem::take(&mut raw.findings);
    // A property of a channel given in the notes is not an assumption.
    let is_told = |name: &String| {
        columns
            .iter()
            .zip(&said)
            .any(|(column, said)| column == name && (said.unit.is_some() || said.name.is_some()))
    };
    findings.retain(|finding| {
        finding.kind != IssueKind::Assumed || !finding.channel.as_ref().is_some_and(is_told)
    });
    if notes.over_frequency {
        raw.over = Over::Frequency;
    }
    let by_column = match &raw.stamps {
        TimeStamps::Column | TimeStamps::Named | TimeStamps::Rate(_) | TimeStamps::Of { .. } => {
            true
        }
        TimeStamps::Header(header) => header.stamps.is_none(),
        TimeStamps::Even { .. } | TimeStamps::Given(_) => false,
    };
    let time = if by_column {
        time_column(&mut raw, &said, notes).map_err(lost)?
    } else {
        None
    };
    let time_said = time.and_then(|k| said.get(k)).cloned().unwrap_or_default();
    let places = places(
        path,
        &mut raw,
        time.map(|k| (k, &time_said)),
        notes,
        &mut findings,
    )?;
    let left_out = said.iter().any(|said| said.left_out);
    let mut channels = Vec::new();
    for (k, (column, said)) in raw.columns.into_iter().zip(said).enumerate() {
        if Some(k) == time || said.left_out {
            continue;
        }
        match no_channel(&column, &said, by_column).map_err(lost)? {
            None => channels.push(settled(column, said, &mut findings)),
            Some(why) if why.is_empty() => {}
            Some(why) => findings.push(
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
            findings,
        });
    }
    for channel in &mut channels {
        let counts = may_be_counts(channel.quantity, channel.imaginary.is_some());
        let (found, sizes) = inspected(&channel.values, counts).map_err(lost)?;
        findings.extend(found.into_iter().map(|finding| finding.of(&channel.name)));
        let equal = if sizes.peak > 0.0 {
            time::equals(&channel.values, &places).map_err(lost)?
        } else {
            None
        };
        findings.extend(equal.map(|about| {
            Issue::new(IssueKind::EqualsTime, channel.values.count(), None, about).of(&channel.name)
        }));
        channel.sizes =
            sizes_with(sizes, &channel.values, channel.imaginary.as_ref()).map_err(lost)?;
    }
    Ok(RecordingSummary {
        name,
        over: raw.over,
        places,
        channels,
        findings,
    })
}

/// Joins a column `NAME.im` that follows `NAME.re` in the same unit to it, as the imaginary part of
/// a complex channel.
fn paired(columns: Vec<RawColumn>) -> Vec<RawColumn> {
    let mut paired: Vec<RawColumn> = Vec::new();
    for column in columns {
        let is_real = |before: &&mut RawColumn| {
            let stems = before
                .name
                .strip_suffix(".re")
                .zip(column.name.strip_suffix(".im"));
            stems.is_some_and(|(re, im)| re == im)
                && before.unit == column.unit
                && before.imaginary.is_none()
                && column.imaginary.is_none()
        };
        match paired.last_mut().filter(is_real) {
            Some(real) => {
                real.name.truncate(real.name.len() - ".re".len());
                real.imaginary = Some(column.values);
            }
            None => paired.push(column),
        }
    }
    paired
}

/// Refuses notes that name a column which does not exist.
fn check_notes(path: &Path, notes: &Notes, columns: &[String]) -> Result<(), ReadError> {
    let there = |key: &String| {
        columns.contains(key)
            || key
                .parse::<usize>()
                .is_ok_and(|number| (1..=columns.len()).contains(&number))
    };
    let named = notes
        .channels
        .keys()
        .chain(&notes.time)
        .filter(|key| !there(key));
    let faults: Vec<String> = named
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
    said: &ChannelNotes,
    by_column: bool,
) -> io::Result<Option<String>> {
    if column.left_out.is_some() || *said != ChannelNotes::default() || !by_column {
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
fn places(
    path: &Path,
    raw: &mut Raw,
    time: Option<(usize, &ChannelNotes)>,
    notes: &Notes,
    findings: &mut Vec<Issue>,
) -> Result<SamplePlaces, ReadError> {
    let lost = |reason| ReadError::Scratch {
        path: path.to_owned(),
        reason,
    };
    let count = raw
        .columns
        .first()
        .map_or(0, |column| column.values.count());
    let (rate, start, given) = match std::mem::replace(&mut raw.stamps, TimeStamps::Column) {
        TimeStamps::Even { start, step } => return even(path, start, step, count),
        TimeStamps::Given(stamps) => (None, 0.0, Some(stamps)),
        TimeStamps::Column | TimeStamps::Named => (None, 0.0, None),
        TimeStamps::Rate(rate) => (Some(rate), 0.0, None),
        TimeStamps::Of { rate, .. } => (rate, 0.0, None),
        TimeStamps::Header(Header {
            rate,
            start,
            stamps,
        }) => (Some(rate), start, stamps),
    };
    let stamps = match (given, time) {
        (Some(stamps), _) => stamps,
        // A time column is not a channel, so its numbers may be moved out.
        (None, Some((k, said))) => {
            let named = (raw.over, rate.as_ref(), notes.time.is_some());
            let found = time::seconds(&mut raw.columns[k], said, named, findings).map_err(lost)?;
            found.map_err(|MissingUnit { column, step }| ReadError::StampUnit {
                path: path.to_owned(),
                column,
                step,
                notes: Notes::path_of(path),
            })?
        }
        (None, None) => {
            let Some((step, about)) = told_step(rate.as_ref(), start, notes) else {
                let columns = raw
                    .columns
                    .iter()
                    .filter(|column| column.left_out.is_none())
                    .map(|column| column.name.clone())
                    .collect();
                let about = time::told(&raw.columns).map_err(lost)?;
                return Err(ReadError::NoTime {
                    path: path.to_owned(),
                    columns,
                    about,
                    notes: Notes::path_of(path),
                });
            };
            findings.extend(about);
            return even(path, start, step, count);
        }
    };
    by_stamps(path, stamps, raw.over, (rate.as_ref(), notes), findings)
}

fn even(path: &Path, start: f64, step: f64, count: usize) -> Result<SamplePlaces, ReadError> {
    let fault = |fault| ReadError::Grid {
        path: path.to_owned(),
        fault,
    };
    Grid::even(start, step, count)
        .map(|_| SamplePlaces::Even { start, step, count })
        .map_err(fault)
}

/// Reports a rate of the file that differs from another one.
fn differs(rate: Option<&Rate>, rate_hz: f64, what: &str, used: &str) -> Option<Issue> {
    let rate = rate.filter(|rate| rate.differs_from(rate_hz))?;
    let about = format!(
        "{} in the file is {} Hz, {what} {rate_hz:.6} Hz; {used} used",
        rate.told, rate.rate_hz
    );
    Some(Issue::new(IssueKind::HeaderDisagrees, 1, None, about))
}

/// Step given by the notes, else by the file, where no column is a time; with the issue to report.
fn told_step(rate: Option<&Rate>, start: f64, notes: &Notes) -> Option<(f64, Option<Issue>)> {
    if let Some(rate_hz) = notes.rate_hz {
        return Some((
            1.0 / rate_hz,
            differs(rate, rate_hz, "the notes specify", "the notes are"),
        ));
    }
    let Rate { told, rate_hz } = rate?;
    let about = format!(
        "no column is a time; the samples are placed at {rate_hz} Hz, starting at {start} s, from \
        {told} in the file"
    );
    Some((
        1.0 / rate_hz,
        Some(Issue::new(IssueKind::Assumed, 1, None, about)),
    ))
}

/// Positions from stamps, in s or Hz, checked against rates of the file and the notes.
fn by_stamps(
    path: &Path,
    stamps: ColumnNumbers,
    over: Over,
    (rate, notes): (Option<&Rate>, &Notes),
    findings: &mut Vec<Issue>,
) -> Result<SamplePlaces, ReadError> {
    let lost = |reason| ReadError::Scratch {
        path: path.to_owned(),
        reason,
    };
    let fault = |fault| ReadError::Grid {
        path: path.to_owned(),
        fault,
    };
    let unit = if over == Over::Time { "s" } else { "Hz" };
    let told = notes
        .rate_hz
        .or(rate.map(|rate| rate.rate_hz))
        .map(|rate_hz| 1.0 / rate_hz);
    let (found, places) = match Stamped::of(&stamps, told, unit)
        .map_err(lost)?
        .map_err(fault)?
    {
        Stamped::Even {
            start,
            step,
            noticed,
        } => {
            findings.extend(noticed);
            (1.0 / step, even(path, start, step, stamps.count())?)
        }
        Stamped::Uneven(odd) => {
            findings.extend(odd);
            let rate = 1.0 / usual_step(&stamps).map_err(lost)?;
            (rate, SamplePlaces::Stamped { stamps, rate })
        }
    };
    findings.extend(differs(rate, found, "the stamps give", "the stamps are"));
    if let Some(rate_hz) = notes
        .rate_hz
        .filter(|rate_hz| (rate_hz / found - 1.0).abs() > SAME_RATE)
    {
        let about = format!(
            "the notes specify {rate_hz} Hz, the stamps give {found:.6} Hz; the stamps \
                are used"
        );
        findings.push(Issue::new(IssueKind::HeaderDisagrees, 1, None, about));
    }
    Ok(places)
}

/// Column in SI units, before inspection of its samples.
pub(super) fn settled(
    mut column: RawColumn,
    said: ChannelNotes,
    findings: &mut Vec<Issue>,
) -> ChannelSummary {
    if let Some(levels) = Decibels::read(&column.unit) {
        findings.push(column.made_linear(levels));
    }
    let name = said.name.unwrap_or(column.name);
    let told = said.unit.unwrap_or(column.unit);
    let scale = said.scale.unwrap_or(1.0);
    let noticed = |kind, count, about: String| Issue::new(kind, count, None, about).of(&name);
    if !told.is_ascii() {
        findings.push(noticed(
            IssueKind::NonAsciiUnit,
            1,
            format!("the unit {told:?} contains characters outside ASCII"),
        ));
    }
    let unit = Unit::read(&told);
    let factor = scale * unit.as_ref().map_or(1.0, |unit| unit.factor);
    if let Some(unit) = unit.as_ref().filter(|unit| unit.converts()) {
        let about = format!(
            "values in {told} are multiplied by {} to give {}",
            unit.factor, unit.si
        );
        findings.push(noticed(IssueKind::Converted, column.values.count(), about));
    }
    if unit.is_none() && !told.trim().is_empty() && told.trim() != "NONE" {
        findings.push(noticed(
            IssueKind::UnknownUnit,
            1,
            format!("the unit {told:?} is not known; values are unchanged"),
        ));
    }
    let (quantity, unit) = unit.map_or((Quantity::Unknown, told.clone()), |unit| {
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
        said.place.unwrap_or(column.place),
        said.direction.unwrap_or(column.direction),
    );
    let reference = said.reference.unwrap_or(column.reference);
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
