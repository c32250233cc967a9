//! Tables: columns of equal length with unique names.

use std::path::Path;

use super::{Column, Manifest, TableError, Values};
use super::{csv, json, parquet};
use crate::store;

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
                // The sidecar is written first, so an existing CSV file always has its notes.
                store::write(
                    &csv::sidecar_path(path),
                    csv::sidecar(self, manifest).as_bytes(),
                )?;
                store::write(
                    path,
                    &csv::encode(self).map_err(|reason| encode_error(path, reason))?,
                )?;
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
        match (ending(path), tables.peek()) {
            // The sidecar is written first, so an existing CSV file always has its notes.
            (Some("csv"), Some(Ok(first))) => {
                store::write(
                    &csv::sidecar_path(path),
                    csv::sidecar(first, manifest).as_bytes(),
                )
                .map_err(TableError::from)?;
            }
            (Some("csv" | "parquet"), _) => {}
            _ => {
                return Err(TableError::Format {
                    path: path.to_owned(),
                }
                .into());
            }
        }
        let mut failure = None;
        let stored = store::write_from(path, |file| {
            let refused = |reason: String| E::from(encode_error(path, reason));
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
            None => stored.map_err(|error| E::from(error.into())),
        }
    }

    /// Reads a table and its manifest from a CSV (with its sidecar) or Parquet file of jounce.
    ///
    /// # Errors
    /// The extension is unknown, or the file is missing, damaged or without the notes of jounce.
    pub fn read(path: &Path) -> Result<(Self, Manifest), TableError> {
        let read = match ending(path) {
            Some("csv") => csv::decode(path),
            Some("parquet") => parquet::decode(path),
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

fn ending(path: &Path) -> Option<&str> {
    path.extension().and_then(|ending| ending.to_str())
}

fn encode_error(path: &Path, reason: String) -> TableError {
    TableError::Encode {
        path: path.to_owned(),
        reason,
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    fn awkward() -> Table {
        let floats = vec![
            0.1 + 0.2,
            -0.0,
            f64::NAN,
            5e-324,
            f64::MAX,
            f64::NEG_INFINITY,
            1e-7,
            7.023_747_569_4e-5,
        ];
        let texts = [
            "plain",
            "comma, quote \" and\nnewline",
            "",
            "µΩ",
            " ",
            "NaN",
            "1",
            "'",
        ];
        Table::new(vec![
            Column::new("power_w", "W", "mean power", floats),
            Column::new(
                "shift",
                "",
                "signed",
                vec![i64::MIN, -1, 0, 1, 2, 3, 4, i64::MAX],
            ),
            Column::new(
                "contacts",
                "",
                "count",
                vec![0u64, 1, 2, 3, 4, 5, 1 << 53 | 1, u64::MAX],
            ),
            Column::new(
                "settled",
                "",
                "yes or no",
                vec![true, false, true, true, false, false, true, false],
            ),
            Column::new("label", "", "text", texts.map(str::to_owned).to_vec()),
        ])
        .unwrap()
    }

    fn manifest() -> Manifest {
        Manifest {
            seed: Some(7),
            ..Manifest::new("00ff")
                .with("command", "sweep")
                .with("over", "drive.shaker.frequency=4Hz:20Hz:0.1Hz")
        }
    }

    /// True where the bits are equal; `==` differs for NaN and -0.
    fn same_bits(a: &Table, b: &Table) -> bool {
        let bits = |t: &Table| {
            t.floats("power_w")
                .unwrap()
                .iter()
                .map(|x| x.to_bits())
                .collect::<Vec<_>>()
        };
        bits(a) == bits(b) && a.columns()[1..] == b.columns()[1..]
    }

    #[test]
    fn csv_and_parquet_round_trip_bit_for_bit() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["t.csv", "t.parquet"] {
            let path = folder.path().join(name);
            awkward().write(&path, &manifest()).unwrap();
            let (table, read) = Table::read(&path).unwrap();
            assert!(same_bits(&table, &awkward()), "{name}: {table:?}");
            assert_eq!(read, manifest(), "{name}");
            assert_eq!(table.columns()[0].unit, "W");
        }
    }

    #[test]
    fn the_same_table_gives_the_same_bytes() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["t.csv", "t.parquet", "t.json"] {
            let (a, b) = (
                folder.path().join(name),
                folder.path().join(format!("again-{name}")),
            );
            awkward().write(&a, &manifest()).unwrap();
            awkward().write(&b, &manifest()).unwrap();
            assert_eq!(
                std::fs::read(&a).unwrap(),
                std::fs::read(&b).unwrap(),
                "{name}"
            );
        }
    }

    #[test]
    fn empty_tables_survive() {
        let folder = tempfile::tempdir().unwrap();
        let no_rows = Table::new(vec![Column::new("a", "m", "", Vec::<f64>::new())]).unwrap();
        for (name, table) in [
            ("a.csv", &no_rows),
            ("a.parquet", &no_rows),
            ("b.csv", &Table::default()),
            ("b.parquet", &Table::default()),
        ] {
            let path = folder.path().join(name);
            table.write(&path, &manifest()).unwrap();
            assert_eq!(&Table::read(&path).unwrap().0, table, "{name}");
        }
    }

    #[test]
    fn unequal_lengths_and_double_names_are_errors() {
        let two = || Column::new("a", "", "", vec![1.0, 2.0]);
        let three = Column::new("b", "", "", vec![1.0, 2.0, 3.0]);
        assert!(matches!(
            Table::new(vec![two(), three]),
            Err(TableError::Lengths {
                rows: 3,
                expected: 2,
                ..
            })
        ));
        assert!(matches!(
            Table::new(vec![two(), two()]),
            Err(TableError::Name { .. })
        ));
    }

    #[test]
    fn unwritable_or_unreadable_path_is_an_error() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        assert!(matches!(
            awkward().write(&at("no/t.csv"), &manifest()),
            Err(TableError::Store(_))
        ));
        assert!(matches!(
            awkward().write(&at("t.xls"), &manifest()),
            Err(TableError::Format { .. })
        ));
        for name in ["t.csv", "t.parquet"] {
            assert!(
                matches!(Table::read(&at(name)), Err(TableError::Read { .. })),
                "{name} is missing"
            );
            std::fs::write(at(name), b"\xff\x00garbage").unwrap();
            assert!(
                matches!(Table::read(&at(name)), Err(TableError::Read { .. })),
                "{name} is garbage"
            );
        }
    }
}
