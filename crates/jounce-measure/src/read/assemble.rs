//! Raw columns and notes to a recording: names, time, SI units, findings.

use std::path::Path;

use super::name::{is_frequency, is_time};
use super::raw::{Raw, RawChannel, Stamps};
use super::{ChannelNotes, Notes, ReadError};
use crate::recording::{Channel, Finding, FindingKind, Grid, Over, Quantity, Recording, Unit, inspect};

/// How far the rate of the notes may lie from that of the stamps, relative.
const SAME_RATE: f64 = 1e-3;

/// The recording of a data set.
pub(super) fn recording(path: &Path, name: String, mut raw: Raw, notes: &Notes) -> Result<Recording, ReadError> {
    let columns: Vec<String> = raw.channels.iter().map(|channel| channel.name.clone()).collect();
    let said: Vec<ChannelNotes> = columns.iter().enumerate().map(|(k, name)| notes.of(name, k + 1)).collect();
    check_notes(path, notes, &columns)?;
    let mut findings = std::mem::take(&mut raw.findings);
    if notes.over_frequency {
        raw.over = Over::Frequency;
    }
    let time = if raw.stamps == Stamps::Column { time_column(&mut raw, &said, notes) } else { None };
    let grid = grid(path, &mut raw, time, notes, columns, &mut findings)?;
    let mut channels = Vec::new();
    for (k, (column, said)) in raw.channels.into_iter().zip(said).enumerate() {
        if Some(k) != time && !said.left_out {
            channels.push(channel(column, said, &mut findings));
        }
    }
    findings.extend(channels.iter().flat_map(inspect));
    Ok(Recording { name, over: raw.over, grid, channels, findings })
}

/// Notes that name a column that is not there say so.
fn check_notes(path: &Path, notes: &Notes, columns: &[String]) -> Result<(), ReadError> {
    let there = |key: &String| columns.contains(key) || key.parse::<usize>().is_ok_and(|number| (1..=columns.len()).contains(&number));
    let named = notes.channels.keys().chain(&notes.time).filter(|key| !there(key));
    let faults: Vec<String> = named.map(|key| format!("there is no column {key:?}; the columns are {}", columns.join(", "))).collect();
    if faults.is_empty() { Ok(()) } else { Err(ReadError::Notes { path: Notes::path_of(path), faults }) }
}

/// The column that holds the time (or frequency): the one that the notes name, that a name tells, or a first one that ascends evenly.
fn time_column(raw: &mut Raw, said: &[ChannelNotes], notes: &Notes) -> Option<usize> {
    if let Some(wanted) = &notes.time {
        let numbered = || wanted.parse::<usize>().ok().and_then(|number| number.checked_sub(1));
        return raw.channels.iter().position(|channel| channel.name == *wanted).or_else(numbered);
    }
    if notes.rate_hz.is_some() {
        return None;
    }
    let name = |k: usize| said[k].name.as_deref().unwrap_or(&raw.channels[k].name);
    if let Some(k) = (0..raw.channels.len()).find(|k| is_time(name(*k))) {
        return Some(k);
    }
    if let Some(k) = (0..raw.channels.len()).find(|k| is_frequency(name(*k))) {
        raw.over = Over::Frequency;
        return Some(k);
    }
    (raw.channels.len() > 1 && ascends_evenly(&raw.channels[0].values)).then_some(0)
}

fn ascends_evenly(values: &[f64]) -> bool {
    let (Some(first), Some(last)) = (values.first(), values.last()) else { return false };
    let step = (last - first) / (values.len().max(2) - 1) as f64;
    step > 0.0 && values.len() > 2 && values.iter().enumerate().all(|(k, t)| ((t - first) / step - k as f64).abs() < 0.5)
}

