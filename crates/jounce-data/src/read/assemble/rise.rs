//! How the numbers of a column rise: uniformly, by a constant integer as a counter, or not at all.

use std::io;

use crate::read::column::numbers::ColumnNumbers;
use crate::read::column::raw::RawColumn;
use crate::recording::Series as _;

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
pub(super) fn counting_step(values: &ColumnNumbers) -> io::Result<Option<f64>> {
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

/// True where all numbers are integers.
pub(super) fn is_integer(values: &ColumnNumbers) -> io::Result<bool> {
    let mut is_integer = true;
    values.each(|x| is_integer &= x.fract() == 0.0)?;
    Ok(is_integer)
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
pub(super) fn rounded(step: f64) -> f64 {
    format!("{step:.8e}").parse().unwrap_or(step)
}
