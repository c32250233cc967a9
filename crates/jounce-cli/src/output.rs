//! Writing answers: JSON on stdout, tables and pictures into a folder.

use crate::failure::Failure;
use jounce::picture::Figure;
use jounce::table::{Manifest, Table};
use std::io::Write;
use std::path::Path;

/// Prints one JSON value on stdout. A reader that has gone away is no fault of ours.
pub fn print(value: &serde_json::Value) {
    let _ = writeln!(std::io::stdout().lock(), "{value}");
}

/// Prints a line on stdout.
pub fn line(text: impl std::fmt::Display) {
    let _ = writeln!(std::io::stdout().lock(), "{text}");
}

/// Prints a text on stdout as it is.
pub fn text(text: &str) {
    let _ = std::io::stdout().lock().write_all(text.as_bytes());
}

/// Writes a table as CSV, Parquet and JSON.
pub fn table(folder: &Path, name: &str, table: &Table, manifest: &Manifest) -> Result<(), Failure> {
    make(folder)?;
    for extension in ["csv", "parquet", "json"] {
        table.write(&folder.join(name).with_extension(extension), manifest)?;
    }
    Ok(())
}

/// Writes a figure as SVG and PNG.
pub fn figure(folder: &Path, name: &str, figure: &Figure) -> Result<(), Failure> {
    make(folder)?;
    for extension in ["svg", "png"] {
        figure.write(&folder.join(name).with_extension(extension))?;
    }
    Ok(())
}

fn make(folder: &Path) -> Result<(), Failure> {
    std::fs::create_dir_all(folder).map_err(|error| Failure::Input(format!("the folder {} cannot be made: {error}", folder.display())))
}
