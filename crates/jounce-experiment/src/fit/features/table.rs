//! Parses tables of a features file and collects all faults.

use jounce_spec::{Quantity, did_you_mean, nearest};
use std::path::Path;
use toml_edit::{Array, Item, TableLike, Value};

use crate::fit::Deviation;

/// Fault in a features file.
#[derive(Debug)]
pub(super) struct FeatureFault {
    /// Byte at which it begins; `None` for something that is missing in the file.
    pub start: Option<usize>,
    /// One sentence with the name of the key.
    pub message: String,
}

impl FeatureFault {
    /// Returns the fault as text with the line in the file, from 1.
    pub fn in_file(&self, path: &Path, text: &str) -> String {
        let message = &self.message;
        match self.start.and_then(|start| text.get(..start)) {
            Some(before) => {
                let line = before.matches('\n').count() + 1;
                format!("{}:line {line}: {message}", path.display())
            }
            None => format!("{}: {message}", path.display()),
        }
    }
}

/// Table with its faults.
pub(super) struct FeatureTable<'t> {
    pub table: &'t dyn TableLike,
    /// Prefix of each fault: `mode 2, `.
    pub position: String,
    /// Byte at which the table begins; `None` for the complete file.
    pub start: Option<usize>,
    /// Keys that unknown keys probably mean.
    pub misspelt: Vec<String>,
    pub faults: &'t mut Vec<FeatureFault>,
}

impl<'t> FeatureTable<'t> {
    /// Reports keys that the table must not contain.
    pub fn refuse_all_but(&mut self, keys: &[&str]) {
        let is_unknown = |key: &&str| !keys.contains(key);
        let unknown_keys = self.table.iter().map(|(key, _)| key).filter(is_unknown);
        for key in unknown_keys.map(str::to_owned).collect::<Vec<_>>() {
            let meant = nearest(&key, keys);
            self.misspelt.extend(meant.map(str::to_owned));
            let near = did_you_mean(&key, keys);
            let keys = keys.join(", ");
            let message = format!("{key} is not a key of features{near}; the keys are {keys}");
            self.fault(&key, message);
        }
    }

    /// Reports a fault of a key, at the key or, if it is missing, at the table; nothing where an
    /// unknown key probably means the missing one.
    pub fn fault(&mut self, key: &str, message: impl std::fmt::Display) {
        if !self.table.contains_key(key) && self.misspelt.iter().any(|meant| meant == key) {
            return;
        }
        let span = self
            .table
            .get_key_value(key)
            .and_then(|(key, item)| key.span().or(item.span()));
        self.faults.push(FeatureFault {
            start: span.map(|span| span.start).or(self.start),
            message: format!("{}{message}", self.position),
        });
    }

    /// Returns a required text.
    pub fn text(&mut self, key: &str, example: &str) -> Option<String> {
        let result = self
            .table
            .get(key)
            .and_then(Item::as_str)
            .map(str::to_owned);
        if result.is_none() {
            self.fault(
                key,
                format!("{key} must be a text, such as {key} = \"{example}\""),
            );
        }
        result
    }

    /// Returns an optional text.
    pub fn text_if_any(&mut self, key: &str, example: &str) -> Option<String> {
        if self.table.contains_key(key) {
            self.text(key, example)
        } else {
            None
        }
    }

    /// Returns a relative deviation, or `"residuals"`; any other value is a fault.
    pub fn deviation(&mut self, key: &str) -> Option<Deviation> {
        let item = self.table.get(key)?;
        let result = match item.as_str() {
            Some("residuals") => Some(Deviation::Residuals),
            _ => positive(item).map(Deviation::Given),
        };
        if result.is_none() {
            self.fault(
                key,
                format!(
                    "{key} must be a relative standard deviation, a number above 0 \
                such as 0.002, or \"residuals\""
                ),
            );
        }
        result
    }

    /// Returns a deviation if it is given; a wrong one, whose fault is reported, stands for any.
    pub fn given_deviation(&mut self, key: &str) -> Option<Deviation> {
        let is_given = self.table.contains_key(key);
        is_given.then(|| self.deviation(key).unwrap_or(Deviation::Residuals))
    }

