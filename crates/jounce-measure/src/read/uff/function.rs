//! Data set 58: one function over time or frequency.

use super::super::error::Damage;
use super::super::raw::{Raw, RawChannel, Stamps};
use super::blocks::{Block, Data};
use super::header::{Dof, Header};
use crate::recording::{Over, Place};

/// Function types over time: time response, auto- and cross-correlation, shock.
const OVER_TIME: [u32; 4] = [1, 5, 7, 24];

pub(super) fn read(block: Block) -> Result<Raw, Damage> {
    let header = Header::read(&block)?;
    let numbers = match block.data {
        Data::Binary { little_endian, bytes } => from_bytes(&header, &bytes, little_endian),
        Data::Numbers(found, wrong) => from_lines(found, wrong, &header),
    };
    let mut numbers = numbers.map_err(|why| Damage::at(Place::Byte(block.start), why))?;
    let over = match header.abscissa.kind {
        17 => Over::Time,
        18 => Over::Frequency,
        _ if header.abscissa.unit.eq_ignore_ascii_case("hz") => Over::Frequency,
        _ if OVER_TIME.contains(&header.function) || header.function == 0 => Over::Time,
        _ => Over::Frequency,
    };
    let width = header.width();
    let mut column = |k: usize| -> Vec<f64> {
        if width == 1 { std::mem::take(&mut numbers) } else { numbers.chunks_exact(width).map(|point| point[k]).collect() }
    };
    let first = usize::from(!header.even);
    let stamps = if header.even { Stamps::Even { start: header.start, step: header.step } } else { Stamps::Given(column(0)) };
    let channel = RawChannel {
        name: name(&header),
        unit: unit(&header),
        place: place(&header.response),
        direction: direction(&header.response),
        values: column(first),
        imaginary: header.complex.then(|| column(first + 1)),
    };
    Ok(Raw { title: header.title, over, stamps, channels: vec![channel], findings: Vec::new() })
}

/// Functions over the same grid become channels of one set; names used twice get their place, and a number where that is not enough.
pub(super) fn grouped(sets: Vec<Raw>) -> Vec<Raw> {
    let mut groups: Vec<Raw> = Vec::new();
    for set in sets {
        let length = |raw: &Raw| raw.channels.first().map_or(0, |channel| channel.values.len());
        match groups.iter_mut().find(|group| group.stamps == set.stamps && group.over == set.over && length(group) == length(&set)) {
            Some(group) => group.channels.extend(set.channels),
            None => groups.push(set),
        }
    }
    for group in &mut groups {
        rename(&mut group.channels, |channel, _| format!("{} {} {}", channel.name, channel.place, channel.direction).trim_end().to_owned());
        rename(&mut group.channels, |channel, number| format!("{} ({number})", channel.name));
    }
    groups
}

/// Gives a new name to every channel whose name is used twice.
fn rename(channels: &mut [RawChannel], new: impl Fn(&RawChannel, usize) -> String) {
    let names: Vec<String> = channels.iter().map(|channel| channel.name.clone()).collect();
    for (k, channel) in channels.iter_mut().enumerate() {
        if names.iter().filter(|name| **name == channel.name).count() > 1 {
            channel.name = new(channel, k + 1);
        }
    }
}

fn from_lines(mut found: Vec<f64>, wrong: Option<String>, header: &Header) -> Result<Vec<f64>, String> {
    if let Some(word) = wrong {
        return Err(format!("{word:?} among the data is no number"));
    }
    let due = header.points.saturating_mul(header.width());
    if found.len() < due {
        return Err(format!("{due} numbers are due, {} follow: was the file cut?", found.len()));
    }
    // A last line may be filled up.
    found.truncate(due);
    Ok(found)
}

/// Binary numbers: all of one size, or an uneven abscissa in single precision beside double ordinates; the length tells which.
fn from_bytes(header: &Header, bytes: &[u8], little_endian: bool) -> Result<Vec<f64>, String> {
    let (points, width) = (header.points, header.width());
    let size = if header.double { 8 } else { 4 };
    let whole = points.checked_mul(width * size);
    let mixed = points.checked_mul(4 + (width - 1) * size);
    let length = bytes.len();
    let single_abscissa = header.double && !header.even && Some(length) == mixed;
    if Some(length) != whole && !single_abscissa {
        return Err(format!("{points} points of {width} numbers of {size} bytes are due, {length} bytes follow"));
    }
    let mut found = Vec::with_capacity(points * width);
    let mut rest = bytes;
    while !rest.is_empty() {
        let wide = header.double && !(single_abscissa && found.len() % width == 0);
        let (number, behind) = rest.split_at_checked(if wide { 8 } else { 4 }).ok_or("the data end inside a number")?;
        found.push(number_of(number, little_endian));
        rest = behind;
    }
    Ok(found)
}

fn number_of(bytes: &[u8], little_endian: bool) -> f64 {
    match (<[u8; 8]>::try_from(bytes), <[u8; 4]>::try_from(bytes)) {
        (Ok(eight), _) => {
            if little_endian {
                f64::from_le_bytes(eight)
            } else {
                f64::from_be_bytes(eight)
            }
        }
        (_, Ok(four)) => f64::from(if little_endian { f32::from_le_bytes(four) } else { f32::from_be_bytes(four) }),
        _ => f64::NAN,
    }
}

/// The ordinate's label, or the response's name.
fn name(header: &Header) -> String {
    let named = [&header.ordinate.label, &header.response.name].into_iter().find(|name| !name.is_empty() && *name != "NONE");
    named.cloned().unwrap_or_else(|| format!("function {}", header.function))
}

fn unit(header: &Header) -> String {
    let (unit, below) = (&header.ordinate.unit, &header.denominator.unit);
    // The ordinate of some programs holds the whole quotient already.
    if below.is_empty() || unit.contains('/') && unit.ends_with(below.as_str()) || header.function != 4 {
        unit.clone()
    } else {
        format!("{unit}/{below}")
    }
}

fn place(dof: &Dof) -> String {
    if dof.node == 0 { String::new() } else { format!("node {}", dof.node) }
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
