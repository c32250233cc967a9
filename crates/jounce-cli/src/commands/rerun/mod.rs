//! `jounce rerun FILE`

mod mirror;
mod stored;

use crate::failure::Failure;
use crate::output::{self, line};
use crate::record::COMMANDS;
use clap::Args;
use jounce::parts::{Manifest, Record};
use mirror::Mirror;
use serde::Serialize;
use std::path::{Path, PathBuf};
use stored::{Difference, Stored};

/// Arguments of `rerun`.
#[derive(Debug, Args)]
pub struct Rerun {
    /// Table or picture that a command wrote: .csv (with its .manifest.json next to it), .parquet,
    /// .json, .svg, .png, .pdf, or the .html page of a study. Recordings are looked up in the current folder, as the command named them.
    file: PathBuf,
    /// Prints one JSON object on stdout; by default lines of text.
    #[arg(long)]
    pub json: bool,
}

/// Result of `rerun`.
#[derive(Debug, Serialize)]
struct RerunResult<'a> {
    /// True where all values or the pictures are equal, bit by bit.
    equal: bool,
    /// Arguments of the command.
    arguments: &'a [String],
    /// Columns of the stored table.
    #[serde(skip_serializing_if = "Option::is_none")]
    columns: Option<usize>,
    /// Rows of the stored table.
    #[serde(skip_serializing_if = "Option::is_none")]
    rows: Option<usize>,
    /// Version that wrote the file.
    stored_version: &'a str,
    /// Version that made the result again.
    version: &'static str,
    /// First difference; `None` where all is equal.
    difference: Option<Difference>,
}

impl Rerun {
    /// Makes the file again in a temporary folder and compares.
    pub fn run(&self) -> Result<(), Failure> {
        let stored = Stored::read(&self.file)?;
        let record = self.record(stored.manifest())?;
        let extension = Stored::extension(&self.file);
        let mirror = Mirror::new(record)?;
        mirror.run(record, extension)?;
        let computed = Stored::read(&mirror.file(&record.table, extension))?;
        let difference = stored.first_difference(&computed);
        let result = RerunResult {
            equal: difference.is_none(),
            arguments: &record.arguments,
            columns: stored.counts().map(|[columns, _]| columns),
            rows: stored.counts().map(|[_, rows]| rows),
            stored_version: &stored.manifest().version,
            version: env!("CARGO_PKG_VERSION"),
            difference,
        };
        match self.json {
            true => line(output::to_json(&result)?),
            false => result.print(&self.file, &stored.size()),
        }
        match result.equal {
            true => Ok(()),
            false => Err(Failure::Different(result.text(&self.file))),
        }
    }

    /// Returns the record of a file, if a command is in it.
    fn record<'a>(&self, manifest: &'a Manifest) -> Result<&'a Record, Failure> {
        let file = self.file.display();
        let Some(record) = &manifest.record else {
            let command = manifest.options.get("command").map_or("", String::as_str);
            let text = format!(
                "{file}: the file has no record of its command (command \"{command}\", jounce {}); only files that {} wrote have one",
                manifest.version,
                COMMANDS.join(", ")
            );
            return Err(Failure::Input(text));
        };
        let command = record.command();
        if COMMANDS.contains(&command) {
            return Ok(record);
        }
        let text = format!(
            "{file}: its record names the command \"{command}\"; a file of results comes from {}",
            COMMANDS.join(", ")
        );
        Err(Failure::Input(text))
    }
}

impl RerunResult<'_> {
    /// Prints the command, and that all is equal.
    fn print(&self, file: &Path, size: &str) {
        line(format!("command   jounce {}", self.arguments.join(" ")));
        if self.stored_version != self.version {
            let (stored, version) = (self.stored_version, self.version);
            line(format!(
                "version   {stored} wrote the file, this is {version}"
            ));
        }
        if self.equal {
            line(format!("equal     {}: {size}, bit by bit", file.display()));
        }
    }

    /// Returns the first difference as a sentence.
    fn text(&self, file: &Path) -> String {
        let file = file.display();
        let Some(difference) = &self.difference else {
            return String::new();
        };
        let version = match self.stored_version == self.version {
            true => String::new(),
            false => format!(
                " (jounce {} wrote the file, this is {})",
                self.stored_version, self.version
            ),
        };
        format!("{file}: different: {}{version}", difference.text())
    }
}
