//! Data set 58: one function over time or frequency.

use std::io;

use super::blocks::{Block, Data};
use super::header::{Dof, Header};
use crate::read::column::numbers::ColumnNumbers;
use crate::read::column::raw::{Raw, RawColumn, TimeStamps};
use crate::read::column::samples::SampleStore;
use crate::read::error::Damage;
use crate::recording::{IssuePlace, Over, PIECE, Series};

/// Function types over time: time response, auto- and cross-correlation, shock.
const TIME_FUNCTIONS: [u32; 4] = [1, 5, 7, 24];

pub(super) fn read(block: Block, store: &SampleStore) -> Result<Raw, Damage> {
    let header = Header::read(&block)?;
    let numbers = match block.data {
        Data::Binary(result) => result,
        Data::Lines(result, error) => {
            check_numbers(&result, error, &header)
                .map_err(|why| Damage::at(IssuePlace::Byte(block.start), why))?;
            result
        }
    };
    let over = match header.abscissa.kind {
        17 => Over::Time,
        18 => Over::Frequency,
        _ if header.abscissa.unit.eq_ignore_ascii_case("hz") => Over::Frequency,
        _ if TIME_FUNCTIONS.contains(&header.function) || header.function == 0 => Over::Time,
        _ => Over::Frequency,
    };
    let mut columns = split_columns(numbers, header.points, header.width(), store)?.into_iter();
    let mut next = || columns.next().unwrap_or_else(|| Vec::new().into());
    let stamps = if header.is_uniform {
        TimeStamps::Even {
            start: header.start,
            step: header.step,
        }
    } else {
        TimeStamps::Explicit(next())
    };
    let column = RawColumn {
        name: name(&header),
        unit: unit(&header),
        place: position(&header.response),
        direction: direction(&header.response),
        reference: if over == Over::Frequency {
            reference_text(&header.reference)
        } else {
            String::new()
        },
        left_out: None,
        values: next(),
        imaginary: header.complex.then(next),
    };
    Ok(Raw {
        title: header.title,
        over,
        stamps,
        columns: vec![column],
        issues: Vec::new(),
    })
}

/// Splits points into one column per number; padding of the last line is left out.
fn split_columns(
    numbers: ColumnNumbers,
    points: usize,
    width: usize,
    store: &SampleStore,
) -> Result<Vec<ColumnNumbers>, Damage> {
    if width == 1 && numbers.count() == points {
        return Ok(vec![numbers]);
    }
    let mut columns: Vec<ColumnNumbers> = (0..width).map(|_| store.column()).collect();
    let mut sample_index = 0;
    for index in 0..numbers.count().div_ceil(PIECE) {
        for x in numbers
            .piece(index)?
            .iter()
            .take((points * width).saturating_sub(sample_index))
        {
            columns[sample_index % width].push(*x)?;
            sample_index += 1;
        }
    }
    Ok(columns)
}

/// Groups functions over the same grid as channels of one set. Duplicate names are extended by
/// location, then by reference, then by a number.
pub(super) fn grouped(sets: Vec<Raw>) -> Result<Vec<Raw>, Damage> {
    let mut groups: Vec<Raw> = Vec::new();
    for set in sets {
        let mut matching = None;
        for (index, group) in groups.iter().enumerate() {
            if matching.is_none() && same_grid(group, &set)? {
                matching = Some(index);
            }
        }
        match matching.and_then(|index| groups.get_mut(index)) {
            Some(group) => group.columns.extend(set.columns),
            None => groups.push(set),
        }
    }
    for group in &mut groups {
        rename(&mut group.columns, |column, _| {
            format!("{} {} {}", column.name, column.place, column.direction)
                .trim_end()
                .to_owned()
        });
        rename(&mut group.columns, |column, _| {
            match column.reference.as_str() {
                "" => column.name.clone(),
                reference => format!("{} from {reference}", column.name),
            }
        });
        rename(&mut group.columns, |column, number| {
            format!("{} ({number})", column.name)
        });
    }
    Ok(groups)
}

fn same_grid(a: &Raw, b: &Raw) -> io::Result<bool> {
    let length = |raw: &Raw| {
        raw.columns
            .first()
            .map_or(0, |column| column.values.count())
    };
    if a.over != b.over || length(a) != length(b) {
        return Ok(false);
    }
    match (&a.stamps, &b.stamps) {
        (
            TimeStamps::Even {
                start: from,
                step: by,
            },
            TimeStamps::Even { start, step },
        ) => Ok(from == start && by == step),
        (TimeStamps::Explicit(a), TimeStamps::Explicit(b)) => a.equals(b),
        _ => Ok(false),
    }
}

/// Renames every column with a duplicate name.
fn rename(columns: &mut [RawColumn], new: impl Fn(&RawColumn, usize) -> String) {
    let names: Vec<String> = columns.iter().map(|column| column.name.clone()).collect();
    for (k, column) in columns.iter_mut().enumerate() {
        if names.iter().filter(|name| **name == column.name).count() > 1 {
            column.name = new(column, k + 1);
        }
    }
}

/// Refuses text lines with a word that is not a number, or with too few numbers.
fn check_numbers(
    result: &ColumnNumbers,
    error: Option<String>,
    header: &Header,
) -> Result<(), String> {
    if let Some(word) = error {
        return Err(format!("{word:?} among the data is not a number"));
    }
    let (expected, count) = (header.points.saturating_mul(header.width()), result.count());
    if count < expected {
        Err(format!(
            "expected {expected} numbers, but {count} follow: is the file truncated?"
        ))
    } else {
        Ok(())
    }
}

/// Returns the label of the ordinate, or the name of the response.
fn name(header: &Header) -> String {
    let has_name = [&header.ordinate.label, &header.response.name]
        .into_iter()
        .find(|name| !name.is_empty() && *name != "NONE");
    has_name
        .cloned()
        .unwrap_or_else(|| format!("function {}", header.function))
}

fn unit(header: &Header) -> String {
    let (unit, denominator) = (&header.ordinate.unit, &header.denominator.unit);
    // Some programs write the complete quotient as unit of the ordinate.
    if denominator.is_empty()
        || unit.contains('/') && unit.ends_with(denominator.as_str())
        || header.function != 4
    {
        unit.clone()
    } else {
        format!("{unit}/{denominator}")
    }
}

/// Node, or without a node number the name of the entity.
fn position(dof: &Dof) -> String {
    match (dof.node, dof.name.as_str()) {
        (0, "NONE") => String::new(),
        (0, name) => name.to_owned(),
        (node, _) => format!("node {node}"),
    }
}

/// Node and direction of a degree of freedom as text; empty if not given.
fn reference_text(dof: &Dof) -> String {
    let position = position(dof);
    if position.is_empty() {
        position
    } else {
        format!("{position} {}", direction(dof))
            .trim_end()
            .to_owned()
    }
}

/// `+x` to `-z` for 1 to 3 and their negatives, rotations beyond.
fn direction(dof: &Dof) -> String {
    let sign = if dof.direction < 0 { '-' } else { '+' };
    match dof.direction.unsigned_abs() {
        axis @ 1..=3 => format!("{sign}{}", ['x', 'y', 'z'][axis as usize - 1]),
        axis @ 4..=6 => format!("{sign}r{}", ['x', 'y', 'z'][axis as usize - 4]),
        _ => String::new(),
    }
}
