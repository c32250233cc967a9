//! Origin of a table: all data to reproduce it, without time or machine.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// Origin of a result. It contains no time and no machine, so the same run gives identical bytes.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Manifest {
    /// Name of the program: `jounce`.
    pub created_by: String,
    /// Version of the program.
    pub version: String,
    /// SHA-256 of the spec in hexadecimal; empty without a spec.
    pub spec_sha256: String,
    /// The command and its options, as typed by the user.
    pub options: BTreeMap<String, String>,
    /// Seed of the random numbers, if any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seed: Option<u64>,
}

impl Manifest {
    /// Creates a manifest of this version of jounce.
    pub fn new(spec_sha256: &str) -> Self {
        Self {
            created_by: "jounce".to_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            spec_sha256: spec_sha256.to_owned(),
            options: BTreeMap::new(),
            seed: None,
        }
    }

    /// Returns the manifest with one more option.
    #[must_use]
    pub fn with(mut self, option: &str, value: impl ToString) -> Self {
        self.options.insert(option.to_owned(), value.to_string());
        self
    }
}
