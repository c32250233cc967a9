//! Fields of a design problem on a page, and its file.

use crate::error::Error;
use jounce_design::DesignError;
use jounce_spec::Fault;
use serde::{Deserialize, Serialize};
use toml_edit::{DocumentMut, Item, Table, Value, value};

/// Fields of a design problem, as the user has filled them in. Each is the text of a key of a
/// design file.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct DesignFields {
    /// Free keys with their ranges, `0.2 mm:3 mm`.
    pub free: Vec<(String, String)>,
    /// Goal.
    pub maximise: String,
    /// Number of starts.
    pub starts: String,
    /// Limits.
    pub limits: Vec<(String, String)>,
    /// Tolerances.
    pub tolerance: Vec<(String, String)>,
    /// Largest number of evaluated designs.
    pub evaluations: String,
    /// Seed.
    pub seed: String,
}

/// Fault of a field.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct FieldFault {
    /// Table of the design file; empty for a key at its top.
    pub table: String,
    /// Key in this table.
    pub key: String,
    /// One sentence with the key, its value and the allowed values.
    pub message: String,
}

impl DesignFields {
    /// Returns the design file (TOML) with these fields; it names a spec if one is given.
    ///
    /// ```
    /// use jounce::live::DesignFields;
    /// let fields = DesignFields {
    ///     free: vec![("stop.tip.gap".into(), "0.2 mm:3 mm".into())],
    ///     maximise: "stable-power".into(),
    ///     starts: "20".into(),
    ///     ..Default::default()
    /// };
    /// let text = "[free]\n\"stop.tip.gap\" = \"0.2 mm:3 mm\"\n\n[goal]\nmaximise = \"stable-power\"\nstarts = 20\n";
    /// assert_eq!(fields.text(None), text);
    /// ```
    pub fn text(&self, spec: Option<&str>) -> String {
        let mut document = DocumentMut::new();
        let root = document.as_table_mut();
        if let Some(spec) = spec {
            root.insert("spec", value(spec));
        }
        for (name, text) in [("seed", &self.seed), ("evaluations", &self.evaluations)] {
            insert_number(root, name, text);
        }
        let mut goal = Table::new();
        goal.insert("maximise", value(&self.maximise));
        insert_number(&mut goal, "starts", &self.starts);
        let tables = [
            ("free", table(&self.free)),
            ("goal", goal),
            ("limits", table(&self.limits)),
            ("tolerance", table(&self.tolerance)),
        ];
        for (name, table) in tables {
            if !table.is_empty() {
                root.insert(name, Item::Table(table));
            }
        }
        document.to_string()
    }

    /// Returns the faults of the fields in an error of a design; `None` for another error.
    pub fn faults(&self, error: &Error) -> Option<Vec<FieldFault>> {
        let Error::Design(error) = error else {
            return None;
        };
        let DesignError::Faults(faults) = error.as_ref() else {
            return None;
        };
        let text = self.text(None);
        Some(faults.iter().map(|fault| field(&text, fault)).collect())
    }
}

fn table(pairs: &[(String, String)]) -> Table {
    let mut table = Table::new();
    for (key, text) in pairs {
        table.insert(key, value(text));
    }
    table
}

/// Inserts a whole number; another text remains a text, which the reader refuses.
fn insert_number(table: &mut Table, name: &str, text: &str) {
    let text = text.trim();
    if !text.is_empty() {
        let number = text.parse::<i64>().map(Value::from);
        table.insert(name, value(number.unwrap_or_else(|_| Value::from(text))));
    }
}

/// Returns the field of a fault: its table is that of its line.
fn field(text: &str, fault: &Fault) -> FieldFault {
    let names = text.lines().take(fault.line).filter_map(|line| {
        let name = line.strip_prefix('[')?.strip_suffix(']')?;
        Some(name.to_owned())
    });
    let table = names.last().unwrap_or_default();
    let prefix = format!("{table}.");
    FieldFault {
        key: fault
            .key
            .strip_prefix(&prefix)
            .unwrap_or(&fault.key)
            .to_owned(),
        table,
        message: fault.message.clone(),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::Harvester;

    /// The messages are those of a design file, at the fields that cause them.
    #[test]
    fn faults_are_at_their_fields() {
        let path = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../../examples/impact-harvester-2019/harvester.toml"
        );
        let harvester = Harvester::read(path).unwrap();
        let pair = |key: &str, text: &str| (key.to_owned(), text.to_owned());
        let fields = DesignFields {
            free: vec![pair("stop.tip.gap", "3 mm:1 mm")],
            maximise: "most".to_owned(),
            starts: "many".to_owned(),
            limits: vec![pair("patch.mfc.strain", "600 mm")],
            tolerance: vec![pair("stop.tip.gap", "-1 mm")],
            evaluations: "0".to_owned(),
            seed: String::new(),
        };
        let error = harvester.design(&fields.text(None)).unwrap_err();
        let faults = fields.faults(&error).unwrap();
        let mut places: Vec<(&str, &str)> = faults
            .iter()
            .map(|one| (one.table.as_str(), one.key.as_str()))
            .collect();
        places.sort_unstable();
        let expected = [
            ("", "evaluations"),
            ("free", "stop.tip.gap"),
            ("goal", "maximise"),
            ("goal", "starts"),
            ("limits", "patch.mfc.strain"),
            ("tolerance", "stop.tip.gap"),
        ];
        assert_eq!(places, expected);
        assert!(
            faults
                .iter()
                .all(|one| error.to_string().contains(&one.message))
        );
        let none = DesignFields::default();
        let error = harvester.design(&none.text(None)).unwrap_err();
        let faults = none.faults(&error).unwrap();
        assert!(faults.iter().any(|one| one.key == "free"), "{faults:?}");
    }
}
