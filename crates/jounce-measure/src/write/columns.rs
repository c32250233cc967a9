//! Converts a recording to consecutive tables of some rows each.

use jounce_core::table::{Column, Manifest, Table};

use super::WriteError;
use jounce_data::read::{
    ChannelSummary, ColumnNumbers, DIRECTION, PLACE, REFERENCE, RecordingSummary,
};
use jounce_data::recording::{Over, PIECE, Series};

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
    let together = (NUMBERS / width / PIECE).max(1);
    (0..pieces).step_by(together).map(move |first| {
        table(
            recording,
            units_in_names,
            first..(first + together).min(pieces),
        )
    })
}

fn table(
    recording: &RecordingSummary,
    units_in_names: bool,
    pieces: std::ops::Range<usize>,
) -> Result<Table, WriteError> {
    let named = |name: &str, unit: &str| {
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
        let about = [channel.place.as_str(), channel.direction.as_str()].join(" ");
        let mut push = |name: &str, numbers: &ColumnNumbers| -> Result<(), WriteError> {
            Ok(table.push(Column::new(
                &named(name, &channel.unit),
                &channel.unit,
                about.trim(),
                rows(numbers, &pieces)?,
            ))?)
        };
        match &channel.imaginary {
            None => push(&channel.name, &channel.values)?,
            Some(imaginary) => {
                push(&format!("{}.re", channel.name), &channel.values)?;
                push(&format!("{}.im", channel.name), imaginary)?;
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
    let findings: Vec<String> = recording.findings.iter().map(ToString::to_string).collect();
    let manifest = Manifest::new("")
        .with("recording", &recording.name)
        .with("findings", findings.join("; "));
    let told = |channel: &ChannelSummary| {
        let told = [
            (PLACE, &channel.place),
            (DIRECTION, &channel.direction),
            (REFERENCE, &channel.reference),
        ];
        told.map(|(key, told)| (format!("{key}{}", channel.name), told.clone()))
    };
    let told = recording
        .channels
        .iter()
        .flat_map(told)
        .filter(|(_, told)| !told.is_empty());
    told.fold(manifest, |manifest, (key, told)| manifest.with(&key, told))
}
