//! Faults of a spec and their places.

use std::cmp::Ordering;
use std::fmt;

use serde::Serialize;

/// A single fault of a spec with its place.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Fault {
    /// Line in the file, from 1; 0 if the fault is in an override or in a table that the file lacks.
    pub line: usize,
    /// Column in characters, from 1; 0 if `line` is 0.
    pub column: usize,
    /// Dotted path of the key, `"stop.tip.gap"`; empty if the fault concerns no key.
    pub key: String,
    /// One sentence with the key, its value and the allowed values.
    pub message: String,
    /// Override that causes the fault, `"--set stop.tip.gap=-1"`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub set: Option<String>,
}

impl Fault {
    /// Returns a fault without a place in a file.
    pub fn without_position(key: &str, message: impl Into<String>) -> Self {
        Self {
            line: 0,
            column: 0,
            key: key.to_owned(),
            message: message.into(),
            set: None,
        }
    }
}

/// Faults of overrides come first, then those with a place in the file in its order, then the others.
impl Ord for Fault {
    fn cmp(&self, other: &Self) -> Ordering {
        fn order(fault: &Fault) -> impl Ord {
            let Fault {
                line,
                column,
                key,
                message,
                set,
            } = fault;
            (set.is_none(), *line == 0, *line, *column, key, message, set)
        }
        order(self).cmp(&order(other))
    }
}

impl PartialOrd for Fault {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
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

/// All faults of a spec, sorted by place; never empty. Only the first 100 are reported, with a last
/// one that there are more.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(transparent)]
pub struct Faults(Vec<Fault>);

impl Faults {
    /// Largest number of reported faults.
    const MAX_REPORTED: usize = 100;

    /// Number of faults after which the search for more ends.
    pub(super) const MAX_FOUND: usize = Self::MAX_REPORTED + 1;

    /// Message that a list of faults does not contain all.
    pub(super) const MORE: &str = "there are more faults; correct those above, then check again";

    pub(super) fn new(mut faults: Vec<Fault>) -> Self {
        faults.sort();
        faults.dedup();
        if faults.len() > Self::MAX_REPORTED {
            faults.truncate(Self::MAX_REPORTED);
            faults.push(Fault::without_position("", Self::MORE));
        }
        Self(faults)
    }

    /// Returns the faults in the order of their places.
    pub fn as_slice(&self) -> &[Fault] {
        &self.0
    }
}

impl From<Vec<Fault>> for Faults {
    fn from(faults: Vec<Fault>) -> Self {
        Self::new(faults)
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

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::Spec;

    #[test]
    fn a_list_that_is_cut_has_a_last_fault() {
        let faults = |text: &str| Spec::from_toml(text).unwrap_err().0;
        let last = |faults: &[Fault]| faults.last().map(|fault| fault.message.clone());
        let more = Some(Faults::MORE.to_owned());
        let unknown: String = (0..200).map(|k| format!("[unknown{k}]\n")).collect();
        let unknown = faults(&unknown);
        assert_eq!((unknown.len(), last(&unknown)), (101, more.clone()));
        let lines: String = (0..30).map(|k| format!("[run]\nkey{k} = 3 m\n")).collect();
        assert_eq!(last(&faults(&lines)), more);
        assert_ne!(last(&faults("[unknown]\n")), more);
    }
}
