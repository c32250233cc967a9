//! A recording as a table.

use jounce::table::{Column, Manifest, Table, TableError};

use crate::recording::{Over, Recording};

/// `time_s` or `frequency_hz`, then the channels; complex ones as `NAME.re` and `NAME.im`. Where the format keeps no units of its own, they
/// stand behind the names: `NAME [UNIT]`.
pub(super) fn table(recording: &Recording, units_in_names: bool) -> Result<Table, TableError> {
    let named = |name: &str, unit: &str| if units_in_names && !unit.is_empty() { format!("{name} [{unit}]") } else { name.to_owned() };
    let (name, unit) = if recording.over == Over::Time { ("time_s", "s") } else { ("frequency_hz", "Hz") };
    let mut table = Table::new(vec![Column::new(name, unit, "where the sample lies", recording.grid.places())])?;
    for channel in &recording.channels {
        let about = [channel.place.as_str(), channel.direction.as_str()].join(" ");
        match &channel.imaginary {
            None => table.push(Column::new(&named(&channel.name, &channel.unit), &channel.unit, about.trim(), channel.values.clone()))?,
            Some(imaginary) => {
                table.push(Column::new(
                    &named(&format!("{}.re", channel.name), &channel.unit),
                    &channel.unit,
                    about.trim(),
                    channel.values.clone(),
                ))?;
                table.push(Column::new(
                    &named(&format!("{}.im", channel.name), &channel.unit),
                    &channel.unit,
                    about.trim(),
                    imaginary.clone(),
                ))?;
            }
        }
    }
    Ok(table)
}

/// The recording and what was found in it.
pub(super) fn manifest(recording: &Recording) -> Manifest {
    let findings: Vec<String> = recording.findings.iter().map(ToString::to_string).collect();
    Manifest::new("").with("recording", &recording.name).with("findings", findings.join("; "))
}
