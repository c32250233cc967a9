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

/// A value of a key, in SI: with six decimals, and a small one with as many more as keep seven digits of it.
pub fn key_value(value: f64) -> String {
    match value.abs() {
        0.0 => format!("{value:.6}"),
        size if size >= 0.1 => format!("{value:.6}"),
        size if size >= 1e-2 => format!("{value:.8}"),
        size if size >= 1e-3 => format!("{value:.9}"),
        size if size >= 1e-4 => format!("{value:.10}"),
        _ => format!("{value:.6e}"),
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_value_keeps_its_digits() {
        let told = [12.321_816_8, 0.240_718_53, 1.000_01e-3, -2.5e-4, 4.6e-7, 0.0].map(key_value);
        assert_eq!(told, ["12.321817", "0.240719", "0.001000010", "-0.0002500000", "4.600000e-7", "0.000000"]);
    }
}
