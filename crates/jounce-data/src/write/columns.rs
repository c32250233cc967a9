//! Converts a recording to consecutive tables of some rows each.

use jounce_io::table::{Column, Manifest, Table};

use super::WriteError;
use crate::read::{ChannelSummary, ColumnNumbers, DIRECTION, PLACE, REFERENCE, RecordingSummary};
use crate::recording::{Over, PIECE, Series};

/// Numbers per table, over all columns.
const NUMBERS: usize = 1 << 20;

/// Tables with `time_s` or `frequency_hz`, then the channels; complex ones as `NAME.re` and
/// `NAME.im`. If the format has no units, they follow the names: `NAME [UNIT]`.
pub(super) fn tables(
    recording: &RecordingSummary,
    units_in_names: bool,
) -> impl Iterator<Item = Result<Table, WriteError>> {
    let width = 1 + recording
        .channels
        .iter()
        .map(|channel| 1 + usize::from(channel.imaginary.is_some()))
        .sum::<usize>();
    let pieces = recording.places.count().div_ceil(PIECE).max(1);
    let block_pieces = (NUMBERS / width / PIECE).max(1);
    (0..pieces).step_by(block_pieces).map(move |first| {
        table(
            recording,
            units_in_names,
            first..(first + block_pieces).min(pieces),
        )
    })
}

fn table(
    recording: &RecordingSummary,
    units_in_names: bool,
    pieces: std::ops::Range<usize>,
) -> Result<Table, WriteError> {
    let column_name = |name: &str, unit: &str| {
        if units_in_names && !unit.is_empty() {
            format!("{name} [{unit}]")
        } else {
            name.to_owned()
        }
    };
    let (name, unit) = if recording.over == Over::Time {
        ("time_s", "s")
    } else {
        ("frequency_hz", "Hz")
    };
    let mut table = Table::new(vec![Column::new(
        name,
        unit,
        "position of the sample",
        rows(&recording.places, &pieces)?,
    )])?;
    for channel in &recording.channels {
        let position = [channel.place.as_str(), channel.direction.as_str()].join(" ");
        let mut write_column = |name: &str, numbers: &ColumnNumbers| -> Result<(), WriteError> {
            Ok(table.push(Column::new(
                &column_name(name, &channel.unit),
                &channel.unit,
                position.trim(),
                rows(numbers, &pieces)?,
            ))?)
        };
        match &channel.imaginary {
            None => write_column(&channel.name, &channel.values)?,
            Some(imaginary) => {
                write_column(&format!("{}.re", channel.name), &channel.values)?;
                write_column(&format!("{}.im", channel.name), imaginary)?;
            }
        }
    }
    Ok(table)
}

fn rows(
    numbers: &impl Series<Fault = std::io::Error>,
    pieces: &std::ops::Range<usize>,
) -> Result<Vec<f64>, WriteError> {
    let mut rows = Vec::new();
    for index in pieces.clone() {
        rows.extend_from_slice(&numbers.piece(index)?);
    }
    Ok(rows)
}

/// Manifest of the recording: its issues, and location, direction and reference of its channels.
pub(super) fn manifest(recording: &RecordingSummary) -> Manifest {
    let issues: Vec<String> = recording.issues.iter().map(ToString::to_string).collect();
    let manifest = Manifest::new("")
        .with("recording", &recording.name)
        .with("issues", issues.join("; "));
    let attributes_of = |channel: &ChannelSummary| {
        let attributes = [
            (PLACE, &channel.place),
            (DIRECTION, &channel.direction),
            (REFERENCE, &channel.reference),
        ];
        attributes.map(|(key, value)| (format!("{key}{}", channel.name), value.clone()))
    };
    let attributes = recording
        .channels
        .iter()
        .flat_map(attributes_of)
        .filter(|(_, value)| !value.is_empty());
    attributes.fold(manifest, |manifest, (key, value)| {
        manifest.with(&key, value)
    })
}
