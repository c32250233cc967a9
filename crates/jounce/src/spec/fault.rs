//! What is wrong with a spec, and where.

use std::fmt;

use serde::Serialize;

/// One thing that is wrong, with its place.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct Fault {
    /// Line in the file, from 1; 0 where the fault is not in the file but in an override.
    pub line: usize,
    /// Column in characters, from 1; 0 where `line` is 0.
    pub column: usize,
    /// Dotted path of the key, `"stop.tip.gap"`; empty where the fault concerns no key.
    pub key: String,
    /// One sentence: the key, its value, what is allowed.
    pub message: String,
    /// The override at fault, `"--set stop.tip.gap=-1"`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub set: Option<String>,
}

impl Fault {
    /// A fault without a place in a file.
    pub(super) fn without_place(key: &str, message: impl Into<String>) -> Self {
        Self {
            line: 0,
            column: 0,
            key: key.to_owned(),
            message: message.into(),
            set: None,
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (&self.set, self.line) {
            (Some(set), _) => write!(out, "{set}: {}", self.message),
            (None, 0) => out.write_str(&self.message),
            (None, line) => write!(out, "line {line}, column {}: {}", self.column, self.message),
        }
    }
}

impl std::error::Error for Fault {}

/// All faults of a spec, sorted by place; never empty. A file with very many faults reports the first 100.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(transparent)]
pub struct Faults(Vec<Fault>);

impl Faults {
    /// No more faults than this are reported.
    pub(super) const MAX_REPORTED: usize = 100;

    pub(super) fn new(mut faults: Vec<Fault>) -> Self {
        faults.sort();
        faults.dedup();
        faults.truncate(Self::MAX_REPORTED);
        Self(faults)
    }

    /// The faults in the order of their places.
    pub fn as_slice(&self) -> &[Fault] {
        &self.0
    }
}

impl From<Fault> for Faults {
    fn from(fault: Fault) -> Self {
        Self(vec![fault])
    }
}

impl fmt::Display for Faults {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, fault) in self.0.iter().enumerate() {
            let separator = if index == 0 { "" } else { "\n" };
            write!(out, "{separator}{fault}")?;
        }
        Ok(())
    }
}

impl std::error::Error for Faults {}
