//! Points of a force table in a file: one column in a unit of length, one in a unit of force.

use std::path::Path;

use jounce_data::read::{self, Notes, RecordingSummary};
use jounce_data::recording::{Channel, Quantity};

use crate::validation::force_table::faults_of;
use crate::{ForceTable, Spec, StopLaw};

/// Reads the points of every table that names a file; returns the faults of the files by key.
pub(crate) fn read_all(folder: &Path, spec: &mut Spec) -> Vec<(String, String)> {
    let mut faults = Vec::new();
    for (name, stop) in &mut spec.stop {
        if !matches!(stop.law, StopLaw::Table { .. }) || stop.table.file.is_empty() {
            continue;
        }
        let path = folder.join(&stop.table.file);
        match read(&path) {
            Ok(table) => stop.table = table,
            Err(messages) => faults.extend(messages.into_iter().map(|message| {
                let key = format!("stop.{name}.file");
                let message = format!("{key}: {message}");
                (key, message)
            })),
        }
    }
    faults
}

/// Reads the points in SI.
///
/// # Errors
/// One sentence with the file for each fault.
fn read(path: &Path) -> Result<ForceTable, Vec<String>> {
    let one = |message: String| vec![message];
    // The rows are points, not samples: a rate in place of times lets every column be a channel.
    let notes = Notes {
        rate_hz: Some(1.0),
        ..Notes::for_file(path).map_err(|error| one(error.to_string()))?
    };
    let summary = read::record_summary_with_notes(path, &notes);
    let summary = summary.map_err(|error| one(error.to_string()))?;
    let in_file = |message: String| format!("{}: {message}", path.display());
    let found = [
        column(&summary, Quantity::Displacement, "length", "mm"),
        column(&summary, Quantity::Force, "force", "N"),
    ];
    let (at, force) = match found {
        [Ok(at), Ok(force)] => (at, force),
        found => {
            let missing = found.into_iter().filter_map(Result::err);
            return Err(missing.map(in_file).collect());
        }
    };
    let recording = summary
        .into_recording_of(&[at, force])
        .map_err(|error| one(in_file(error.to_string())))?;
    let [at, force] = &recording.channels[..] else {
        return Err(one(in_file("it has no two columns".to_owned())));
    };
    let wrong: Vec<String> = [at, force].into_iter().filter_map(wrong_number).collect();
    if !wrong.is_empty() {
        return Err(wrong.into_iter().map(in_file).collect());
    }
    let table = ForceTable {
        penetration_m: at.values.clone(),
        force_n: force.values.clone(),
        file: String::new(),
    };
    let name = |key: &str| {
        if key == "force_n" {
            &force.name
        } else {
            &at.name
        }
    };
    let faults: Vec<String> = faults_of(&table)
        .into_iter()
        .map(|(key, text)| in_file(format!("column {} {text}", name(key))))
        .collect();
    if faults.is_empty() {
        Ok(table)
    } else {
        Err(faults)
    }
}

/// Returns the number of the only column in a unit of a quantity.
fn column(
    summary: &RecordingSummary,
    quantity: Quantity,
    what: &str,
    unit: &str,
) -> Result<usize, String> {
    let heads = summary.heads();
    let fits: Vec<usize> = (0..heads.len())
        .filter(|k| heads[*k].quantity == quantity)
        .collect();
    let names = |of: &[usize]| {
        let name = |k: &usize| match heads[*k].has_unit() {
            true => format!("{} ({})", heads[*k].name, heads[*k].unit),
            false => heads[*k].name.to_owned(),
        };
        of.iter().map(name).collect::<Vec<_>>().join(", ")
    };
    match fits[..] {
        [only] => Ok(only),
        [] => Err(format!(
            "no column is in a unit of {what}; the columns are {}; write the unit in the header, as in {what} [{unit}], or in the notes of the file",
            names(&(0..heads.len()).collect::<Vec<_>>())
        )),
        _ => Err(format!(
            "several columns are in a unit of {what}: {}; leave one in the file",
            names(&fits)
        )),
    }
}

/// Returns the fault of the first number that is missing or negative.
fn wrong_number(channel: &Channel) -> Option<String> {
    let is_wrong = |value: &f64| !(value.is_finite() && *value >= 0.0);
    let index = channel.values.iter().position(is_wrong)?;
    let (value, number) = (channel.values[index], index + 1);
    let (name, unit) = (&channel.name, &channel.unit);
    Some(match value.is_nan() {
        true => {
            format!("column {name} has no number in row {number} of the points; remove the row")
        }
        false => format!(
            "column {name} has {value} {unit} as number {number}; it must be at least 0: change the sign of the column, or remove the row"
        ),
    })
}
