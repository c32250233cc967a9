//! `jounce rerun FILE`

mod mirror;

use crate::failure::Failure;
use crate::output::{self, line, print};
use crate::record::COMMANDS;
use clap::Args;
use jounce::Error;
use jounce::parts::{Manifest, Record, StoredTable, TableDifference};
use mirror::Mirror;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Extension of a page with the table of a study.
const PAGE: &str = "html";

/// Arguments of `rerun`.
#[derive(Debug, Args)]
pub struct Rerun {
    /// Table that a command wrote with --out: .csv (with its .manifest.json next to it), .parquet,
    /// .json, or the .html page of a study. Recordings are looked up in the current folder, as the command named them.
    file: PathBuf,
    /// Prints one JSON object on stdout; by default lines of text.
    #[arg(long)]
    pub json: bool,
}

/// Result of `rerun`.
#[derive(Debug, Serialize)]
struct RerunResult<'a> {
    /// True where all values are equal, bit by bit.
    equal: bool,
    /// Arguments of the command.
    arguments: &'a [String],
    /// Columns of the stored table.
    columns: usize,
    /// Rows of the stored table.
    rows: usize,
    /// Version that wrote the file.
    stored_version: &'a str,
    /// Version that made the result again.
    version: &'static str,
    /// First difference; `None` where all values are equal.
    difference: Option<TableDifference>,
}

impl Rerun {
    /// Makes the table again in a temporary folder and compares.
    pub fn run(&self) -> Result<(), Failure> {
        let stored = self.stored()?;
        let record = self.record(&stored.manifest)?;
        let mirror = Mirror::new(record)?;
        mirror.run(record)?;
        let extension = self.file.extension().unwrap_or_default();
        // A page holds the table of a study, which is written in Parquet.
        let is_page = extension == PAGE;
        let extension = if is_page {
            "parquet".as_ref()
        } else {
            extension
        };
        let path = mirror.table(&record.table).with_extension(extension);
        let computed = StoredTable::read(&path).map_err(Error::from)?;
        let difference = stored.first_difference(&computed);
        let result = RerunResult {
            equal: difference.is_none(),
            arguments: &record.arguments,
            columns: stored.width(),
            rows: stored.rows(),
            stored_version: &stored.manifest.version,
            version: env!("CARGO_PKG_VERSION"),
            difference,
        };
        match self.json {
            true => print(&output::to_json(&result)?),
            false => result.print(&self.file),
        }
        match result.equal {
            true => Ok(()),
            false => Err(Failure::Different(result.text(&self.file))),
        }
    }

    fn stored(&self) -> Result<StoredTable, Failure> {
        let extension = self
            .file
            .extension()
            .and_then(|extension| extension.to_str());
        if !matches!(extension, Some("csv" | "parquet" | "json" | PAGE)) {
            let text = format!(
                "{}: only tables have a record of their command: give a .csv, .parquet or .json file that a command wrote with --out, or the .html page of a study",
                self.file.display()
            );
            return Err(Failure::Input(text));
        }
        Ok(StoredTable::read(&self.file).map_err(Error::from)?)
    }

    /// Returns the record of a table, if a command is in it.
    fn record<'a>(&self, manifest: &'a Manifest) -> Result<&'a Record, Failure> {
        let file = self.file.display();
        let Some(record) = &manifest.record else {
            let command = manifest.options.get("command").map_or("", String::as_str);
            let text = format!(
                "{file}: the file has no record of its command (command \"{command}\", jounce {}); only tables that {} wrote with --out have one",
                manifest.version,
                COMMANDS.join(", ")
            );
            return Err(Failure::Input(text));
        };
        let command = record.arguments.first().map_or("", String::as_str);
        if COMMANDS.contains(&command) {
            return Ok(record);
        }
        let text = format!(
            "{file}: its record names the command \"{command}\"; a table comes from {}",
            COMMANDS.join(", ")
        );
        Err(Failure::Input(text))
    }
}

impl RerunResult<'_> {
    /// Prints the command, and that all values are equal.
    fn print(&self, file: &Path) {
        line(format!("command   jounce {}", self.arguments.join(" ")));
        if self.stored_version != self.version {
            let (stored, version) = (self.stored_version, self.version);
            line(format!(
                "version   {stored} wrote the file, this is {version}"
            ));
        }
        if self.equal {
            let (columns, rows) = (self.columns, self.rows);
            let file = file.display();
            line(format!(
                "equal     {file}: {columns} columns, {rows} rows, bit by bit"
            ));
        }
    }

    /// Returns the first difference as a sentence.
    fn text(&self, file: &Path) -> String {
        let file = file.display();
        let Some(difference) = &self.difference else {
            return String::new();
        };
        let TableDifference {
            what,
            column,
            row,
            first,
            second,
        } = difference;
        let place = match row {
            Some(row) => format!("column {column}, row {row}"),
            None if *what == "column" => "name of a column".to_owned(),
            None => format!("column {column}, {what}"),
        };
        let version = match self.stored_version == self.version {
            true => String::new(),
            false => format!(
                " (jounce {} wrote the file, this is {})",
                self.stored_version, self.version
            ),
        };
        format!("{file}: different: {place}: the file has {first}, computed {second}{version}")
    }
}
