//! Features file (TOML): measured values and free keys.

use std::path::{Path, PathBuf};

use toml_edit::{Document, Item, TableLike};

use super::faults::{KINDS, second_mode, syntax_fault};
use super::table::{FeatureFault, FeatureTable, positive};
use super::{HistoryFeature, JumpFeature, ModeFeature, PowerFeature, ResponseFeature};
use crate::fit::FitError;

/// Free keys and measured values.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Features {
    /// Bodies held during the tests of modes and responses.
    pub hold: Vec<String>,
    /// Free keys, each with the relative standard deviation of its prior.
    pub free: Vec<(String, f64)>,
    /// Modes.
    pub modes: Vec<ModeFeature>,
    /// Frequency responses.
    pub responses: Vec<ResponseFeature>,
    /// Mean powers.
    pub powers: Vec<PowerFeature>,
    /// Jumps.
    pub jumps: Vec<JumpFeature>,
    /// Time histories.
    pub histories: Vec<HistoryFeature>,
    /// Folder to which paths in the features are relative.
    pub folder: PathBuf,
}

const KEYS: [&str; 9] = [
    "hold",
    "free",
    "mode",
    "response",
    "power",
    "jump",
    "history",
    "frequency_deviation",
    "damping_deviation",
];

impl Features {
    /// Reads a file.
    ///
    /// # Errors
    /// A file that cannot be read; all faults in it.
    pub fn read(path: &Path) -> Result<Self, FitError> {
        let text = std::fs::read_to_string(path).map_err(|reason| FitError::Open {
            path: path.to_owned(),
            reason,
        })?;
        let folder = path.parent().map_or_else(PathBuf::new, Path::to_path_buf);
        let in_file = |fault: &FeatureFault| fault.in_file(path, &text);
        Self::parse(&text)
            .map(|features| Self { folder, ..features })
            .map_err(|faults| FitError::Features {
                faults: faults.iter().map(in_file).collect(),
            })
    }

    /// Parses features from text.
    ///
    /// # Errors
    /// One sentence for each fault.
    pub fn from_toml(text: &str) -> Result<Self, Vec<String>> {
        let message = |fault: FeatureFault| fault.message;
        Self::parse(text).map_err(|faults| faults.into_iter().map(message).collect())
    }

    fn parse(text: &str) -> Result<Self, Vec<FeatureFault>> {
        let document = Document::parse(text).map_err(|fault| vec![syntax_fault(text, &fault)])?;
        let (root, mut faults) = (document.as_table(), Vec::new());
        let mut reader = FeatureTable {
            table: root,
            position: String::new(),
            start: None,
            misspelt: Vec::new(),
            faults: &mut faults,
        };
        reader.refuse_all_but(&KEYS);
        let defaults = [
            reader.given_deviation("frequency_deviation"),
            reader.given_deviation("damping_deviation"),
        ];
        let (hold, free) = (read_hold(&mut reader), read_free(&mut reader));
        let misspelt = reader.misspelt;
        let result = Self {
            hold,
            free,
            modes: read_tables(root, "mode", &mut faults, |reader| {
                ModeFeature::read(reader, defaults)
            }),
            responses: read_tables(root, "response", &mut faults, ResponseFeature::read),
            powers: read_tables(root, "power", &mut faults, PowerFeature::read),
            jumps: read_tables(root, "jump", &mut faults, JumpFeature::read),
            histories: read_tables(root, "history", &mut faults, HistoryFeature::read),
            folder: PathBuf::new(),
        };
        let is_meant = |kind: &&str| misspelt.iter().any(|meant| meant == kind);
        if !(KINDS.iter()).any(|kind| root.contains_key(kind) || is_meant(kind)) {
            let message = "nothing is measured: write [[mode]] with number and frequency, [[response]], [[power]], [[jump]] or [[history]]";
            faults.push(FeatureFault {
                start: None,
                message: message.to_owned(),
            });
        }
        if faults.is_empty() {
            faults.extend(second_mode(text, root, &result.modes));
        }
        if faults.is_empty() {
            Ok(result)
        } else {
            Err(faults)
        }
    }
}

