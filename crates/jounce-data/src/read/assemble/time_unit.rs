//! Converts the stamps of a column to seconds or hertz.

use std::io;

use super::rise::{is_integer, rounded, uniform_step};
use crate::read::ChannelNotes;
use crate::read::column::numbers::ColumnNumbers;
use crate::read::column::raw::{Rate, RawColumn};
use crate::read::heading::axis::{is_time, time_unit};
use crate::recording::{Issue, IssueKind, Over, Quantity, Series as _, Unit};

/// Units tried for stamps without a unit where a rate is given: seconds in each.
const TIME_UNITS: [(&str, f64); 4] = [("s", 1.0), ("ms", 1e-3), ("us", 1e-6), ("ns", 1e-9)];

/// Column without a required unit.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::read) struct MissingUnit {
    pub column: String,
    /// Typical step, in the unit of the column.
    pub step: f64,
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
    let known = factor_of(&unit_text)
        .map(|factor| (unit_text, factor))
        .or_else(|| by_name().and_then(|unit| Some((unit.to_owned(), factor_of(unit)?))));
    let (unit, factor) = match known {
        Some(known) => known,
        None => {
            let assumed = if over == Over::Time && !is_named {
                match assumed_time_unit(column, &name, column_notes, rate)? {
                    Ok(assumed) => assumed,
                    Err(missing) => return Ok(Err(missing)),
                }
            } else {
                AssumedUnit::si(si, "the stamps have no known unit")
            };
            issues.push(new_issue(IssueKind::Assumed, assumed.message));
            (assumed.unit.to_owned(), assumed.factor)
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

/// Unit of stamps that no text gives.
struct AssumedUnit {
    unit: &'static str,
    /// Seconds or hertz in the unit.
    factor: f64,
    message: String,
}

impl AssumedUnit {
    fn si(unit: &'static str, description: &str) -> Self {
        Self {
            unit,
            factor: 1.0,
            message: format!("{description}; {unit} is assumed"),
        }
    }
}

/// Unit of the times of a column without one: by a given rate, else seconds if they have fractions
/// or a scale.
fn assumed_time_unit(
    column: &RawColumn,
    name: &str,
    column_notes: &ChannelNotes,
    rate: Option<&Rate>,
) -> io::Result<Result<AssumedUnit, MissingUnit>> {
    let step = uniform_step(&column.values)?;
    let matches_rate = |(_, factor): &&(&str, f64)| {
        rate.zip(step)
            .is_some_and(|(rate, step)| !rate.differs_from(1.0 / (step * factor)))
    };
    if let Some((unit, factor)) = TIME_UNITS.iter().find(matches_rate) {
        let by = rate.map_or("", |rate| &rate.source);
        return Ok(Ok(AssumedUnit {
            unit,
            factor: *factor,
            message: format!("the stamps have no unit; they are in {unit} by {by}"),
        }));
    }
    if column_notes.scale.is_none() && is_integer(&column.values)? {
        let steps = column
            .values
            .first_and_last()?
            .map_or(f64::NAN, |(first, last)| last - first);
        let step = step.unwrap_or(steps / (column.values.count().max(2) - 1) as f64);
        return Ok(Err(MissingUnit {
            column: column.name.clone(),
            step: rounded(step),
        }));
    }
    let description = if is_time(name) {
        "the stamps have no known unit"
    } else {
        "no name or unit identifies this column as the time"
    };
    Ok(Ok(AssumedUnit::si("s", description)))
}
