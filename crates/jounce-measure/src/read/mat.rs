//! MATLAB files of version 5: every numeric array; vectors and the columns of matrices are channels.

use std::borrow::Cow;
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use matfile::{MatFile, NumericData};

use super::contents::Found;
use super::error::Damage;
use super::numbers::Numbers;
use super::raw::{Column, Raw};
use super::shelf::Shelf;
use crate::recording::{Finding, FindingKind, Series};

pub(super) fn read(path: &Path, shelf: &Shelf) -> Result<Found, Damage> {
    let file = File::open(path).map_err(|fault| Damage::new(fault.to_string()))?;
    let parsed = MatFile::parse(BufReader::new(file)).map_err(|fault| Damage::new(format!("{fault}; was the file cut?")))?;
    let mut findings = Vec::new();
    let mut columns = Vec::new();
    for array in parsed.arrays() {
        match matrix(array, shelf)? {
            Some(found) => columns.extend(found),
            None => {
                let about = format!("the array {} of size {:?} is no series of numbers", array.name(), array.size());
                findings.push(Finding::new(FindingKind::Skipped, 1, None, about));
            }
        }
    }
    let longest = columns.iter().map(|column: &Column| column.values.count()).max();
    let Some(longest) = longest.filter(|longest| *longest > 1) else {
        return Err(Damage::new(
            "it holds no numeric array that could be a record (cells, structs and text are not read); was the file cut?",
        ));
    };
    for short in columns.iter().filter(|column| column.values.count() != longest) {
        let about = format!("{} has {} samples where the record has {longest}", short.name, short.values.count());
        findings.push(Finding::new(FindingKind::Skipped, 1, None, about));
    }
    columns.retain(|column| column.values.count() == longest);
    Ok(Raw::columns(columns, findings).into())
}

/// The longer side of a matrix is time; a matrix of several columns has them numbered from 1.
fn matrix(array: &matfile::Array, shelf: &Shelf) -> Result<Option<Vec<Column>>, Damage> {
    let [rows, columns] = array.size()[..] else { return Ok(None) };
    let (real, imaginary) = numbers(array.data());
    if rows.checked_mul(columns) != Some(real.len()) || imaginary.as_ref().is_some_and(|imaginary| imaginary.len() != real.len()) {
        return Ok(None);
    }
    let (series, length, tall) = if rows >= columns { (columns, rows, true) } else { (rows, columns, false) };
    let pick = |values: &[f64], k: usize| -> std::io::Result<Numbers> {
        let mut picked = shelf.column();
        picked.expect(length);
        // Columns follow each other in the file.
        (0..length).try_for_each(|i| picked.push(if tall { values[k * rows + i] } else { values[i * rows + k] }))?;
        Ok(picked)
    };
    let column = |k: usize| {
        let name = if series == 1 { array.name().to_owned() } else { format!("{}({})", array.name(), k + 1) };
        let imaginary = imaginary.as_deref().map(|imaginary| pick(imaginary, k)).transpose()?;
        Ok(Column { imaginary, ..Column::new(&name, "", pick(&real, k)?) })
    };
    (0..series).map(column).collect::<Result<_, Damage>>().map(Some)
}

fn numbers(data: &NumericData) -> (Cow<'_, [f64]>, Option<Cow<'_, [f64]>>) {
    macro_rules! widened {
        ($real:expr, $imag:expr) => {
            ($real.iter().map(|x| *x as f64).collect(), $imag.as_ref().map(|imag| imag.iter().map(|x| *x as f64).collect()))
        };
    }
    match data {
        NumericData::Int8 { real, imag } => widened!(real, imag),
        NumericData::UInt8 { real, imag } => widened!(real, imag),
        NumericData::Int16 { real, imag } => widened!(real, imag),
        NumericData::UInt16 { real, imag } => widened!(real, imag),
        NumericData::Int32 { real, imag } => widened!(real, imag),
        NumericData::UInt32 { real, imag } => widened!(real, imag),
        NumericData::Int64 { real, imag } => widened!(real, imag),
        NumericData::UInt64 { real, imag } => widened!(real, imag),
        NumericData::Single { real, imag } => widened!(real, imag),
        NumericData::Double { real, imag } => (real.into(), imag.as_deref().map(Cow::from)),
    }
}
