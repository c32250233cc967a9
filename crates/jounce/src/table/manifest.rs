//! Where a table comes from: enough to make it again, nothing that changes from run to run.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

/// The origin of a result. It holds no time and no machine, so that the same run gives the same bytes.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Manifest {
    /// The program that made it: `jounce`.
    pub created_by: String,
    /// Its version.
    pub version: String,
    /// SHA-256 of the spec in hexadecimal; empty where no spec was read.
    pub spec_sha256: String,
    /// The command and its options, as the user would write them.
    pub options: BTreeMap<String, String>,
    /// The seed of the random numbers, where any were drawn.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seed: Option<u64>,
}

impl Manifest {
    /// A manifest of this version of jounce.
    pub fn new(spec_sha256: &str) -> Self {
        Self {
            created_by: "jounce".to_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            spec_sha256: spec_sha256.to_owned(),
            options: BTreeMap::new(),
            seed: None,
        }
    }

    /// The same with one more option.
    #[must_use]
    pub fn with(mut self, option: &str, value: impl ToString) -> Self {
        self.options.insert(option.to_owned(), value.to_string());
        self
    }
}
