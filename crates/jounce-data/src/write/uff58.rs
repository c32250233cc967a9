//! UFF 58 in ASCII, double precision, readable by pyuff and the modal packages.
//!
//! Real samples are type 4, complex ones type 6; uniform grids store start and step, stamped ones
//! each abscissa. The abscissa of an uneven grid has the 13 columns of its format, seven digits,
//! and so has the step of a uniform one (relative error 5e-7 at most).

use std::io::Write;

use super::WriteError;
use crate::read::{ChannelSummary, RecordingSummary, SamplePlaces};
use crate::recording::{Over, PIECE, Quantity, Series};

/// Writes one data set for each channel, piece by piece.
pub(super) fn encode(recording: &RecordingSummary, mut to: impl Write) -> Result<(), WriteError> {
    fits("the recording", "name", &recording.name, LINE_COLUMNS)?;
    for (k, channel) in recording.channels.iter().enumerate() {
        finite(channel)?;
        fits(&channel.name, "name", &channel.name, LINE_COLUMNS)?;
        fits(&channel.name, "unit", &channel.unit, LABEL_COLUMNS)?;
        fits(
            &channel.name,
            "place",
            node_position(channel, 0).0,
            NAME_COLUMNS,
        )?;
        fits(
            &channel.name,
            "place of the force",
            reference(channel).0,
            NAME_COLUMNS,
        )?;
        writeln!(to, "    -1\n    58")?;
        header(&mut to, recording, channel, k + 1)?;
        data(&mut to, recording, channel)?;
        writeln!(to, "    -1")?;
    }
    Ok(to.flush()?)
}

/// Columns of a line of the header, of a label or a unit, and of the name of a location.
const LINE_COLUMNS: usize = 80;
const LABEL_COLUMNS: usize = 20;
const NAME_COLUMNS: usize = 10;

/// Refuses a text that would be truncated or altered.
fn fits(of: &str, what: &'static str, text: &str, most: usize) -> Result<(), WriteError> {
    if let Some(letter) = text.chars().find(|c| !(c.is_ascii_graphic() || *c == ' ')) {
        return Err(WriteError::NotAscii {
            channel: of.to_owned(),
            what,
            text: text.to_owned(),
            letter,
        });
    }
    let length = text.chars().count();
    if length <= most {
        Ok(())
    } else {
        Err(WriteError::Long {
            channel: of.to_owned(),
            what,
            text: text.to_owned(),
            length,
            most,
        })
    }
}

/// Refuses a channel with a sample that is not finite.
fn finite(channel: &ChannelSummary) -> Result<(), WriteError> {
    for numbers in std::iter::once(&channel.values).chain(&channel.imaginary) {
        let (mut sample, mut first_non_finite) = (0, None);
        numbers.each(|x| {
            first_non_finite = first_non_finite.or((!x.is_finite()).then_some((sample, x)));
            sample += 1;
        })?;
        if let Some((sample, value)) = first_non_finite {
            return Err(WriteError::NotFinite {
                channel: channel.name.clone(),
                sample,
                value,
            });
        }
    }
    Ok(())
}

fn header(
    to: &mut impl Write,
    recording: &RecordingSummary,
    channel: &ChannelSummary,
    number: usize,
) -> std::io::Result<()> {
    let over_time = recording.over == Over::Time;
    let function = match (over_time, channel.quantity) {
        (true, _) => 1,
        (false, Quantity::AccelerationPsd | Quantity::ForcePsd) => 9,
        (false, _) if channel.imaginary.is_some() => 4,
        (false, _) => 12,
    };
    let kind = if channel.imaginary.is_some() { 6 } else { 4 };
    let (start, step, is_uniform) = match recording.places {
        SamplePlaces::Even { start, step, .. } => (start, step, 1),
        SamplePlaces::Stamped { .. } => (0.0, 0.0, 0),
    };
    let (place, node) = node_position(channel, number);
    writeln!(
        to,
        "{:<80}\n{:<80}\n{:<80}\n{:<80}\n{:<80}",
        recording.name, "NONE", "NONE", channel.name, "NONE"
    )?;
    let (to_place, to_node, to_direction) = reference(channel);
    let direction = direction(&channel.direction);
    writeln!(
        to,
        "{function:>5}{number:>10}{:>5}{:>10} {:<10}{node:>10}{direction:>4} {to_place:<10}{to_node:>10}{to_direction:>4}",
        0, 0, place,
    )?;
    writeln!(
        to,
        "{kind:>10}{:>10}{is_uniform:>10} {} {} {}",
        channel.values.count(),
        e12(start),
        e12(step),
        e12(0.0)
    )?;
    let (abscissa, label, unit) = if over_time {
        (17, "Time", "s")
    } else {
        (18, "Frequency", "Hz")
    };
    axis(to, abscissa, label, unit)?;
    axis(to, specific(channel.quantity), &channel.name, &channel.unit)?;
    axis(to, 0, "NONE", "NONE")?;
    axis(to, 0, "NONE", "NONE")
}

