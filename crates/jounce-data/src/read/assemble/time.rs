//! Identifies the time column of a data set and its unit.
//!
//! A column is the time if the notes, its name or its unit specify it, or if its step equals a
//! given rate. A column that only ascends is not the time: it may count samples, or contain
//! milliseconds. Arrays of NPY and MAT have no name for it. There, a first one that rises uniformly
//! by a fraction is read in seconds, with an issue.

use std::borrow::Cow;
use std::io;

use crate::read::column::numbers::ColumnNumbers;
use crate::read::column::raw::{Rate, Raw, RawColumn, TimeStamps};
use crate::read::heading::name::{is_frequency, is_time, time_unit};
use crate::read::{ChannelNotes, Notes, SamplePlaces};
use crate::recording::{Issue, IssueKind, Over, PIECE, Quantity, Series, Unit};

/// Names of index columns, in lower case without spaces and dots.
const COUNTER_NAMES: [&str; 29] = [
    "#",
    "n",
    "no",
    "nr",
    "num",
    "i",
    "k",
    "x",
    "idx",
    "index",
    "id",
    "sample",
    "samples",
    "sample#",
    "sampleno",
    "samplenumber",
    "sequence",
    "seq",
    "count",
    "counter",
    "point",
    "points",
    "row",
    "record",
    "recno",
    "scan",
    "frame",
    "line",
    "number",
];
/// Units tried for stamps without a unit where a rate is given: seconds in each.
const TIME_UNITS: [(&str, f64); 4] = [("s", 1.0), ("ms", 1e-3), ("us", 1e-6), ("ns", 1e-9)];

/// Maximum deviation of a number from the time of its sample, relative to the step.
const MAX_STAMP_DEVIATION: f64 = 0.02;

/// Column without a required unit.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::read) struct MissingUnit {
    pub column: String,
    /// Typical step, in the unit of the column.
    pub step: f64,
}

/// Name and unit of a column after the notes are applied.
fn column_head<'a>(
    column: &'a RawColumn,
    notes_of: Option<&'a ChannelNotes>,
) -> (&'a str, &'a str) {
    let name = notes_of
        .and_then(|notes_of| notes_of.name.as_deref())
        .unwrap_or(&column.name);
    (
        name,
        notes_of
            .and_then(|notes_of| notes_of.unit.as_deref())
            .unwrap_or(&column.unit),
    )
}

fn unit_quantity(unit: &str) -> Option<Quantity> {
    Unit::read(unit).map(|unit| unit.quantity)
}

/// True for a column that is the time by its name or unit.
pub(in crate::read) fn is_time_column(column: &RawColumn) -> bool {
    is_time_head(column_head(column, None))
}

fn is_time_head((name, unit): (&str, &str)) -> bool {
    // A time constant in V is not a time.
    let has_no_unit = matches!(unit.trim(), "" | "NONE");
    unit_quantity(unit) == Some(Quantity::Time) || has_no_unit && is_time(name)
}

fn is_frequency_head((name, unit): (&str, &str)) -> bool {
    let has_no_unit = matches!(unit.trim(), "" | "NONE");
    is_frequency(name) && (has_no_unit || unit_quantity(unit) == Some(Quantity::Frequency))
}

/// Finds the time (or frequency) column: the one named in the notes, identified by name or unit, or
/// the first one whose step equals a given rate.
pub(in crate::read) fn time_column(
    raw: &mut Raw,
    column_notes: &[ChannelNotes],
    notes: &Notes,
) -> io::Result<Option<usize>> {
    if let Some(requested) = &notes.time {
        let by_number = || {
            requested
                .parse::<usize>()
                .ok()
                .and_then(|number| number.checked_sub(1))
        };
        return Ok(raw
            .columns
            .iter()
            .position(|column| column.name == *requested)
            .or_else(by_number));
    }
    if notes.rate_hz.is_some() {
        return Ok(None);
    }
    if let TimeStamps::FromColumn { column, .. } = raw.stamps {
        return Ok(Some(column));
    }
    let is_candidate = |k: &usize| raw.columns[*k].left_out.is_none();
    let heads: Vec<(String, String)> = (0..raw.columns.len())
        .map(|k| {
            let (name, unit) = column_head(&raw.columns[k], column_notes.get(k));
            (name.to_owned(), unit.to_owned())
        })
        .collect();
    let head_of = |k: usize| (heads[k].0.as_str(), heads[k].1.as_str());
    let all = || (0..heads.len()).filter(is_candidate);
    if let Some(k) = all().find(|k| is_time_head(head_of(*k)) && is_time(head_of(*k).0)) {
        return Ok(Some(k));
    }
    if let Some(k) = all().find(|k| is_frequency_head(head_of(*k))) {
        raw.over = Over::Frequency;
        return Ok(Some(k));
    }
    for k in all() {
        if is_time_head(head_of(k)) && ascends(&raw.columns[k].values)? {
            return Ok(Some(k));
        }
    }
    let stated_rate = match &raw.stamps {
        TimeStamps::Rate(rate) => Some(rate),
        TimeStamps::Header(header) => Some(&header.rate),
        TimeStamps::Column => None,
        _ => return Ok(None),
    };
    let Some(first) = all().next().filter(|_| raw.columns.len() > 1) else {
        return Ok(None);
    };
    let values = &raw.columns[first].values;
    let Some(step) = uniform_step(values)? else {
        return Ok(None);
    };
    // Arrays cannot name their time: one that rises uniformly by a fraction is neither a count nor
    // whole milliseconds.
    let is_time_axis = match stated_rate {
        Some(rate) => !rate.differs_from(1.0 / step),
        None => !is_integer(values)?,
    };
    Ok(is_time_axis.then_some(first))
}

