//! What was measured, and which keys may move: a TOML file.

use std::path::Path;

use jounce::spec::Quantity;
use toml_edit::{DocumentMut, Item, Table};

use super::FitError;

/// A measured mode.
#[derive(Debug, Clone, PartialEq)]
pub struct ModeFeature {
    /// Its number in the model, from 1.
    pub number: usize,
    /// Frequency, Hz, and its relative standard deviation.
    pub frequency: Option<(f64, f64)>,
    /// Damping ratio and its relative standard deviation.
    pub damping_ratio: Option<(f64, f64)>,
}

/// Measured modes and free keys.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Features {
    /// Bodies that were held in the test.
    pub hold: Vec<String>,
    /// Free keys, each with the relative standard deviation of its prior.
    pub free: Vec<(String, f64)>,
    /// The modes.
    pub modes: Vec<ModeFeature>,
}

const KEYS: [&str; 5] = ["hold", "free", "mode", "frequency_deviation", "damping_deviation"];
const MODE_KEYS: [&str; 5] = ["number", "frequency", "frequency_deviation", "damping_ratio", "damping_deviation"];

impl Features {
    /// Reads a file.
    ///
    /// # Errors
    /// A file that cannot be read; every fault in it.
    pub fn read(path: &Path) -> Result<Self, FitError> {
        let text = std::fs::read_to_string(path).map_err(|reason| FitError::Open { path: path.to_owned(), reason })?;
        Self::from_toml(&text).map_err(|faults| FitError::Features {
            faults: faults.into_iter().map(|fault| format!("{}: {fault}", path.display())).collect(),
        })
    }

    /// The features of a text.
    ///
    /// # Errors
    /// One sentence for each fault.
    pub fn from_toml(text: &str) -> Result<Self, Vec<String>> {
        let document = text.parse::<DocumentMut>().map_err(|fault| vec![fault.to_string().trim_end().to_owned()])?;
        let (root, mut faults) = (document.as_table(), unknown(document.as_table(), &KEYS, ""));
        let hold = match root.get("hold").map(|item| item.as_array().map(|list| list.iter().map(|name| name.as_str()).collect())) {
            None => Some(Vec::new()),
            Some(Some(names)) => names,
            Some(None) => None,
        };
        if hold.is_none() {
            faults.push("hold must be a list of names, as in hold = [\"table\"]".to_owned());
        }
        let mut free = Vec::new();
        for (key, item) in root.get("free").and_then(Item::as_table_like).into_iter().flat_map(|table| table.iter()) {
            match positive(item) {
                Some(deviation) => free.push((key.to_owned(), deviation)),
                None => faults.push(format!("free.{key:?} must be its relative standard deviation, a number above 0, as in 0.05")),
            }
        }
        if free.is_empty() && faults.is_empty() {
            faults.push("no key is free: give [free] with lines as \"beam.NAME.thickness\" = 0.01".to_owned());
        }
        let usual = [deviation(root, "frequency_deviation", "", &mut faults), deviation(root, "damping_deviation", "", &mut faults)];
        let tables: Vec<&Table> = root.get("mode").and_then(Item::as_array_of_tables).into_iter().flat_map(|modes| modes.iter()).collect();
        if tables.is_empty() {
            faults.push("no mode is given: write [[mode]] with number and frequency".to_owned());
        }
        let modes = tables.iter().enumerate().filter_map(|(k, table)| mode(table, k + 1, usual, &mut faults)).collect();
        let hold = hold.unwrap_or_default().into_iter().map(str::to_owned).collect();
        if faults.is_empty() { Ok(Self { hold, free, modes }) } else { Err(faults) }
    }
}

fn mode(table: &Table, place: usize, usual: [Option<f64>; 2], faults: &mut Vec<String>) -> Option<ModeFeature> {
    let place = format!("mode {place}, ");
    faults.extend(unknown(table, &MODE_KEYS, &place));
    let number =
        table.get("number").and_then(Item::as_integer).and_then(|number| usize::try_from(number).ok()).filter(|number| *number > 0);
    if number.is_none() {
        faults.push(format!("{place}number must be a whole number from 1"));
    }
    let own = [deviation(table, "frequency_deviation", &place, faults), deviation(table, "damping_deviation", &place, faults)];
    let frequency_hz = table.get("frequency").map(|item| item.as_str().and_then(|text| Quantity::Frequency.read(text).ok()));
    let damping = table.get("damping_ratio").map(positive);
    if frequency_hz.flatten().is_none_or(|hz| hz <= 0.0) && table.contains_key("frequency") {
        faults.push(format!("{place}frequency must be above 0, with its unit, as in \"9.01 Hz\""));
    }
    if damping == Some(None) {
        faults.push(format!("{place}damping_ratio must be a number above 0"));
    }
    if frequency_hz.is_none() && damping.is_none() {
        faults.push(format!("{place}there is neither frequency nor damping_ratio"));
    }
    let mut with = |value: Option<Option<f64>>, k: usize, name: &str| {
        let value = value.flatten()?;
        let deviation = own[k].or(usual[k]);
        if deviation.is_none() {
            faults.push(format!("{place}{name} is missing: the relative standard deviation, as in 0.002, here or at the top of the file"));
        }
        Some((value, deviation?))
    };
    let (frequency, damping_ratio) = (with(frequency_hz, 0, "frequency_deviation"), with(damping, 1, "damping_deviation"));
    Some(ModeFeature { number: number?, frequency, damping_ratio })
}

/// A relative deviation; a fault where it is there and no number above 0.
fn deviation(table: &Table, key: &str, place: &str, faults: &mut Vec<String>) -> Option<f64> {
    let item = table.get(key)?;
    let found = positive(item);
    if found.is_none() {
        faults.push(format!("{place}{key} must be a relative standard deviation, a number above 0, as in 0.002"));
    }
    found
}

fn positive(item: &Item) -> Option<f64> {
    let number = item.as_float().or_else(|| item.as_integer().map(|whole| whole as f64));
    number.filter(|x| *x > 0.0 && x.is_finite())
}

fn unknown(table: &Table, keys: &[&str], place: &str) -> Vec<String> {
    let strange = table.iter().map(|(key, _)| key).filter(|key| !keys.contains(key));
    strange.map(|key| format!("{place}{key} is no key of features; there are {}", keys.join(", "))).collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn features_are_read_and_all_faults_told_at_once() {
        let text = "hold = [\"table\"]\nfrequency_deviation = 0.002\n[free]\n\"beam.b.length\" = 0.01\n[[mode]]\nnumber = 2\nfrequency = \"1.5 kHz\"\n";
        let found = Features::from_toml(text).unwrap();
        assert_eq!((found.hold[0].as_str(), &found.free[0]), ("table", &("beam.b.length".to_owned(), 0.01)));
        assert_eq!(found.modes, [ModeFeature { number: 2, frequency: Some((1500.0, 0.002)), damping_ratio: None }]);
        let wrong = "hold = 3\nhodl = 1\n[free]\n\"a.b\" = -1\n[[mode]]\nnumber = 0\nfrequency = \"3 mm\"\n[[mode]]\nnumber = 1\ndamping_ratio = 0.01\n";
        let faults = Features::from_toml(wrong).unwrap_err();
        assert_eq!(faults.len(), 6, "{faults:#?}");
        assert_eq!(Features::from_toml("").unwrap_err().len(), 2);
        assert!(Features::from_toml("[free").is_err());
    }
}
