//! Faults of matrices from other programs.

use std::fmt;

/// All faults of a set of matrices, each in one sentence with its file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExchangeFaults(pub Vec<String>);

impl fmt::Display for ExchangeFaults {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.0.join("\n"))
    }
}

impl std::error::Error for ExchangeFaults {}

impl From<String> for ExchangeFaults {
    fn from(fault: String) -> Self {
        Self(vec![fault])
    }
}