    /// Returns the required deviation of the table.
    pub fn own_deviation(&mut self) -> Deviation {
        if !self.table.contains_key("deviation") {
            self.fault(
                "deviation",
                "deviation is missing: expected the relative standard deviation, such as \
                0.02, or \"residuals\"",
            );
        }
        self.deviation("deviation").unwrap_or(Deviation::Residuals)
    }

    /// Returns a flag, false by default.
    pub fn flag(&mut self, key: &str) -> bool {
        let Some(item) = self.table.get(key) else {
            return false;
        };
        let result = item.as_bool();
        if result.is_none() {
            self.fault(key, format!("{key} must be true or false"));
        }
        result.unwrap_or(false)
    }

    /// Returns a positive quantity with its unit.
    pub fn quantity(&mut self, key: &str, quantity: Quantity, example: &str) -> Option<f64> {
        let text = self.text(key, example)?;
        let result = quantity.read(&text).ok().filter(|value| *value > 0.0);
        if result.is_none() {
            self.fault(
                key,
                format!(
                    "{key} is \"{text}\"; it must be above 0, with its unit, such as \"{example}\""
                ),
            );
        }
        result
    }

    /// Returns positive quantities with their units.
    pub fn quantities(&mut self, key: &str, quantity: Quantity, example: &str) -> Vec<f64> {
        let texts = self.texts(key, example);
        let result: Option<Vec<f64>> = texts
            .iter()
            .map(|text| quantity.read(text).ok().filter(|value| *value > 0.0))
            .collect();
        if result.is_none() {
            self.fault(
                key,
                format!(
                    "{key} must contain values above 0 with their units, such as {key} = \
                [\"{example}\"]"
                ),
            );
        }
        result.unwrap_or_default()
    }

    /// Returns a required list of texts.
    pub fn texts(&mut self, key: &str, example: &str) -> Vec<String> {
        let text = |value: &Value| value.as_str().map(str::to_owned);
        let result = self
            .array(key)
            .and_then(|list| list.iter().map(text).collect::<Option<Vec<String>>>())
            .filter(|list| !list.is_empty());
        if result.is_none() {
            self.fault(
                key,
                format!("{key} must be a list of texts, such as {key} = [\"{example}\"]"),
            );
        }
        result.unwrap_or_default()
    }

    /// Returns a list of `count` numbers.
    pub fn numbers(&mut self, key: &str, count: usize) -> Vec<f64> {
        let number = |value: &Value| {
            value
                .as_float()
                .or_else(|| value.as_integer().map(|integer| integer as f64))
                .filter(|x| x.is_finite())
        };
        let result = self
            .array(key)
            .and_then(|list| list.iter().map(number).collect::<Option<Vec<f64>>>());
        if result.as_ref().is_none_or(|list| list.len() != count) {
            self.fault(
                key,
                format!(
                    "{key} must be a list of {count} numbers, one for each value of the swept key"
                ),
            );
        }
        result
            .filter(|list| list.len() == count)
            .unwrap_or_default()
    }

    /// Returns the keys of the spec that apply during this test, with their values in command-line
    /// notation.
    pub fn conditions(&mut self) -> Vec<(String, String)> {
        let Some(item) = self.table.get("set") else {
            return Vec::new();
        };
        let Some(table) = item.as_table_like() else {
            self.fault(
                "set",
                "set must be a table of keys, such as set = { \"circuit.load.resistance\" \
                = \"100 kohm\" }",
            );
            return Vec::new();
        };
        let text_of = |item: &Item| {
            item.as_str()
                .map_or_else(|| item.to_string().trim().to_owned(), str::to_owned)
        };
        table
            .iter()
            .map(|(key, item)| (key.to_owned(), text_of(item)))
            .collect()
    }

    fn array(&self, key: &str) -> Option<&'t Array> {
        self.table.get(key).and_then(Item::as_array)
    }
}

/// Returns a finite number above 0.
pub(super) fn positive(item: &Item) -> Option<f64> {
    let number = item
        .as_float()
        .or_else(|| item.as_integer().map(|integer| integer as f64));
    number.filter(|x| *x > 0.0 && x.is_finite())
}
