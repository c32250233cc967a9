//! Notes of a file: information that the file itself lacks.

pub(super) mod written;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use jounce_units::Quantity as Spec;
use toml_edit::{DocumentMut, Item, Table};

use crate::read::ReadError;
use crate::recording::Unit;

/// Contents of a file of notes. The notes of `measurement.npy` are in
/// `measurement.npy.channels.toml`:
///
/// ```toml
/// rate = "25600 Hz"         # where no column holds the time
/// time = "1"                # the column of the time, by name or by number from 1
/// over = "frequency"        # where the samples are a spectrum
///
/// [channel."2"]             # by name or by number from 1
/// name = "hammer"
/// unit = "N"
/// scale = 1.0               # times the number in the file is the value in the unit
/// place = "free end"
/// direction = "-z"
/// reference = "node 3 +z"   # of a response function, where and which way the force acts
///
/// [channel.temp_c]
/// use = false
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Notes {
    /// Sampling rate, Hz.
    pub rate_hz: Option<f64>,
    /// Name or number of the time column.
    pub time: Option<String>,
    /// True for spectra, sampled over frequency.
    pub over_frequency: bool,
    /// Notes on channels, by name or number.
    pub channels: BTreeMap<String, ChannelNotes>,
}

/// Notes on one channel.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ChannelNotes {
    /// New name.
    pub name: Option<String>,
    /// Unit of the stored numbers times `scale`.
    pub unit: Option<String>,
    /// Factor that converts the stored numbers to the unit.
    pub scale: Option<f64>,
    /// Location of the sensor.
    pub place: Option<String>,
    /// Direction of the sensor.
    pub direction: Option<String>,
    /// Node and direction of the force of a response function.
    pub reference: Option<String>,
    /// True where the channel is left out.
    pub left_out: bool,
}

const KEYS: [&str; 4] = ["rate", "time", "over", "channel"];
const CHANNEL_KEYS: [&str; 7] = [
    "name",
    "unit",
    "scale",
    "place",
    "direction",
    "reference",
    "use",
];

impl Notes {
    /// Returns the path of the notes of a file.
    pub fn path_of(file: &Path) -> PathBuf {
        let mut name = file.as_os_str().to_owned();
        name.push(".channels.toml");
        PathBuf::from(name)
    }

    /// Reads the notes of a file; they are empty if there is no such file.
    ///
    /// # Errors
    /// Notes that cannot be read or contain faults; all faults at once.
    pub fn for_file(file: &Path) -> Result<Self, ReadError> {
        let path = Self::path_of(file);
        match std::fs::read_to_string(&path) {
            Ok(text) => Self::from_toml(&text).map_err(|faults| ReadError::Notes { path, faults }),
            Err(reason) if reason.kind() == std::io::ErrorKind::NotFound => Ok(Self::default()),
            Err(reason) => Err(ReadError::Open { path, reason }),
        }
    }

    /// Parses notes from text.
    ///
    /// # Errors
    /// One sentence for each fault.
    pub fn from_toml(text: &str) -> Result<Self, Vec<String>> {
        let document = text
            .parse::<DocumentMut>()
            .map_err(|fault| vec![fault.to_string().trim_end().to_owned()])?;
        let (mut notes, mut faults) = (Self::default(), unknown(document.as_table(), &KEYS, ""));
        if let Some(rate) = text_of(document.as_table(), "rate", "", &mut faults) {
            match Spec::Frequency.read(&rate) {
                Ok(rate_hz) if rate_hz > 0.0 => notes.rate_hz = Some(rate_hz),
                Ok(_) => faults.push(format!("rate = {rate:?} must be above 0 Hz")),
                Err(fault) => faults.push(format!("rate: {fault}")),
            }
        }
        notes.time = text_of(document.as_table(), "time", "", &mut faults);
        match text_of(document.as_table(), "over", "", &mut faults).as_deref() {
            None | Some("time") => {}
            Some("frequency") => notes.over_frequency = true,
            Some(other) => faults.push(format!(
                "over = {other:?} must be \"time\" or \"frequency\""
            )),
        }
        match document.get("channel") {
            None => {}
            Some(Item::Table(channels)) => {
                for (key, item) in channels {
                    match item.as_table() {
                        Some(table) => drop(
                            notes
                                .channels
                                .insert(key.to_owned(), channel(key, table, &mut faults)),
                        ),
                        None => {
                            faults.push(format!("channel.{key} must be a table: [channel.{key}]"))
                        }
                    }
                }
            }
            Some(_) => faults.push("channel must be tables: [channel.NAME]".to_owned()),
        }
        if faults.is_empty() {
            Ok(notes)
        } else {
            Err(faults)
        }
    }

