//! Raw columns and notes to a recording: names, time, SI units, findings.

use std::io;
use std::path::Path;

use super::decibels::Decibels;
use super::name::{is_frequency, is_time};
use super::numbers::Numbers;
use super::raw::{Column, Rate, Raw, SAME_RATE, Stamps};
use super::survey::{Places, Surveyed, SurveyedChannel};
use super::{ChannelNotes, Notes, ReadError};
use crate::recording::{
    Finding, FindingKind, Grid, Over, Quantity, Series, Sizes, Stamped, Unit, inspected, may_be_counts, sizes_with, usual_step,
};

/// The recording of a data set.
pub(super) fn recording(path: &Path, name: String, mut raw: Raw, notes: &Notes) -> Result<Surveyed, ReadError> {
    raw.columns = paired(raw.columns);
    let columns: Vec<String> = raw.columns.iter().map(|column| column.name.clone()).collect();
    let said: Vec<ChannelNotes> = columns.iter().enumerate().map(|(k, name)| notes.of(name, k + 1)).collect();
    check_notes(path, notes, &columns)?;
    let lost = |reason| ReadError::Scratch { path: path.to_owned(), reason };
    let mut findings = std::mem::take(&mut raw.findings);
    // What the notes tell of a channel is assumed no more.
    let is_told =
        |name: &String| columns.iter().zip(&said).any(|(column, said)| column == name && (said.unit.is_some() || said.name.is_some()));
    findings.retain(|finding| finding.kind != FindingKind::Assumed || !finding.channel.as_ref().is_some_and(is_told));
    if notes.over_frequency {
        raw.over = Over::Frequency;
    }
    let time = if let Stamps::Column | Stamps::Rate(_) | Stamps::Of { .. } = raw.stamps {
        time_column(&mut raw, &said, notes).map_err(lost)?
    } else {
        None
    };
    let places = places(path, &mut raw, time, notes, columns, &mut findings)?;
    let left_out = said.iter().any(|said| said.left_out);
    let mut channels = Vec::new();
    for (k, (column, said)) in raw.columns.into_iter().zip(said).enumerate() {
        if Some(k) != time && !said.left_out {
            channels.push(settled(column, said, &mut findings));
        }
    }
    if channels.is_empty() && !left_out {
        return Err(ReadError::NoChannel { path: path.to_owned(), findings });
    }
    for channel in &mut channels {
        let counts = may_be_counts(channel.quantity, channel.imaginary.is_some());
        let (found, sizes) = inspected(&channel.values, counts).map_err(lost)?;
        findings.extend(found.into_iter().map(|finding| finding.of(&channel.name)));
        channel.sizes = sizes_with(sizes, &channel.values, channel.imaginary.as_ref()).map_err(lost)?;
    }
    Ok(Surveyed { name, over: raw.over, places, channels, findings })
}

