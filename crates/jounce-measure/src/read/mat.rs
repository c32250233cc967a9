//! MATLAB files of version 5: every numeric array; vectors and the columns of matrices are channels, and a single number by the name of a rate
//! (`fs`, `dt`) tells when they were sampled.

use std::borrow::Cow;
use std::fs::File;
use std::io::{BufReader, Read as _};
use std::path::Path;

use matfile::{MatFile, NumericData};

use super::contents::Found;
use super::error::Damage;
use super::numbers::Numbers;
use super::raw::{Column, Rate, Raw, Stamps};
use super::shelf::Shelf;
use crate::recording::{Finding, FindingKind, Place, Series};

/// Bytes of the header of a file, whose last two tell the byte order.
const HEADER: usize = 128;
/// Kind of an element that is compressed; it is not filled up to eight bytes.
const COMPRESSED: u32 = 15;

/// Names of a number that is a rate in Hz or a step in s, in small letters and without underlines.
const RATES: [&str; 8] =
    ["fs", "samplerate", "samplingrate", "samplefrequency", "samplingfrequency", "samplefreq", "samplingfreq", "fsamp"];
const STEPS: [&str; 6] = ["dt", "deltat", "timestep", "samplestep", "sampleinterval", "samplinginterval"];

pub(super) fn read(path: &Path, shelf: &Shelf) -> Result<Found, Damage> {
    let told = |fault: std::io::Error| Damage::new(format!("{fault}; was the file cut?"));
    let file = File::open(path).map_err(told)?;
    let size = file.metadata().map_err(told)?.len();
    let mut source = BufReader::new(file);
    let mut header = [0; HEADER];
    source.read_exact(&mut header).map_err(told)?;
    let (mut findings, mut columns) = (Vec::new(), Vec::new());
    let mut at = HEADER as u64;
    // One element after the other, since the library holds what it is given: tag, then so many bytes.
    while at < size {
        let mut tag = [0; 8];
        source.read_exact(&mut tag).map_err(told)?;
        let ([due, whole], left) = (lengths(tag, header.ends_with(b"IM")), size - at - 8);
        if due > left {
            let why = format!("the element that begins here is {due} bytes long, {left} follow: was the file cut?");
            return Err(Damage::at(Place::Byte(at as usize), why));
        }
        let length = whole.min(left);
        let element = header.chain(&tag[..]).chain(source.by_ref().take(length));
        let parsed =
            MatFile::parse(element).map_err(|fault| Damage::at(Place::Byte(at as usize), format!("{fault}; was the file cut?")))?;
        if parsed.arrays().is_empty() {
            let about = "an element is no numeric array (a cell, a struct or text) and was left out".to_owned();
            findings.push(Finding::new(FindingKind::Skipped, 1, Some(Place::Byte(at as usize)), about));
        }
        for array in parsed.arrays() {
            match matrix(array, shelf)? {
                Some(found) => columns.extend(found),
                None => {
                    let about = format!("the array {} of size {:?} is no series of numbers", array.name(), array.size());
                    findings.push(Finding::new(FindingKind::Skipped, 1, None, about));
                }
            }
        }
        at += 8 + length;
    }
    let longest = columns.iter().map(|column: &Column| column.values.count()).max();
    let Some(longest) = longest.filter(|longest| *longest > 1) else {
        return Err(Damage::new(
            "it holds no numeric array that could be a record (cells, structs and text are not read); was the file cut?",
        ));
    };
    let rate = rate(&mut columns, &mut findings)?;
    for short in columns.iter().filter(|column| column.values.count() != longest) {
        let about = format!("{} has {} samples where the record has {longest}", short.name, short.values.count());
        findings.push(Finding::new(FindingKind::Skipped, 1, None, about));
    }
    columns.retain(|column| column.values.count() == longest);
    let raw = Raw::columns(columns, findings);
    Ok(Raw { stamps: rate.map_or(Stamps::Column, Stamps::Rate), ..raw }.into())
}

/// Takes single numbers by the names of a rate or a step out of the columns; where several disagree the first counts, and that is told.
fn rate(columns: &mut Vec<Column>, findings: &mut Vec<Finding>) -> std::io::Result<Option<Rate>> {
    let mut rates: Vec<Rate> = Vec::new();
    let (mut kept, all) = (Vec::new(), std::mem::take(columns));
    for column in all {
        match rate_of(&column)? {
            Some(rate) => rates.push(rate),
            None => kept.push(column),
        }
    }
    *columns = kept;
    let mut rates = rates.into_iter();
    let Some(first) = rates.next() else { return Ok(None) };
    for other in rates.filter(|other| other.differs_from(first.rate_hz)) {
        let about =
            format!("{} is a rate of {} Hz, {} one of {} Hz; the first is taken", first.told, first.rate_hz, other.told, other.rate_hz);
        findings.push(Finding::new(FindingKind::HeaderDisagrees, 1, None, about));
    }
    Ok(Some(first))
}

/// The rate that a single number tells by its name.
fn rate_of(column: &Column) -> std::io::Result<Option<Rate>> {
    let name: String = column.name.to_lowercase().chars().filter(|c| *c != '_').collect();
    let (is_rate, is_step) = (RATES.contains(&name.as_str()), STEPS.contains(&name.as_str()));
    if column.values.count() != 1 || column.imaginary.is_some() || !(is_rate || is_step) {
        return Ok(None);
    }
    let number = column.values.ends()?.map_or(f64::NAN, |(number, _)| number);
    let rate_hz = if is_rate { number } else { 1.0 / number };
    let rate = Rate { told: format!("{} = {number}", column.name), rate_hz };
    Ok((rate_hz > 0.0 && rate_hz.is_finite()).then_some(rate))
}

/// Bytes behind the tag of an element: those that it tells, and these filled up to eight where they are not compressed.
fn lengths(tag: [u8; 8], little_endian: bool) -> [u64; 2] {
    let [kind, length] = [0, 4].map(|from| {
        let bytes = [tag[from], tag[from + 1], tag[from + 2], tag[from + 3]];
        if little_endian { u32::from_le_bytes(bytes) } else { u32::from_be_bytes(bytes) }
    });
    let told = u64::from(length);
    [told, if kind == COMPRESSED { told } else { told.next_multiple_of(8) }]
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