    /// Returns the notes on a channel by its name or number from 1.
    pub(in crate::read) fn for_channel(&self, name: &str, number: usize) -> ChannelNotes {
        self.channels
            .get(name)
            .or_else(|| self.channels.get(&number.to_string()))
            .cloned()
            .unwrap_or_default()
    }
}

fn channel(name: &str, table: &Table, faults: &mut Vec<String>) -> ChannelNotes {
    let prefix = format!("channel.{name}.");
    faults.extend(unknown(table, &CHANNEL_KEYS, &prefix));
    let unit = text_of(table, "unit", &prefix, faults);
    if let Some(unit) = unit.as_ref().filter(|unit| Unit::read(unit).is_none()) {
        faults.push(format!(
            "{prefix}unit = {unit:?} is not a known unit; expected one such as \
            m/s^2, g, N, lbf, V, m, Pa, s or Hz"
        ));
    }
    let scale = table.get("scale").and_then(|item| {
        item.as_float()
            .or_else(|| item.as_integer().map(|integer| integer as f64))
    });
    if table.contains_key("scale") && !scale.is_some_and(|scale| scale.is_finite() && scale != 0.0)
    {
        faults.push(format!("{prefix}scale must be a number other than 0"));
    }
    let left_out = match table.get("use").map(Item::as_bool) {
        Some(None) => {
            faults.push(format!("{prefix}use must be true or false"));
            false
        }
        Some(Some(is_used)) => !is_used,
        None => false,
    };
    ChannelNotes {
        name: text_of(table, "name", &prefix, faults),
        unit,
        scale,
        place: text_of(table, "place", &prefix, faults),
        direction: text_of(table, "direction", &prefix, faults),
        reference: text_of(table, "reference", &prefix, faults),
        left_out,
    }
}

fn text_of(table: &Table, key: &str, prefix: &str, faults: &mut Vec<String>) -> Option<String> {
    let item = table.get(key)?;
    if item.as_str().is_none() {
        faults.push(format!("{prefix}{key} must be a text in quotes"));
    }
    item.as_str().map(str::to_owned)
}

fn unknown(table: &Table, keys: &[&str], prefix: &str) -> Vec<String> {
    let unknown_keys = table
        .iter()
        .map(|(key, _)| key)
        .filter(|key| !keys.contains(key));
    unknown_keys
        .map(|key| {
            format!(
                "{prefix}{key} is not a key of notes; the keys are {}",
                keys.join(", ")
            )
        })
        .collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn notes_are_read_and_all_faults_are_listed() {
        let notes = Notes::from_toml(
            "rate = \"25.6 kHz\"\n[channel.2]\nunit = \"N\"\nscale = 2\n[channel.b]\nuse = false\n",
        )
        .unwrap();
        assert_eq!(notes.rate_hz, Some(25_600.0));
        assert_eq!(notes.for_channel("x", 2).scale, Some(2.0));
        assert!(notes.for_channel("b", 3).left_out);
        let invalid = "rate = 5\nspeed = 1\n[channel.a]\nunit = \"furlong\"\nscale = 0\nuse = 1\ncolour = \"red\"\n";
        let faults = Notes::from_toml(invalid).unwrap_err();
        assert_eq!(faults.len(), 6, "{faults:?}");
        assert!(Notes::from_toml("[channel").is_err());
    }
}
