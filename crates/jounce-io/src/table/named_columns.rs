//! Tables: columns of equal length with unique names.

use std::io::Write;
use std::path::Path;

use super::{Column, Manifest, TableError, Values};
use super::{csv, json, page, parquet};
use crate::store::{self, PendingFile};

/// Table: columns of equal length with unique names.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Table {
    columns: Vec<Column>,
}

impl Table {
    /// Creates a table from its columns.
    ///
    /// # Errors
    /// Columns have different lengths, or a name is empty or duplicate.
    pub fn new(columns: Vec<Column>) -> Result<Self, TableError> {
        let mut table = Self::default();
        columns
            .into_iter()
            .try_for_each(|column| table.push(column))?;
        Ok(table)
    }

    /// Appends a column.
    ///
    /// # Errors
    /// The length differs from the number of rows, or the name is empty or duplicate.
    pub fn push(&mut self, column: Column) -> Result<(), TableError> {
        if column.name.is_empty() || self.column(&column.name).is_some() {
            return Err(TableError::Name {
                column: column.name,
            });
        }
        let (rows, expected) = (column.values.len(), self.rows());
        if !self.columns.is_empty() && rows != expected {
            return Err(TableError::Lengths {
                column: column.name,
                rows,
                expected,
            });
        }
        self.columns.push(column);
        Ok(())
    }

    /// Returns all columns from left to right.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// Returns the column with a name.
    pub fn column(&self, name: &str) -> Option<&Column> {
        self.columns.iter().find(|column| column.name == name)
    }

    /// Returns the real numbers of the column with a name; `None` if it is missing or of another
    /// kind.
    pub fn floats(&self, name: &str) -> Option<&[f64]> {
        match &self.column(name)?.values {
            Values::Float(values) => Some(values),
            _ => None,
        }
    }

    /// Returns the number of rows.
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, |column| column.values.len())
    }

    /// Writes the table in the format of the file extension: `.csv` (with its sidecar), `.parquet`
    /// or `.json`.
    ///
    /// # Errors
    /// The extension is unknown, or the path is not writable; no partial file remains.
    pub fn write(&self, path: &Path, manifest: &Manifest) -> Result<(), TableError> {
        match ending(path) {
            Some("csv") => {
                let content = csv::encode(self).map_err(|reason| encode_error(path, reason))?;
                let notes = notes_file(path, self, manifest)?;
                let table = store::prepare(path, |file| file.write_all(&content))?;
                named_after_notes(Some(notes), table)?;
            }
            Some("parquet") => store::write(
                path,
                &parquet::encode(self, manifest).map_err(|reason| encode_error(path, reason))?,
            )?,
            Some("json") => store::write(path, json::encode(self, manifest).as_bytes())?,
            _ => {
                return Err(TableError::Format {
                    path: path.to_owned(),
                });
            }
        }
        Ok(())
    }

    /// Returns the bytes of the table as a Parquet file.
    ///
    /// # Errors
    /// Parquet rejects the content.
    pub fn to_parquet(&self, manifest: &Manifest) -> Result<Vec<u8>, TableError> {
        parquet::encode(self, manifest)
            .map_err(|reason| encode_error(Path::new("table.parquet"), reason))
    }

    /// Returns the table and its manifest as an element of an HTML page, from which [`Table::read`]
    /// reads them: `<script type="application/json" id="table">`.
    pub fn to_page_element(&self, manifest: &Manifest) -> String {
        page::encode(self, manifest)
    }

    /// Writes a sequence of tables of the same columns to one file: `.parquet`, one row group for
    /// each table, or `.csv` (with its sidecar).
    ///
    /// # Errors
    /// The extension is unknown, one of the tables is an error, the columns differ, or the path is
    /// not writable; no partial file remains.
    pub fn write_joined<E: From<TableError>>(
        path: &Path,
        manifest: &Manifest,
        tables: impl IntoIterator<Item = Result<Self, E>>,
    ) -> Result<(), E> {
        let mut tables = tables.into_iter().peekable();
        let notes = match (ending(path), tables.peek()) {
            (Some("csv"), Some(Ok(first))) => Some(notes_file(path, first, manifest)?),
            (Some("csv" | "parquet"), _) => None,
            _ => {
                return Err(TableError::Format {
                    path: path.to_owned(),
                }
                .into());
            }
        };
        let mut failure = None;
        let table = store::prepare(path, |file| {
            let refused = |reason: String| E::from(encode_error(path, reason));
            let mut first = None;
            let tables = tables.map(|table| match table {
                Ok(table) if *first.get_or_insert_with(|| table.form()) != table.form() => {
                    Err(refused("the tables have different columns".to_owned()))
                }
                table => table,
            });
            let joined = match ending(path) {
                Some("csv") => csv::join(file, tables, refused),
                _ => parquet::join(file, manifest, tables, refused),
            };
            joined.map_err(|error| {
                failure = Some(error);
                std::io::Error::other("the tables could not be joined")
            })
        });
        match failure {
            Some(error) => Err(error),
            None => Ok(named_after_notes(notes, table.map_err(TableError::from)?)?),
        }
    }

    /// Returns the name, the unit and the kind of each column.
    fn form(&self) -> Vec<(String, String, &'static str)> {
        let column = |column: &Column| {
            let (name, unit) = (column.name.clone(), column.unit.clone());
            (name, unit, column.values.kind())
        };
        self.columns.iter().map(column).collect()
    }

    /// Reads a table and its manifest from the bytes of a Parquet file of jounce.
    ///
    /// # Errors
    /// The bytes are damaged or without the notes of jounce.
    pub fn from_parquet(bytes: &[u8]) -> Result<(Self, Manifest), TableError> {
        parquet::decode_bytes(bytes).map_err(|reason| TableError::Read {
            path: Path::new("table.parquet").to_owned(),
            reason,
        })
    }

    /// Reads a table and its manifest from a CSV (with its sidecar), Parquet or HTML file of jounce.
    ///
    /// # Errors
    /// The extension is unknown, or the file is missing, damaged or without the notes of jounce.
    pub fn read(path: &Path) -> Result<(Self, Manifest), TableError> {
        let read = match ending(path) {
            Some("csv") => csv::decode(path),
            Some("parquet") => parquet::decode(path),
            Some("html") => std::fs::read_to_string(path)
                .map_err(|fault| fault.to_string())
                .and_then(|text| page::decode(&text)),
            _ => {
                return Err(TableError::Format {
                    path: path.to_owned(),
                });
            }
        };
        read.map_err(|reason| TableError::Read {
            path: path.to_owned(),
            reason,
        })
    }
}

/// Prepares the notes of a CSV file.
fn notes_file(path: &Path, table: &Table, manifest: &Manifest) -> Result<PendingFile, TableError> {
    let text = csv::sidecar(table, manifest);
    let notes = csv::sidecar_path(path);
    Ok(store::prepare(&notes, |file| {
        file.write_all(text.as_bytes())
    })?)
}

/// Names a table and its notes, which are both on the disk: the notes first, so that an existing CSV
/// file always has them.
fn named_after_notes(notes: Option<PendingFile>, table: PendingFile) -> Result<(), TableError> {
    notes.map_or(Ok(()), PendingFile::persist)?;
    Ok(table.persist()?)
}

fn ending(path: &Path) -> Option<&str> {
    path.extension().and_then(|ending| ending.to_str())
}

fn encode_error(path: &Path, reason: String) -> TableError {
    TableError::Encode {
        path: path.to_owned(),
        reason,
    }
}
