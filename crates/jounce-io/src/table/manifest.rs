//! Origin of a table: all data to reproduce it, without time or machine.

use super::error::TableError;
use super::record::Record;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;

/// Origin of a result. It contains no time and no machine, so the same run gives identical bytes.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Manifest {
    /// Name of the program: `jounce`.
    pub created_by: String,
    /// Version of the program.
    pub version: String,
    /// SHA-256 of the spec in hexadecimal; empty without a spec.
    pub spec_sha256: String,
    /// The command, and its options by the names of their fields.
    pub options: BTreeMap<String, String>,
    /// The command and its input files, from which `jounce rerun` makes the result again; `None` for
    /// a result that no command wrote.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub record: Option<Record>,
}

impl Manifest {
    /// Creates a manifest of this version of jounce.
    pub fn new(spec_sha256: &str) -> Self {
        Self {
            created_by: "jounce".to_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            spec_sha256: spec_sha256.to_owned(),
            options: BTreeMap::new(),
            record: None,
        }
    }

    /// Returns the manifest with one more option.
    #[must_use]
    pub fn with(mut self, option: &str, value: impl ToString) -> Self {
        self.options.insert(option.to_owned(), value.to_string());
        self
    }

    /// Returns the manifest with the options of a question that have a value, under the names of
    /// their fields: texts as they are, other values as JSON. The number of threads is left out,
    /// because no result depends on it.
    ///
    /// # Errors
    /// [`TableError::Options`] for a value that JSON cannot hold.
    pub fn with_options(self, options: &impl Serialize) -> Result<Self, TableError> {
        let fault = |error: serde_json::Error| TableError::Options {
            reason: error.to_string(),
        };
        let options = serde_json::to_value(options).map_err(fault)?;
        let mut manifest = self;
        for (name, value) in options.as_object().into_iter().flatten() {
            manifest = match value {
                Value::Null => manifest,
                Value::Array(values) if values.is_empty() => manifest,
                _ if name == "threads" => manifest,
                Value::String(text) => manifest.with(name, text),
                value => manifest.with(name, value),
            };
        }
        Ok(manifest)
    }
}
