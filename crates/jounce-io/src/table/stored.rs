//! A table as stored in a file, and the first difference of two of them.

use super::error::TableError;
use super::{Column, Manifest, Table};
use crate::store::reason;
use serde_json::{Map, Value};
use std::path::Path;

/// Table of a file of any format, with its manifest. A value is the shortest text that reads back
/// to the same bits.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StoredTable {
    /// Origin of the table.
    pub manifest: Manifest,
    columns: Vec<StoredColumn>,
}

/// Column of a stored table.
#[derive(Debug, Clone, PartialEq, Eq)]
struct StoredColumn {
    name: String,
    unit: String,
    about: String,
    values: Vec<String>,
}

/// First difference of two tables.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize)]
pub struct TableDifference {
    /// What differs: `value`, `rows`, `unit`, `about`, or `column`, the name of a column.
    pub what: &'static str,
    /// Name of the column in the first table; empty where the second has more columns.
    pub column: String,
    /// Row of a value, from 1; `None` for other differences.
    pub row: Option<usize>,
    /// Content of the first table.
    pub first: String,
    /// Content of the second table.
    pub second: String,
}

impl StoredTable {
    /// Reads a CSV (with its sidecar), Parquet, JSON or HTML file of jounce.
    ///
    /// # Errors
    /// The extension is unknown, or the file is missing, damaged or without the notes of jounce.
    pub fn read(path: &Path) -> Result<Self, TableError> {
        if path
            .extension()
            .is_some_and(|extension| extension == "json")
        {
            return from_json(path).map_err(|reason| TableError::Read {
                path: path.to_owned(),
                reason,
            });
        }
        let (table, manifest) = Table::read(path)?;
        let columns = table.columns().iter().map(StoredColumn::of).collect();
        Ok(Self { manifest, columns })
    }

    /// Returns the number of columns.
    pub fn width(&self) -> usize {
        self.columns.len()
    }

    /// Returns the number of rows.
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, |column| column.values.len())
    }

    /// Returns the first difference from another table, by columns from the left, then by rows;
    /// manifests are not compared.
    pub fn first_difference(&self, other: &Self) -> Option<TableDifference> {
        for index in 0..self.columns.len().max(other.columns.len()) {
            let [first, second] = [self, other].map(|table| table.columns.get(index));
            let difference = match (first, second) {
                (Some(first), Some(second)) => first.first_difference(second),
                _ => {
                    let name = |column: Option<&StoredColumn>| {
                        column.map_or_else(String::new, |column| column.name.clone())
                    };
                    let (first, second) = (name(first), name(second));
                    Some(TableDifference::of("column", &first, &first, &second))
                }
            };
            if difference.is_some() {
                return difference;
            }
        }
        None
    }
}

impl StoredColumn {
    fn of(column: &Column) -> Self {
        let text = |row| column.values.text(row).unwrap_or_default();
        Self {
            name: column.name.clone(),
            unit: column.unit.clone(),
            about: column.about.clone(),
            values: (0..column.values.len()).map(text).collect(),
        }
    }

    fn first_difference(&self, other: &Self) -> Option<TableDifference> {
        let [rows, other_rows] = [self, other].map(|column| column.values.len().to_string());
        let parts = [
            ("column", &self.name, &other.name),
            ("unit", &self.unit, &other.unit),
            ("about", &self.about, &other.about),
            ("rows", &rows, &other_rows),
        ];
        for (what, first, second) in parts {
            if first != second {
                return Some(TableDifference::of(what, &self.name, first, second));
            }
        }
        let pairs = self.values.iter().zip(&other.values);
        let (row, (first, second)) = pairs
            .enumerate()
            .find(|(_, (first, second))| first != second)?;
        Some(TableDifference {
            row: Some(row + 1),
            ..TableDifference::of("value", &self.name, first, second)
        })
    }
}

impl TableDifference {
    fn of(what: &'static str, column: &str, first: &str, second: &str) -> Self {
        Self {
            what,
            column: column.to_owned(),
            row: None,
            first: first.to_owned(),
            second: second.to_owned(),
        }
    }
}

/// Reads the JSON of a table.
fn from_json(path: &Path) -> Result<StoredTable, String> {
    let text = std::fs::read_to_string(path).map_err(|fault| reason(&fault))?;
    let value: Value = serde_json::from_str(&text).map_err(|fault| fault.to_string())?;
    let part = |name: &str| value.get(name).and_then(Value::as_object);
    let (Some(columns), Some(units), Some(about), Some(manifest)) = (
        part("columns"),
        part("units"),
        part("about"),
        value.get("manifest"),
    ) else {
        return Err(
            "it is no table of jounce: it lacks columns, units, about or manifest".to_owned(),
        );
    };
    let manifest = serde_json::from_value(manifest.clone())
        .map_err(|_| "its manifest is not that of jounce".to_owned())?;
    let text = |map: &Map<String, Value>, name: &str| {
        let text = map.get(name).and_then(Value::as_str);
        text.unwrap_or_default().to_owned()
    };
    let column = |(name, values): (&String, &Value)| {
        let values = values
            .as_array()
            .ok_or_else(|| format!("column {name} is no list"))?;
        Ok(StoredColumn {
            name: name.clone(),
            unit: text(units, name),
            about: text(about, name),
            values: values.iter().map(Value::to_string).collect(),
        })
    };
    Ok(StoredTable {
        manifest,
        columns: columns.iter().map(column).collect::<Result<_, String>>()?,
    })
}
