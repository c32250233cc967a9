//! Output: JSON on stdout, tables and pictures in a folder.

use crate::failure::Failure;
use crate::option_names::on_command_line;
use crate::record;
use jounce::parts::{Column, Manifest, Record, Values, system_reason};
use jounce::{Error, Figure, Table};
use serde::Serialize;
use std::fmt::Display;
use std::io::{ErrorKind, Write};
use std::path::Path;
use std::sync::OnceLock;

/// Largest number of rows where a table is printed in part.
const FIRST_ROWS: usize = 10;

/// Width of a line where a table is printed in part, characters.
const LINE_WIDTH: usize = 100;

/// First failure to write to stdout.
static UNPRINTED: OnceLock<String> = OnceLock::new();

/// Prints a text on stdout unchanged. A closed stdout is not an error; others are kept for
/// [`check_printed`].
pub fn text(text: &str) {
    let mut stdout = std::io::stdout().lock();
    let written = stdout
        .write_all(text.as_bytes())
        .and_then(|()| stdout.flush());
    if let Err(error) = written
        && error.kind() != ErrorKind::BrokenPipe
    {
        let _ = UNPRINTED.set(system_reason(&error));
    }
}

/// Returns an error where a part of the result could not be printed.
///
/// # Errors
/// stdout is a file on a full disk.
pub fn check_printed() -> Result<(), Failure> {
    match UNPRINTED.get() {
        Some(reason) => Err(Failure::Input(format!(
            "cannot write the result to stdout: {reason}"
        ))),
        None => Ok(()),
    }
}

/// Prints a line on stderr. A message that cannot be written does not end the work.
pub fn note(text: impl Display) {
    let _ = writeln!(std::io::stderr().lock(), "{text}");
}

/// Returns a result as JSON.
pub fn to_json(result: &impl Serialize) -> Result<serde_json::Value, Failure> {
    serde_json::to_value(result).map_err(|error| Failure::Input(error.to_string()))
}

/// Prints a line, or one JSON value, on stdout.
pub fn line(line: impl Display) {
    text(&format!("{line}\n"));
}

/// Prints warnings on stderr. A warning is printed once, with the number of its repetitions.
pub fn warn(warnings: &[String]) {
    for (index, text) in warnings.iter().enumerate() {
        if warnings[..index].contains(text) {
            continue;
        }
        let count = warnings.iter().filter(|other| *other == text).count();
        let text = on_command_line(text);
        match count {
            1 => note(format!("warning: {text}")),
            _ => note(format!("warning: {text} ({count} times)")),
        }
    }
}

/// Prints a table on stdout, with the names of its columns; numbers that no row has are left out.
pub fn print_table(table: &Table) {
    let is_blank = |column: &&Column| match &column.values {
        Values::Float(values) => !values.is_empty() && values.iter().all(|value| value.is_nan()),
        _ => false,
    };
    let columns = table.columns().iter().filter(|column| !is_blank(column));
    let columns: Vec<Vec<String>> = columns.map(|column| cells(column, table.rows())).collect();
    print_columns(&columns);
}

/// Prints the first rows of a table on stdout, with the columns that fit into a line, and how many
/// rows and columns are left out.
pub fn print_first_rows(table: &Table) {
    let rows = table.rows().min(FIRST_ROWS);
    let mut width = 0;
    let fits = |cells: &Vec<String>| {
        width += cells[0].len() + 2;
        width <= LINE_WIDTH + 2
    };
    let columns = table.columns().iter().map(|column| cells(column, rows));
    let columns: Vec<Vec<String>> = columns.take_while(fits).collect();
    print_columns(&columns);
    let left_out = [
        (table.rows() - rows, "rows"),
        (table.columns().len() - columns.len(), "columns"),
    ];
    let left_out = left_out.iter().filter(|(count, _)| *count > 0);
    let texts: Vec<String> = left_out
        .map(|(count, what)| format!("{count} more {what}"))
        .collect();
    if !texts.is_empty() {
        line(format!("... {}", texts.join(", ")));
    }
}

/// Prints columns of cells, each of one width.
fn print_columns(columns: &[Vec<String>]) {
    for row in 0..columns.first().map_or(0, Vec::len) {
        let cells: Vec<&str> = columns.iter().map(|cells| cells[row].as_str()).collect();
        line(cells.join("  ").trim_end());
    }
}

/// Returns the name and the cells of a column, all of one width.
fn cells(column: &Column, rows: usize) -> Vec<String> {
    let cell = |row: usize| match &column.values {
        Values::Float(values) if column.unit == "W" => power(values[row]),
        Values::Float(values) => key_value(values[row]),
        values => values.text(row).unwrap_or_default(),
    };
    let mut cells = vec![column.name.clone()];
    cells.extend((0..rows).map(cell));
    let width = cells.iter().map(String::len).max().unwrap_or(0);
    let pad = |text: String| match column.values {
        Values::Text(_) => format!("{text:<width$}"),
        _ => format!("{text:>width$}"),
    };
    cells.into_iter().map(pad).collect()
}

/// Formats a value in SI: six decimals, or more where a small value needs them for seven
/// digits.
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

/// Returns the heading of a column of values of a key, as wide as its values.
pub fn key_heading(key: &str, unit: &str) -> String {
    let heading = match unit {
        "" => key.to_owned(),
        _ => format!("{key} [{unit}]"),
    };
    format!("{heading:>14}")
}

/// Formats a power in W: seven digits and a power of ten, so powers of any size compare at a glance.
pub fn power(power_w: f64) -> String {
    format!("{power_w:.6e}")
}

