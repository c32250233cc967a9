//! `[source]`

/// `[source]`: origin of the harvester. It affects no result.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Source {
    /// `publications`: keys of the publications that describe the harvester; empty if omitted.
    pub publications: Vec<String>,
}
