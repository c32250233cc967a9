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

/// Where the stop stands, as it enters names and captions.
pub(super) struct NamedStop {
    pub suffix: &'static str,
    pub words: &'static str,
}

/// Eq. (5) as printed; the default.
pub(super) const ON_GROUND: NamedStop = NamedStop {
    suffix: "",
    words: "",
};

/// The other reading.
pub(super) const ON_TABLE: NamedStop = NamedStop {
    suffix: "-stop-on-table",
    words: " Here the stop rides on the shaker table.",
};

impl NamedTable {
    /// A table under the name of its files.
    pub fn new(name: &str, caption: &str, digits: usize, table: Table) -> Self {
        Self {
            name: name.to_owned(),
            caption: caption.to_owned(),
            digits,
            table,
        }
    }
}

impl NamedFigure {
    /// A figure under the name of its files.
    pub fn new(name: &str, caption: &str, figure: Figure) -> Self {
        Self {
            name: name.to_owned(),
            caption: caption.to_owned(),
            figure,
        }
    }
}