/// Returns the step of a column that ascends uniformly.
pub(in crate::read) fn uniform_step(values: &ColumnNumbers) -> io::Result<Option<f64>> {
    let Some((first, last)) = values.first_and_last()? else {
        return Ok(None);
    };
    let step = (last - first) / (values.count().max(2) - 1) as f64;
    let (mut is_uniform, mut k) = (step > 0.0 && values.count() > 2, 0.0);
    if is_uniform {
        values.each(|t| {
            is_uniform &= ((t - first) / step - k).abs() < 0.5;
            k += 1.0;
        })?;
    }
    Ok(is_uniform.then_some(step))
}

/// Describes a channel that equals the time of its samples, or counts them; `None` for any other.
pub(in crate::read) fn describe_equal(
    values: &ColumnNumbers,
    places: &SamplePlaces,
) -> io::Result<Option<String>> {
    if counting_step(values)? == Some(1.0) {
        return Ok(Some("it counts the samples".to_owned()));
    }
    let (step, mut equal, mut k) = (1.0 / places.rate(), values.count() > 2, 0);
    let (mut piece, mut at) = (Vec::new(), 0);
    values.each(|x| {
        // Pieces of both series have equal length.
        if equal && k % PIECE == 0 {
            piece = places
                .piece(k / PIECE)
                .map(Cow::into_owned)
                .unwrap_or_default();
            at = 0;
        }
        equal &= piece
            .get(at)
            .is_some_and(|place| (x - place).abs() < MAX_STAMP_DEVIATION * step);
        (k, at) = (k + 1, at + 1);
    })?;
    Ok(equal.then(|| "it is equal to the time of its samples".to_owned()))
}

/// True for numbers that never decrease and end above their first value.
pub(in crate::read) fn ascends(values: &ColumnNumbers) -> io::Result<bool> {
    let (mut is_ascending, mut previous) = (true, f64::NEG_INFINITY);
    values.each(|x| {
        is_ascending &= x >= previous;
        previous = x;
    })?;
    Ok(is_ascending
        && values
            .first_and_last()?
            .is_some_and(|(first, last)| last > first))
}

/// True for a column with the name of a counter whose integers rise by a constant integer, and for
/// an unnamed one that rises by 1.
pub(in crate::read) fn is_counter(column: &RawColumn) -> io::Result<bool> {
    let name: String = column
        .name
        .to_lowercase()
        .chars()
        .filter(|c| !c.is_whitespace() && !"._".contains(*c))
        .collect();
    let has_no_name =
        name.starts_with("column") && name["column".len()..].bytes().all(|b| b.is_ascii_digit());
    if !column.unit.is_empty()
        || column.imaginary.is_some()
        || !(has_no_name || COUNTER_NAMES.contains(&name.as_str()))
    {
        return Ok(false);
    }
    Ok(counting_step(&column.values)?.is_some_and(|step| !has_no_name || step == 1.0))
}

/// Returns the constant step of integers.
fn counting_step(values: &ColumnNumbers) -> io::Result<Option<f64>> {
    let Some((first, last)) = values.first_and_last()? else {
        return Ok(None);
    };
    let step = (last - first) / (values.count().max(2) - 1) as f64;
    let (mut is_counting, mut k) = (
        step >= 1.0 && step.fract() == 0.0 && first.fract() == 0.0 && values.count() > 2,
        0.0,
    );
    if is_counting {
        values.each(|x| {
            is_counting &= x == first + k * step;
            k += 1.0;
        })?;
    }
    Ok(is_counting.then_some(step))
}