/// Parses every table of a kind and prefixes its faults with its number.
fn read_tables<T>(
    root: &dyn TableLike,
    kind: &str,
    faults: &mut Vec<FeatureFault>,
    read: impl Fn(&mut FeatureTable<'_>) -> Option<T>,
) -> Vec<T> {
    let Some(item) = root.get(kind) else {
        return Vec::new();
    };
    let Some(tables) = item.as_array_of_tables() else {
        faults.push(FeatureFault {
            start: item.span().map(|span| span.start),
            message: format!("{kind} must be tables: write [[{kind}]] before each table"),
        });
        return Vec::new();
    };
    let one = |(k, table): (usize, &toml_edit::Table)| {
        read(&mut FeatureTable {
            table,
            position: format!("{kind} {}, ", k + 1),
            start: table.span().map(|span| span.start),
            misspelt: Vec::new(),
            faults: &mut *faults,
        })
    };
    tables.iter().enumerate().filter_map(one).collect()
}

fn read_hold(reader: &mut FeatureTable<'_>) -> Vec<String> {
    let Some(item) = reader.table.get("hold") else {
        return Vec::new();
    };
    let names = item.as_array().and_then(|list| {
        list.iter()
            .map(|name| name.as_str().map(str::to_owned))
            .collect()
    });
    if names.is_none() {
        reader.fault(
            "hold",
            "hold must be a list of names, such as hold = [\"table\"]",
        );
    }
    names.unwrap_or_default()
}

fn read_free(reader: &mut FeatureTable<'_>) -> Vec<(String, f64)> {
    let (mut free, previous_faults) = (Vec::new(), reader.faults.len());
    for (key, item) in reader
        .table
        .get("free")
        .and_then(Item::as_table_like)
        .into_iter()
        .flat_map(|table| table.iter())
    {
        match positive(item) {
            Some(deviation) => free.push((key.to_owned(), deviation)),
            None => reader.faults.push(FeatureFault {
                start: item.span().map(|span| span.start),
                message: format!(
                    "free.{key:?} must be its relative standard deviation, a number above 0 such as 0.05"
                ),
            }),
        }
    }
    if free.is_empty() && reader.faults.len() == previous_faults {
        reader.fault(
            "free",
            "no key is free: give [free] with lines such as \"beam.NAME.thickness\" = \
            0.01",
        );
    }
    free
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::fit::Deviation;

    #[test]
    fn features_are_read_and_all_faults_are_listed() {
        let text = "hold = [\"table\"]\nfrequency_deviation = 0.002\n[free]\n\"beam.b.length\" = 0.01\n[[mode]]\nnumber = 2\nfrequency = \"1.5 kHz\"\n";
        let result = Features::from_toml(text).unwrap();
        assert_eq!(
            (result.hold[0].as_str(), &result.free[0]),
            ("table", &("beam.b.length".to_owned(), 0.01))
        );
        assert_eq!(
            result.modes,
            [ModeFeature {
                number: 2,
                frequency: Some((1500.0, Deviation::Given(0.002))),
                ..ModeFeature::default()
            }]
        );
        let invalid = "hold = 3\nhodl = 1\n[free]\n\"a.b\" = -1\n[[mode]]\nnumber = 0\nfrequency = \"3 mm\"\n[[mode]]\nnumber = 1\ndamping_ratio = 0.01\n";
        let faults = Features::from_toml(invalid).unwrap_err();
        assert_eq!(faults.len(), 6, "{faults:#?}");
        assert_eq!(Features::from_toml("").unwrap_err().len(), 2);
        assert!(Features::from_toml("[free").is_err());
    }

    #[test]
    fn a_mistake_gives_one_fault() {
        let free = "[free]\n\"beam.b.length\" = 0.01\n";
        let mode = "[[mode]]\nnumber = 1\nfrequency = \"9 Hz\"\nfrequency_deviation = 0.01\n";
        for (text, expected) in [
            (
                format!("{free}{mode}{mode}"),
                "mode 1 is measured twice under the same conditions, first on line 3",
            ),
            (
                format!("{free}[mode]\nnumber = 1\n[mode]\nnumber = 2\n"),
                "write [[mode]] with two brackets",
            ),
            (
                format!(
                    "frequency_deviation = 0\n{free}[[mode]]\nnumber = 1\nfrequency = \"9 Hz\"\n"
                ),
                "above 0",
            ),
            (
                format!("{free}{}", mode.replace("frequency =", "frequncy =")),
                "did you mean `frequency`?",
            ),
            (
                format!("{free}{}", mode.replace("[[mode]]", "[[modes]]")),
                "did you mean `mode`?",
            ),
        ] {
            let faults = Features::from_toml(&text).unwrap_err();
            assert!(
                faults.len() == 1 && faults[0].contains(expected),
                "{text}: {faults:?}"
            );
        }
        let loaded = mode.replace("number = 1", "number = 1\nloaded = true");
        assert!(Features::from_toml(&format!("{free}{mode}{loaded}")).is_ok());
    }

    #[test]
    fn every_kind_of_feature_is_read() {
        let text = r#"
            [free]
            "stop.tip.stiffness" = 0.3
            [[response]]
            input = "beam.tip"
            output = "mfc.voltage"
            frequency = ["8 Hz", "9 Hz"]
            magnitude = [1.0, 2]
            deviation = "residuals"
            [[power]]
            over = "circuit.load.resistance"
            values = ["10 kohm", "1 Mohm"]
            mean_power_w = [1e-4, 2e-4]
            deviation = 0.02
            set = { "run.duration" = "5 s", "drive.shaker.amplitude" = "100 N" }
            [[jump]]
            over = "drive.shaker.frequency"
            at = "12.6 Hz"
            between = ["12 Hz", "13 Hz"]
            deviation = 0.002
            [[history]]
            file = "run.csv"
            channel = "mfc.voltage"
            output = "mfc.voltage"
            begins = "20 ms"
            deviation = 0.05
        "#;
        let result = Features::from_toml(text).unwrap();
        assert_eq!(
            (
                result.responses.len(),
                result.powers.len(),
                result.jumps.len(),
                result.histories.len()
            ),
            (1, 1, 1, 1)
        );
        assert_eq!(result.histories[0].begins_s, Some(0.02));
        let negative_time = text.replace("20 ms", "-20 ms");
        assert!(
            Features::from_toml(&negative_time).unwrap_err()[0].contains("begins is \"-20 ms\"")
        );
        assert_eq!(
            result.powers[0].set[1],
            ("drive.shaker.amplitude".to_owned(), "100 N".to_owned())
        );
        let invalid = "[free]\n\"a.b\" = 1\n[[power]]\nover = 3\nvalues = []\n[[jump]]\nat = 3\n[[response]]\ninput = \"a\"\noutput = \"tip\"\n[history]\n";
        let faults = Features::from_toml(invalid).unwrap_err();
        assert!(
            faults.len() >= 9 && faults.iter().any(|fault| fault.contains("[[history]]")),
            "{faults:#?}"
        );
    }
}
