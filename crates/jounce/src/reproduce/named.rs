//! Tables and figures under the name of their files.

use crate::picture::Figure;
use crate::table::Table;

/// A table of the report.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedTable {
    /// Name of its files, without an ending: `table-2`.
    pub name: String,
    /// What stands above it.
    pub caption: String,
    /// Significant digits where people read it; files hold all of them.
    pub digits: usize,
    /// The data.
    pub table: Table,
}

/// A figure of the report.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedFigure {
    /// Name of its files, without an ending: `figure-6`.
    pub name: String,
    /// What stands below it.
    pub caption: String,
    /// The picture.
    pub figure: Figure,
}

impl NamedTable {
    pub(super) fn new(name: &str, caption: &str, digits: usize, table: Table) -> Self {
        Self { name: name.to_owned(), caption: caption.to_owned(), digits, table }
    }
}

impl NamedFigure {
    pub(super) fn new(name: &str, caption: &str, figure: Figure) -> Self {
        Self { name: name.to_owned(), caption: caption.to_owned(), figure }
    }
}