/// Describes columns that are not read as channels, for an error: `a counts the samples`.
pub(in crate::read) fn describe_time_candidates(columns: &[RawColumn]) -> io::Result<Vec<String>> {
    let mut descriptions = Vec::new();
    for column in columns.iter().filter(|column| column.left_out.is_none()) {
        if is_counter(column)? {
            descriptions.push(format!("{:?} counts", column.name));
        } else if let Some(step) = uniform_step(&column.values)? {
            descriptions.push(format!(
                "{:?} rises by {} and has no unit of time",
                column.name,
                rounded(step)
            ));
        }
    }
    Ok(descriptions)
}

/// Rounds a number to nine digits.
fn rounded(step: f64) -> f64 {
    format!("{step:.8e}").parse().unwrap_or(step)
}

/// Converts the stamps of a column to s or Hz. Stamps without a unit are seconds if their column is
/// named as a time and they have fractions; a given `rate` may determine the unit too. Integers are
/// ambiguous.
pub(in crate::read) fn seconds(
    column: &mut RawColumn,
    column_notes: &ChannelNotes,
    (over, rate, is_named): (Over, Option<&Rate>, bool),
    issues: &mut Vec<Issue>,
) -> io::Result<Result<ColumnNumbers, MissingUnit>> {
    let (expected, si) = if over == Over::Time {
        (Quantity::Time, "s")
    } else {
        (Quantity::Frequency, "Hz")
    };
    let name = column_notes
        .name
        .clone()
        .unwrap_or_else(|| column.name.clone());
    let unit_text = column_notes
        .unit
        .clone()
        .unwrap_or_else(|| column.unit.clone());
    let new_issue = |kind, message: String| Issue::new(kind, 1, None, message).of(&name);
    let factor_of = |unit: &str| {
        Unit::read(unit)
            .filter(|unit| unit.quantity == expected)
            .map(|unit| unit.factor)
    };
    let by_name = || time_unit(&name).filter(|_| over == Over::Time);
    let (unit, factor) = match factor_of(&unit_text)
        .map(|factor| (unit_text, factor))
        .or_else(|| by_name().and_then(|unit| Some((unit.to_owned(), factor_of(unit)?))))
    {
        Some(result) => result,
        None if over == Over::Time && !is_named => {
            let step = uniform_step(&column.values)?;
            let matches_rate = |(_, factor): &&(&str, f64)| {
                rate.zip(step)
                    .is_some_and(|(rate, step)| !rate.differs_from(1.0 / (step * factor)))
            };
            if let Some((unit, factor)) = TIME_UNITS.iter().find(matches_rate) {
                let by = rate.map_or("", |rate| &rate.source);
                issues.push(new_issue(
                    IssueKind::Assumed,
                    format!("the stamps have no unit; they are in {unit} by {by}"),
                ));
                ((*unit).to_owned(), *factor)
            } else if column_notes.scale.is_none() && is_integer(&column.values)? {
                let steps = column
                    .values
                    .first_and_last()?
                    .map_or(f64::NAN, |(first, last)| last - first);
                let step = step.unwrap_or(steps / (column.values.count().max(2) - 1) as f64);
                return Ok(Err(MissingUnit {
                    column: column.name.clone(),
                    step: rounded(step),
                }));
            } else {
                let description = if is_time(&name) {
                    "the stamps have no known unit"
                } else {
                    "no name or unit identifies this column as the time"
                };
                issues.push(new_issue(
                    IssueKind::Assumed,
                    format!("{description}; {si} is assumed"),
                ));
                (si.to_owned(), 1.0)
            }
        }
        None => {
            issues.push(new_issue(
                IssueKind::Assumed,
                format!("the stamps have no known unit; {si} is assumed"),
            ));
            (si.to_owned(), 1.0)
        }
    };
    let scale = column_notes.scale.unwrap_or(1.0);
    if factor * scale != 1.0 {
        issues.push(new_issue(
            IssueKind::Converted,
            format!(
                "stamps in {unit} are multiplied by {} to give {si}",
                factor * scale
            ),
        ));
    }
    column.values.scale(factor * scale);
    Ok(Ok(std::mem::replace(&mut column.values, Vec::new().into())))
}

fn is_integer(values: &ColumnNumbers) -> io::Result<bool> {
    let mut is_integer = true;
    values.each(|x| is_integer &= x.fract() == 0.0)?;
    Ok(is_integer)
}
