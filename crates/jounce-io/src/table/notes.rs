//! Notes of a CSV or Parquet file: unit, description and kind of each column, and the manifest.

use serde::{Deserialize, Serialize};

use super::{Column, Manifest, Table, Values};

/// Notes of a file, as JSON in a sidecar (CSV) or in the metadata (Parquet).
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Notes {
    /// Origin of the table.
    pub manifest: Manifest,
    /// One note per column, from left to right.
    pub columns: Vec<Note>,
}

/// Note of one column.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Note {
    pub name: String,
    pub unit: String,
    pub about: String,
    pub kind: String,
}

impl Notes {
    pub(super) fn of(table: &Table, manifest: &Manifest) -> Self {
        let note = |column: &Column| Note {
            name: column.name.clone(),
            unit: column.unit.clone(),
            about: column.about.clone(),
            kind: column.values.kind().to_owned(),
        };
        Self {
            manifest: manifest.clone(),
            columns: table.columns().iter().map(note).collect(),
        }
    }

    pub(super) fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("text and numbers always have a JSON form") + "\n"
    }

    pub(super) fn from_json(text: &str) -> Result<Self, String> {
        serde_json::from_str(text).map_err(|_| "its notes are not those of jounce".to_owned())
    }

    /// Combines the notes with the values of each column.
    pub(super) fn join(self, values: Vec<Values>) -> Result<(Table, Manifest), String> {
        let columns = self
            .columns
            .into_iter()
            .zip(values)
            .map(|(note, values)| Column::new(&note.name, &note.unit, &note.about, values));
        Ok((
            Table::new(columns.collect()).map_err(|fault| fault.to_string())?,
            self.manifest,
        ))
    }
}
