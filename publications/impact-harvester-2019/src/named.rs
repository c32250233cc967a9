//! Tables and figures with the names of their files.

use jounce_io::table::{Column, Table, Values};
use jounce_plot::Figure;

/// Table of the report.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedTable {
    /// Name of its files, without extension: `table-2`.
    pub name: String,
    /// Caption above the table.
    pub caption: String,
    /// Significant digits in the report; files contain all digits.
    pub digits: usize,
    /// Data of the table.
    pub table: Table,
}

/// Figure of the report.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedFigure {
    /// Name of its files, without extension: `figure-6`.
    pub name: String,
    /// Caption below the figure.
    pub caption: String,
    /// The figure.
    pub figure: Figure,
}

/// Position of the stop in names and captions.
pub(super) struct NamedStop {
    pub suffix: &'static str,
    pub words: &'static str,
}

/// Stop on the ground: eq. (5) as printed, the default.
pub(super) const ON_GROUND: NamedStop = NamedStop {
    suffix: "",
    words: "",
};

/// Stop on the shaker table: the alternative.
pub(super) const ON_TABLE: NamedStop = NamedStop {
    suffix: "-stop-on-table",
    words: " Here the stop rides on the shaker table.",
};

impl NamedTable {
    /// Creates a table with the name of its files.
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
    /// Creates a figure with the name of its files.
    pub fn new(name: &str, caption: &str, figure: Figure) -> Self {
        Self {
            name: name.to_owned(),
            caption: caption.to_owned(),
            figure,
        }
    }
}

/// Returns a column (name, unit, heading) with one value for each row.
pub(super) fn column<R, V>(
    rows: &[R],
    (name, unit, heading): (&str, &str, &str),
    value: impl Fn(&R) -> V,
) -> Column
where
    Vec<V>: Into<Values>,
{
    Column::new(
        name,
        unit,
        heading,
        rows.iter().map(value).collect::<Vec<V>>(),
    )
}