/// A column `NAME.im` behind `NAME.re` in the same unit holds its imaginary parts: so are complex channels written.
fn paired(columns: Vec<Column>) -> Vec<Column> {
    let mut paired: Vec<Column> = Vec::new();
    for column in columns {
        let is_real = |before: &&mut Column| {
            let stems = before.name.strip_suffix(".re").zip(column.name.strip_suffix(".im"));
            stems.is_some_and(|(re, im)| re == im) && before.unit == column.unit && before.imaginary.is_none() && column.imaginary.is_none()
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

/// Notes that name a column that is not there say so.
fn check_notes(path: &Path, notes: &Notes, columns: &[String]) -> Result<(), ReadError> {
    let there = |key: &String| columns.contains(key) || key.parse::<usize>().is_ok_and(|number| (1..=columns.len()).contains(&number));
    let named = notes.channels.keys().chain(&notes.time).filter(|key| !there(key));
    let faults: Vec<String> = named.map(|key| format!("there is no column {key:?}; the columns are {}", columns.join(", "))).collect();
    if faults.is_empty() { Ok(()) } else { Err(ReadError::Notes { path: Notes::path_of(path), faults }) }
}

/// The column that holds the time (or frequency): the one that the notes name, that a name tells, or a first one that ascends evenly.
fn time_column(raw: &mut Raw, said: &[ChannelNotes], notes: &Notes) -> io::Result<Option<usize>> {
    if let Some(wanted) = &notes.time {
        let numbered = || wanted.parse::<usize>().ok().and_then(|number| number.checked_sub(1));
        return Ok(raw.columns.iter().position(|column| column.name == *wanted).or_else(numbered));
    }
    if notes.rate_hz.is_some() {
        return Ok(None);
    }
    if let Stamps::Of { column, .. } = raw.stamps {
        return Ok(Some(column));
    }
    let name = |k: usize| said[k].name.as_deref().unwrap_or(&raw.columns[k].name);
    if let Some(k) = (0..raw.columns.len()).find(|k| is_time(name(*k))) {
        return Ok(Some(k));
    }
    if let Some(k) = (0..raw.columns.len()).find(|k| is_frequency(name(*k))) {
        raw.over = Over::Frequency;
        return Ok(Some(k));
    }
    if raw.columns.len() < 2 {
        return Ok(None);
    }
    let step = even_step(&raw.columns[0].values)?;
    // Where a number tells the rate, a first column without the name of a time is one only if it has that rate.
    let fits = |step: &f64| !matches!(&raw.stamps, Stamps::Rate(rate) if rate.differs_from(1.0 / step));
    Ok(step.filter(fits).map(|_| 0))
}

/// The step of a column that ascends evenly.
fn even_step(values: &Numbers) -> io::Result<Option<f64>> {
    let Some((first, last)) = values.ends()? else { return Ok(None) };
    let step = (last - first) / (values.count().max(2) - 1) as f64;
    let (mut even, mut k) = (step > 0.0 && values.count() > 2, 0.0);
    if even {
        values.each(|t| {
            even &= ((t - first) / step - k).abs() < 0.5;
            k += 1.0;
        })?;
    }
    Ok(even.then_some(step))
}

fn places(
    path: &Path,
    raw: &mut Raw,
    time: Option<usize>,
    notes: &Notes,
    columns: Vec<String>,
    findings: &mut Vec<Finding>,
) -> Result<Places, ReadError> {
    let fault = |fault| ReadError::Grid { path: path.to_owned(), fault };
    let even = |start, step, count| Grid::even(start, step, count).map(|_| Places::Even { start, step, count }).map_err(fault);
    let lost = |reason| ReadError::Scratch { path: path.to_owned(), reason };
    let count = raw.columns.first().map_or(0, |column| column.values.count());
    let told = match std::mem::replace(&mut raw.stamps, Stamps::Column) {
        Stamps::Of { rate, .. } => rate.map_or(Stamps::Column, Stamps::Rate),
        other => other,
    };
    let number = if let Stamps::Rate(rate) = &told { Some(rate.clone()) } else { None };
    let differs = |rate_hz: f64, what: &str, used: &str| {
        let number = number.as_ref().filter(|number| number.differs_from(rate_hz))?;
        let about = format!("{} in the file is {} Hz, {what} {rate_hz:.6} Hz; {used} used", number.told, number.rate_hz);
        Some(Finding::new(FindingKind::HeaderDisagrees, 1, None, about))
    };
    let stamps = match (told, time, notes.rate_hz) {
        (Stamps::Even { start, step }, ..) => return even(start, step, count),
        (Stamps::Given(stamps), ..) => stamps,
        // A time column is no channel: its numbers may be taken.
        (Stamps::Column | Stamps::Rate(_) | Stamps::Of { .. }, Some(k), _) => seconds(&mut raw.columns[k], raw.over, findings),
        (Stamps::Column | Stamps::Rate(_) | Stamps::Of { .. }, None, Some(rate_hz)) => {
            findings.extend(differs(rate_hz, "the notes say", "the notes are"));
            return even(0.0, 1.0 / rate_hz, count);
        }
        (Stamps::Rate(Rate { told, rate_hz }), None, None) => {
            let about = format!("no array is a time; the samples are taken at {rate_hz} Hz from 0 s on, by {told} in the file");
            findings.push(Finding::new(FindingKind::Assumed, 1, None, about));
            return even(0.0, 1.0 / rate_hz, count);
        }
        (Stamps::Column | Stamps::Of { .. }, None, None) => {
            return Err(ReadError::NoTime { path: path.to_owned(), columns, notes: Notes::path_of(path) });
        }
    };
    let (rate, places) = match Stamped::of(&stamps).map_err(lost)?.map_err(fault)? {
        Stamped::Even { start, step } => (1.0 / step, even(start, step, stamps.count())?),
        Stamped::Uneven(odd) => {
            findings.extend(odd);
            let rate = 1.0 / usual_step(&stamps).map_err(lost)?;
            (rate, Places::Stamped { stamps, rate })
        }
    };
    findings.extend(differs(rate, "the stamps say", "the stamps are"));
    if let Some(rate_hz) = notes.rate_hz.filter(|rate_hz| (rate_hz / rate - 1.0).abs() > SAME_RATE) {
        let about = format!("the notes say {rate_hz} Hz, the stamps {rate:.6} Hz; the stamps are used");
        findings.push(Finding::new(FindingKind::HeaderDisagrees, 1, None, about));
    }
    Ok(places)
}

/// The stamps of a column in s or Hz.
fn seconds(column: &mut Column, over: Over, findings: &mut Vec<Finding>) -> Numbers {
    let due = if over == Over::Time { Quantity::Time } else { Quantity::Frequency };
    let unit = Unit::read(&column.unit).filter(|unit| unit.quantity == due);
    let factor = unit.as_ref().map_or(1.0, |unit| unit.factor);
    let si = if over == Over::Time { "s" } else { "Hz" };
    if unit.is_none() {
        let about = format!("the stamps tell no unit that is known; {si} is assumed");
        findings.push(Finding::new(FindingKind::Assumed, 1, None, about).of(&column.name));
    } else if factor != 1.0 {
        findings.push(
            Finding::new(FindingKind::Converted, 1, None, format!("stamps in {} times {factor} are {si}", column.unit)).of(&column.name),
        );
    }
    column.values.scale(factor);
    std::mem::replace(&mut column.values, Vec::new().into())
}

/// A column in SI, its samples not looked at yet.
pub(super) fn settled(mut column: Column, said: ChannelNotes, findings: &mut Vec<Finding>) -> SurveyedChannel {
    if let Some(levels) = Decibels::read(&column.unit) {
        findings.push(column.made_linear(levels));
    }
    let name = said.name.unwrap_or(column.name);
    let told = said.unit.unwrap_or(column.unit);
    let scale = said.scale.unwrap_or(1.0);
    let noticed = |kind, count, about: String| Finding::new(kind, count, None, about).of(&name);
    if !told.is_ascii() {
        findings.push(noticed(FindingKind::NonAsciiUnit, 1, format!("the unit {told:?} holds characters outside ASCII")));
    }
    let unit = Unit::read(&told);
    let factor = scale * unit.as_ref().map_or(1.0, |unit| unit.factor);
    if let Some(unit) = unit.as_ref().filter(|unit| unit.converts()) {
        let about = format!("values in {told} times {} are {}", unit.factor, unit.si);
        findings.push(noticed(FindingKind::Converted, column.values.count(), about));
    }
    if unit.is_none() && !told.trim().is_empty() && told.trim() != "NONE" {
        findings.push(noticed(FindingKind::UnknownUnit, 1, format!("the unit {told:?} is not known; values are as in the file")));
    }
    let (quantity, unit) = unit.map_or((Quantity::Unknown, told.clone()), |unit| (unit.quantity, unit.si.into_owned()));
    let Column { mut values, mut imaginary, .. } = column;
    values.scale(factor);
    imaginary.iter_mut().for_each(|numbers| numbers.scale(factor));
    let (place, direction) = (said.place.unwrap_or(column.place), said.direction.unwrap_or(column.direction));
    let reference = said.reference.unwrap_or(column.reference);
    let sizes = Sizes { rms: f64::NAN, peak: f64::NAN };
    SurveyedChannel { name, quantity, unit, place, direction, reference, sizes, values, imaginary }
}
