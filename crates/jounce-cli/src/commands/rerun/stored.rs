//! A file of results of any kind: a table or a picture.

use crate::failure::Failure;
use jounce::Error;
use jounce::parts::{Manifest, PictureDifference, StoredPicture, StoredTable, TableDifference};
use serde::Serialize;
use std::path::Path;

/// Extension of a page with the table of a study.
const PAGE: &str = "html";

/// Contents of a file of results.
pub enum Stored {
    /// Columns of values.
    Table(StoredTable),
    /// A drawing.
    Picture(StoredPicture),
}

/// First difference of two files.
#[derive(Debug, Serialize)]
#[serde(untagged)]
pub enum Difference {
    /// Of two tables.
    Table(TableDifference),
    /// Of two pictures.
    Picture(PictureDifference),
    /// A file of another kind.
    Kind,
}

impl Stored {
    /// Reads a file of results.
    pub fn read(path: &Path) -> Result<Self, Failure> {
        if !path.exists() {
            return Err(Failure::Input(format!("{} does not exist", path.display())));
        }
        match path.extension().and_then(|extension| extension.to_str()) {
            Some("csv" | "parquet" | "json" | PAGE) => {
                Ok(Self::Table(StoredTable::read(path).map_err(Error::from)?))
            }
            Some("svg" | "png" | "pdf") => {
                let picture = StoredPicture::read(path).map_err(Error::from)?;
                Ok(Self::Picture(picture))
            }
            _ => Err(Failure::Input(format!(
                "{}: only tables and pictures have a record of their command: give a .csv, .parquet, .json, .svg, .png or .pdf file that a command wrote, or the .html page of a study; in Python, jounce.rerun takes what `save` wrote",
                path.display()
            ))),
        }
    }

    /// Returns the extension of the file that the command writes anew. A page holds the table of a
    /// study, which is written in Parquet.
    pub fn extension(path: &Path) -> &str {
        match path.extension().and_then(|extension| extension.to_str()) {
            Some(PAGE) => "parquet",
            extension => extension.unwrap_or(""),
        }
    }

    /// Returns the origin of the file.
    pub fn manifest(&self) -> &Manifest {
        match self {
            Self::Table(table) => &table.manifest,
            Self::Picture(picture) => &picture.manifest,
        }
    }

    /// Returns the size in words.
    pub fn size(&self) -> String {
        match self {
            Self::Table(table) => format!("{} columns, {} rows", table.width(), table.rows()),
            Self::Picture(_) => "the picture".to_owned(),
        }
    }

    /// Returns the numbers of columns and rows of a table.
    pub fn counts(&self) -> Option<[usize; 2]> {
        match self {
            Self::Table(table) => Some([table.width(), table.rows()]),
            Self::Picture(_) => None,
        }
    }

    /// Returns the first difference from another file.
    pub fn first_difference(&self, other: &Self) -> Option<Difference> {
        match (self, other) {
            (Self::Table(one), Self::Table(two)) => {
                one.first_difference(two).map(Difference::Table)
            }
            (Self::Picture(one), Self::Picture(two)) => {
                one.first_difference(two).map(Difference::Picture)
            }
            _ => Some(Difference::Kind),
        }
    }
}

impl Difference {
    /// Returns the place and both contents as a sentence.
    pub fn text(&self) -> String {
        let (place, first, second) = match self {
            Self::Table(difference) => (place(difference), &difference.first, &difference.second),
            Self::Picture(difference) => (
                difference.place.clone(),
                &difference.first,
                &difference.second,
            ),
            Self::Kind => {
                return "it is of another kind than the file that was computed".to_owned();
            }
        };
        format!("{place}: the file has {first}, computed {second}")
    }
}

fn place(difference: &TableDifference) -> String {
    let TableDifference {
        what, column, row, ..
    } = difference;
    match row {
        Some(row) => format!("column {column}, row {row}"),
        None if *what == "column" => "name of a column".to_owned(),
        None => format!("column {column}, {what}"),
    }
}
