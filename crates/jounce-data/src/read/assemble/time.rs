//! Identifies the time column of a data set.
//!
//! A column is the time if the notes, its name or its unit specify it, or if its step equals a
//! given rate. A column that only ascends is not the time: it may count samples, or contain
//! milliseconds. Arrays of NPY and MAT have no name for it. There, a first one that rises uniformly
//! by a fraction is read in seconds, with an issue.

use std::borrow::Cow;
use std::io;

use super::rise::{ascends, counting_step, is_integer, uniform_step};
use crate::read::column::numbers::ColumnNumbers;
use crate::read::column::raw::{Raw, RawColumn, TimeStamps};
use crate::read::heading::axis::{is_frequency, is_time};
use crate::read::{ChannelNotes, Notes, SamplePlaces};
use crate::recording::{Over, PIECE, Quantity, Series as _, Unit};

/// Maximum deviation of a number from the time of its sample, relative to the step.
const MAX_STAMP_DEVIATION: f64 = 0.02;

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
    if !raw.stamps.may_be_in_a_column() {
        return Ok(None);
    }
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
    unnamed_time_column(raw, all().next())
}

/// Returns the first column if its step equals a given rate or, without one, if it rises uniformly
/// by a fraction.
fn unnamed_time_column(raw: &Raw, first: Option<usize>) -> io::Result<Option<usize>> {
    let stated_rate = match &raw.stamps {
        TimeStamps::Rate(rate) => Some(rate),
        TimeStamps::Header(header) => Some(&header.rate),
        TimeStamps::Column => None,
        _ => return Ok(None),
    };
    let Some(first) = first.filter(|_| raw.columns.len() > 1) else {
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