/// Powers of ten that are written without an exponent.
const PLAIN: std::ops::RangeInclusive<i32> = -3..=5;

/// Formats a value with the half width of its interval, both to the second digit of the half width:
/// `(6.9 +- 4.9)e-6 W`. A power has its power of ten, as in [`power`].
pub fn with_uncertainty(value: f64, half_width: f64, unit: &str) -> String {
    let unit_suffix = if unit.is_empty() {
        String::new()
    } else {
        format!(" {unit}")
    };
    let largest = value.abs().max(half_width.abs());
    if !(value.is_finite() && half_width.is_finite() && largest > 0.0) {
        return format!("{value} +- {half_width}{unit_suffix}");
    }
    let ten = |x: f64| x.abs().log10().floor() as i32;
    let exponent = if unit != "W" && PLAIN.contains(&ten(largest)) {
        0
    } else {
        ten(largest)
    };
    let scale = 10f64.powi(-exponent);
    // An uncertainty of zero needs no more digits than a number has.
    let last_digit = ten(half_width.max(largest * 1e-12)) - exponent;
    let digits = usize::try_from(1 - last_digit).unwrap_or(0);
    let numbers = format!(
        "{:.digits$} +- {:.digits$}",
        value * scale,
        half_width * scale
    );
    if exponent == 0 {
        format!("{numbers}{unit_suffix}")
    } else {
        format!("({numbers})e{exponent}{unit_suffix}")
    }
}

/// Writes a table as CSV, Parquet and JSON, with the record of this call.
pub fn table(folder: &Path, name: &str, table: &Table, manifest: &Manifest) -> Result<(), Failure> {
    let manifest = Manifest {
        record: record::of_file(name),
        ..manifest.clone()
    };
    for extension in ["csv", "parquet", "json"] {
        let path = folder.join(format!("{name}.{extension}"));
        table.write(&path, &manifest).map_err(Error::from)?;
    }
    Ok(())
}

/// Writes a figure as SVG, PNG and PDF, with the record of this call.
pub fn figure(folder: &Path, name: &str, figure: &Figure) -> Result<(), Failure> {
    let manifest = origin(record::of_file(name));
    for extension in ["svg", "png", "pdf"] {
        let path = folder.join(format!("{name}.{extension}"));
        figure.write_with(&path, &manifest).map_err(Error::from)?;
    }
    Ok(())
}

/// Returns the origin of a picture of this call.
pub fn origin(record: Option<Record>) -> Manifest {
    Manifest {
        record,
        ..Manifest::new("")
    }
}

/// Returns a count with its noun, in the plural unless it is 1.
pub fn counted(count: impl Display, noun: &str) -> String {
    match count.to_string().as_str() {
        "1" => format!("1 {noun}"),
        many => format!("{many} {noun}s"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_one_is_singular() {
        let texts = [0, 1, 2].map(|count| counted(count, "drive cycle"));
        assert_eq!(texts, ["0 drive cycles", "1 drive cycle", "2 drive cycles"]);
    }

    #[test]
    fn a_value_and_its_uncertainty_end_at_one_digit() {
        let cases = [
            (6.9123e-6, 4.9e-6, "W", "(6.9 +- 4.9)e-6 W"),
            (2.75, 0.0012, "W", "2.7500 +- 0.0012 W"),
            (1.2345e-3, 9.1e-5, "W", "(1.234 +- 0.091)e-3 W"),
            (0.0123, 0.0045, "W", "(1.23 +- 0.45)e-2 W"),
            (60.312_341, 1.23e-4, "Hz", "60.31234 +- 0.00012 Hz"),
            (0.0121, 0.000_34, "", "0.01210 +- 0.00034"),
            (123.0, 45.0, "ohm", "123 +- 45 ohm"),
            (1.234e7, 3.0e4, "Hz", "(1.2340 +- 0.0030)e7 Hz"),
            (1e-9, 4.2e-7, "W", "(0.0 +- 4.2)e-7 W"),
            (0.0, 0.0, "W", "0 +- 0 W"),
            (1.5, f64::NAN, "W", "1.5 +- NaN W"),
            (-2.5e-5, 1.0e-7, "V", "(-2.500 +- 0.010)e-5 V"),
        ];
        for (value, half_width, unit, expected) in cases {
            assert_eq!(with_uncertainty(value, half_width, unit), expected);
        }
        assert!(
            with_uncertainty(2.5, 0.0, "W").starts_with("2.5000000"),
            "{}",
            with_uncertainty(2.5, 0.0, "W")
        );
    }

    /// In a table too: neither four decimals of a watt, nor two forms in one column.
    #[test]
    fn powers_have_one_form() {
        let powers = [1.237e-3, 3.8e-5, 0.0, 12.0].map(power);
        let expected = ["1.237000e-3", "3.800000e-5", "0.000000e0", "1.200000e1"];
        assert_eq!(powers, expected);
        let column = |unit: &str| Column::new("x", unit, "", vec![1.237e-3]);
        let cell = |unit: &str| cells(&column(unit), 1).remove(1);
        assert_eq!(cell("W").trim(), "1.237000e-3");
        assert_eq!(cell("V").trim(), "0.001237000");
    }

    #[test]
    fn a_small_value_keeps_its_digits() {
        let texts = [
            12.321_816_8,
            0.240_718_53,
            1.000_01e-3,
            -2.5e-4,
            4.6e-7,
            0.0,
        ]
        .map(key_value);
        assert_eq!(
            texts,
            [
                "12.321817",
                "0.240719",
                "0.001000010",
                "-0.0002500000",
                "4.600000e-7",
                "0.000000"
            ]
        );
    }
}