fn axis(to: &mut impl Write, kind: u32, label: &str, unit: &str) -> std::io::Result<()> {
    let unit = if unit.is_empty() { "NONE" } else { unit };
    writeln!(
        to,
        "{kind:>10}{:>5}{:>5}{:>5} {:<20} {:<20}",
        0,
        0,
        0,
        label.chars().take(LABEL_COLUMNS).collect::<String>(),
        unit
    )
}

fn data(
    to: &mut impl Write,
    recording: &RecordingSummary,
    channel: &ChannelSummary,
) -> std::io::Result<()> {
    let is_stamped = matches!(recording.places, SamplePlaces::Stamped { .. });
    let points_in_line = match (is_stamped, channel.imaginary.is_some()) {
        (false, false) => 4,
        (true, true) => 1,
        _ => 2,
    };
    let count = channel.values.count();
    for index in 0..count.div_ceil(PIECE) {
        let (abscissae, values) = (recording.places.piece(index)?, channel.values.piece(index)?);
        let imaginary = channel
            .imaginary
            .as_ref()
            .map(|imaginary| imaginary.piece(index))
            .transpose()?;
        for (k, value) in values.iter().enumerate() {
            if let (true, Some(place)) = (is_stamped, abscissae.get(k)) {
                write!(to, " {}", e12(*place))?;
            }
            write!(to, "{}", e20(*value))?;
            if let Some(imaginary) = imaginary.as_ref().and_then(|imaginary| imaginary.get(k)) {
                write!(to, "{}", e20(*imaginary))?;
            }
            let row = index * PIECE + k + 1;
            if row.is_multiple_of(points_in_line) || row == count {
                writeln!(to)?;
            }
        }
    }
    Ok(())
}

/// Formats `E20.11E3`-like with two digits of exponent where they suffice: 20 columns.
fn e20(value: f64) -> String {
    format!("{:>20}", fortran(value, 12))
}

/// Formats in 12 columns: as many digits as fit with the sign.
fn e12(value: f64) -> String {
    format!(
        "{:>12}",
        fortran(value, if value.is_sign_negative() { 5 } else { 6 })
    )
}

/// Converts Rust's `1.23400e1` to `1.23400E+01`.
fn fortran(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    format!(
        "{mantissa}E{}{:02}",
        if exponent < 0 { '-' } else { '+' },
        exponent.abs()
    )
}

/// Code of the measured quantity.
fn specific(quantity: Quantity) -> u32 {
    match quantity {
        Quantity::Acceleration | Quantity::AccelerationPsd => 12,
        Quantity::Velocity => 11,
        Quantity::Displacement => 8,
        Quantity::Force | Quantity::ForcePsd => 13,
        Quantity::Pressure => 15,
        Quantity::Time => 17,
        Quantity::Frequency => 18,
        Quantity::Voltage | Quantity::Response | Quantity::Number | Quantity::Unknown => 0,
    }
}

/// Parses a node number.
fn node(place: &str) -> Option<usize> {
    place.strip_prefix("node ")?.parse().ok()
}

/// Name and node of a channel: a location is a node, or a name, which would be lost if a number
/// were also written; a channel without one is a separate node.
fn node_position(channel: &ChannelSummary, number: usize) -> (&str, usize) {
    match (channel.place.as_str(), node(&channel.place)) {
        ("", _) => ("NONE", number),
        (_, Some(node)) => ("NONE", node),
        (name, None) => (name, 0),
    }
}

/// Name, node and direction of the reference force of a response function.
fn reference(channel: &ChannelSummary) -> (&str, usize, i32) {
    let text = channel.reference.as_str();
    let (place, sense) = text
        .rsplit_once(' ')
        .map_or((text, 0), |(place, direction_text)| {
            (place, direction(direction_text))
        });
    let place = if sense == 0 { text } else { place };
    match (place, node(place)) {
        ("", _) => ("NONE", 0, 0),
        (_, Some(node)) => ("NONE", node, sense),
        (name, None) => (name, 0, sense),
    }
}

/// Codes `+x` as 1 to `-z` as -3; 0 for any other text.
fn direction(text: &str) -> i32 {
    let sign = if text.starts_with('-') { -1 } else { 1 };
    let axis = match text.trim_start_matches(['+', '-']) {
        "x" => 1,
        "y" => 2,
        "z" => 3,
        _ => 0,
    };
    sign * axis
}
