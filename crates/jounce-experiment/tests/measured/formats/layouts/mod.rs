//! Text layouts of oscilloscopes, loggers and programs: one writer each, and the expected reading.
//! The book has the same table.

mod faults;
mod loggers;
mod oscilloscopes;
mod other_oscilloscopes;
mod programs;

use super::through_a_file::read;
use jounce_data::recording::{Grid, Over};
use std::f64::consts::TAU;

/// Samples of each channel.
const COUNT: usize = 400;

/// Layout with its expected reading.
struct Layout {
    /// Instrument or program.
    program: &'static str,
    series: &'static str,
    /// Recognised content, for the table.
    recognised: &'static str,
    /// Required notes on time, rate and channels, for the table and as notes.
    by_hand: &'static str,
    notes: &'static str,
    /// Text of the error without the notes.
    refused: &'static str,
    text: String,
    rate_hz: f64,
    start_s: f64,
    /// Names and SI units of the channels.
    channels: &'static [(&'static str, &'static str)],
}

const TWO: &[(&str, &str)] = &[("CH1", "V"), ("CH2", "V")];

impl Default for Layout {
    fn default() -> Self {
        let (program, series, recognised, by_hand, notes, refused) =
            ("", "", "rate, start, names, units", "", "", "");
        Self {
            program,
            series,
            recognised,
            by_hand,
            notes,
            refused,
            text: String::new(),
            rate_hz: 1e4,
            start_s: -0.02,
            channels: TWO,
        }
    }
}

/// Sample `k` of a channel in its SI unit: ten samples per cycle, with a different phase and
/// amplitude in each channel.
fn sample(channel: usize, k: usize) -> f64 {
    [0.8, 0.4, 0.3][channel % 3] * (TAU * 0.1 * k as f64 + channel as f64).sin()
}

/// Rows of a text, each generated from its number.
fn rows(row: impl Fn(usize) -> String) -> String {
    (0..COUNT).map(|k| row(k) + "\n").collect()
}

/// The time of sample `k` of records at 10 kHz that begin 20 ms before the trigger.
fn scope_time(k: usize) -> f64 {
    (k as f64 - 200.0) * 1e-4
}

fn all() -> Vec<Layout> {
    [
        oscilloscopes::all(),
        other_oscilloscopes::all(),
        loggers::all(),
        programs::all(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

fn file_name(layout: &Layout) -> &'static str {
    if layout.text.starts_with("LabVIEW Measurement") {
        "a.lvm"
    } else {
        "a.csv"
    }
}

/// Faults of a recording of a layout.
fn faults(layout: &Layout, text: &str) -> Vec<String> {
    let notes = (!layout.notes.is_empty()).then_some(layout.notes);
    let contents = match read(file_name(layout), text.as_bytes(), notes) {
        Ok(contents) => contents,
        Err(fault) => return vec![fault.to_string()],
    };
    let [recording] = &contents.recordings[..] else {
        return vec![format!("{} recordings", contents.recordings.len())];
    };
    let mut faults = Vec::new();
    let heads: Vec<(&str, &str)> = recording
        .channels
        .iter()
        .map(|channel| (channel.name.as_str(), channel.unit.as_str()))
        .collect();
    if heads != layout.channels || recording.over != Over::Time {
        faults.push(format!("channels {heads:?}"));
    }
    let error = (recording.rate() / layout.rate_hz - 1.0).abs();
    if error > 1e-9 || !matches!(recording.grid, Grid::Even { .. }) {
        faults.push(format!("{} Hz", recording.rate()));
    }
    if (recording.grid.at(0) - layout.start_s).abs() > 1e-9 {
        faults.push(format!("starts at {}", recording.grid.at(0)));
    }
    for (c, channel) in recording.channels.iter().enumerate() {
        let error = channel
            .values
            .iter()
            .enumerate()
            .map(|(k, x)| (x - sample(c, k)).abs())
            .fold(0.0, f64::max);
        if channel.values.len() != COUNT || error.is_nan() || error > 6e-3 {
            faults.push(format!(
                "{}: {} samples, off by {error}",
                channel.name,
                channel.values.len()
            ));
        }
    }
    if !faults.is_empty() {
        faults.extend(recording.issues.iter().map(ToString::to_string));
    }
    faults
}

fn report(faults: Vec<(String, Vec<String>)>) {
    let wrong_layouts: Vec<String> = faults
        .into_iter()
        .filter(|(_, faults)| !faults.is_empty())
        .map(|(name, faults)| format!("{name}: {faults:#?}"))
        .collect();
    assert!(
        wrong_layouts.is_empty(),
        "{} layouts are read wrong:\n{}",
        wrong_layouts.len(),
        wrong_layouts.join("\n")
    );
}

fn name(layout: &Layout) -> String {
    format!("{}, {}", layout.program, layout.series)
}

/// Each layout gives its rate, start, names, units and samples. A file that needs notes is refused
/// without them.
#[test]
fn every_layout_is_read_as_in_the_table() {
    let check_layout = |layout: &Layout| {
        let mut faults_found = faults(layout, &layout.text);
        if !layout.refused.is_empty() {
            match read(file_name(layout), layout.text.as_bytes(), None) {
                Ok(_) => faults_found.push("it is not refused without notes".to_owned()),
                Err(fault) => {
                    let message = fault.to_string();
                    faults_found.extend(Some(message).filter(|message| {
                        !message.contains(layout.refused) || !message.contains(".channels.toml")
                    }));
                }
            }
        }
        (name(layout), faults_found)
    };
    report(all().iter().map(check_layout).collect());
}

/// Each layout with other line endings and empty rows at the end.
#[test]
fn line_endings_and_empty_rows_at_the_end_have_no_effect() {
    let check_layout = |layout: &Layout| {
        let last = layout.text.lines().last().unwrap_or_default();
        let delimiter = last.chars().find(|c| ",;\t".contains(*c)).unwrap_or(' ');
        let empty = format!(
            "{}\n",
            delimiter
                .to_string()
                .repeat(last.matches(delimiter).count())
        );
        let texts = [
            layout.text.replace('\n', "\r\n"),
            layout.text.replace('\n', "\r"),
            layout.text.clone() + &empty.repeat(3),
        ];
        (
            name(layout),
            texts.iter().flat_map(|text| faults(layout, text)).collect(),
        )
    };
    report(all().iter().map(check_layout).collect());
}

/// The table of the book has exactly these layouts.
#[test]
fn the_table_of_the_book_is_this_list() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../book/src/howto/text-layouts.md");
    let book = std::fs::read_to_string(&path)
        .unwrap_or_else(|fault| panic!("{}: {fault}", path.display()));
    let row = |layout: &Layout| {
        format!(
            "| {} | {} | {} | {} |",
            layout.program, layout.series, layout.recognised, layout.by_hand
        )
    };
    let expected: Vec<String> = all().iter().map(row).collect();
    let book_rows: Vec<&str> = book
        .lines()
        .filter(|line| line.starts_with("| "))
        .skip(1)
        .collect();
    assert!(expected.len() >= 40, "{}", expected.len());
    assert_eq!(
        book_rows,
        expected,
        "the table should be\n{}",
        expected.join("\n")
    );
}