fn grid(
    path: &Path,
    raw: &mut Raw,
    time: Option<usize>,
    notes: &Notes,
    columns: Vec<String>,
    findings: &mut Vec<Finding>,
) -> Result<Grid, ReadError> {
    let fault = |fault| ReadError::Grid { path: path.to_owned(), fault };
    let count = raw.channels.first().map_or(0, |channel| channel.values.len());
    let stamps = match (std::mem::replace(&mut raw.stamps, Stamps::Column), time, notes.rate_hz) {
        (Stamps::Even { start, step }, ..) => return Grid::even(start, step, count).map_err(fault),
        (Stamps::Given(stamps), ..) => stamps,
        // A time column is no channel: its numbers may be taken.
        (Stamps::Column, Some(k), _) => seconds(&mut raw.channels[k], raw.over, findings),
        (Stamps::Column, None, Some(rate_hz)) => return Grid::even(0.0, 1.0 / rate_hz, count).map_err(fault),
        (Stamps::Column, None, None) => {
            return Err(ReadError::NoTime { path: path.to_owned(), columns, notes: Notes::path_of(path) });
        }
    };
    let (grid, odd) = Grid::from_stamps(stamps).map_err(fault)?;
    findings.extend(odd);
    if let Some(rate_hz) = notes.rate_hz.filter(|rate_hz| (rate_hz / grid.rate() - 1.0).abs() > SAME_RATE) {
        let about = format!("the notes say {rate_hz} Hz, the stamps {:.6} Hz; the stamps are used", grid.rate());
        findings.push(Finding::new(FindingKind::HeaderDisagrees, 1, None, about));
    }
    Ok(grid)
}

/// The stamps of a column in s or Hz.
fn seconds(column: &mut RawChannel, over: Over, findings: &mut Vec<Finding>) -> Vec<f64> {
    let due = if over == Over::Time { Quantity::Time } else { Quantity::Frequency };
    let unit = Unit::read(&column.unit).filter(|unit| unit.quantity == due);
    let factor = unit.map_or(1.0, |unit| unit.factor);
    let si = if over == Over::Time { "s" } else { "Hz" };
    if unit.is_none() {
        let about = format!("the stamps tell no unit that is known; {si} is assumed");
        findings.push(Finding::new(FindingKind::Assumed, 1, None, about).of(&column.name));
    } else if factor != 1.0 {
        findings.push(
            Finding::new(FindingKind::Converted, 1, None, format!("stamps in {} times {factor} are {si}", column.unit)).of(&column.name),
        );
    }
    std::mem::take(&mut column.values).into_iter().map(|t| t * factor).collect()
}

/// A column in SI.
pub(super) fn channel(mut column: RawChannel, said: ChannelNotes, findings: &mut Vec<Finding>) -> Channel {
    if column.unit.get(..2).is_some_and(|start| start.eq_ignore_ascii_case("dB")) {
        findings.extend(column.made_linear());
    }
    let name = said.name.unwrap_or(column.name);
    let told = said.unit.unwrap_or(column.unit);
    let scale = said.scale.unwrap_or(1.0);
    let noticed = |kind, count, about: String| Finding::new(kind, count, None, about).of(&name);
    if !told.is_ascii() {
        findings.push(noticed(FindingKind::NonAsciiUnit, 1, format!("the unit {told:?} holds characters outside ASCII")));
    }
    let unit = Unit::read(&told);
    let factor = scale * unit.map_or(1.0, |unit| unit.factor);
    if let Some(unit) = unit.filter(Unit::converts) {
        let about = format!("values in {told} times {} are {}", unit.factor, unit.si);
        findings.push(noticed(FindingKind::Converted, column.values.len(), about));
    }
    if unit.is_none() && !told.trim().is_empty() && told.trim() != "NONE" {
        findings.push(noticed(FindingKind::UnknownUnit, 1, format!("the unit {told:?} is not known; values are as in the file")));
    }
    let scaled = |values: Vec<f64>| if factor == 1.0 { values } else { values.into_iter().map(|x| x * factor).collect() };
    let (quantity, unit) = unit.map_or((Quantity::Unknown, told.as_str()), |unit| (unit.quantity, unit.si));
    let mut channel = Channel::new(&name, quantity, unit, scaled(column.values));
    channel.imaginary = column.imaginary.map(scaled);
    channel.place = said.place.unwrap_or(column.place);
    channel.direction = said.direction.unwrap_or(column.direction);
    channel
}
