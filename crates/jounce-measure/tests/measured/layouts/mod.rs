//! Layouts of the texts that oscilloscopes, loggers and programs write: one writer each, and what is read of it. The table of the book holds the same list.

mod faults;
mod loggers;
mod oscilloscopes;
mod programs;

use super::through_a_file::read;
use jounce_measure::recording::{Over, Recording};
use std::f64::consts::TAU;

/// Samples of each channel.
const COUNT: usize = 400;

/// A layout, and what is read of it.
struct Layout {
    /// Who writes it.
    program: &'static str,
    series: &'static str,
    /// What is read of it, for the table.
    recognised: &'static str,
    /// What the notes must say, for the table and as notes: of time, rate and channels.
    by_hand: &'static str,
    notes: &'static str,
    /// What the error says without the notes.
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
        let (program, series, recognised, by_hand, notes, refused) = ("", "", "rate, start, names, units", "", "", "");
        Self { program, series, recognised, by_hand, notes, refused, text: String::new(), rate_hz: 1e4, start_s: -0.02, channels: TWO }
    }
}

/// Sample `k` of a channel in its SI unit: ten samples in a cycle, another phase and size in each channel.
fn sample(channel: usize, k: usize) -> f64 {
    [0.8, 0.4, 0.3][channel % 3] * (TAU * 0.1 * k as f64 + channel as f64).sin()
}

/// Rows of a text, each made from its number.
fn rows(row: impl Fn(usize) -> String) -> String {
    (0..COUNT).map(|k| row(k) + "\n").collect()
}

/// The time of sample `k` of records at 10 kHz that begin 20 ms before the trigger.
fn scope_time(k: usize) -> f64 {
    (k as f64 - 200.0) * 1e-4
}

fn all() -> Vec<Layout> {
    [oscilloscopes::all(), loggers::all(), programs::all()].into_iter().flatten().collect()
}

fn file_name(layout: &Layout) -> &'static str {
    if layout.text.starts_with("LabVIEW Measurement") { "a.lvm" } else { "a.csv" }
}

fn check(layout: &Layout, found: &Recording) {
    let name = format!("{}, {}", layout.program, layout.series);
    assert_eq!(found.over, Over::Time, "{name}");
    let heads: Vec<(&str, &str)> = found.channels.iter().map(|channel| (channel.name.as_str(), channel.unit.as_str())).collect();
    assert_eq!(heads, layout.channels, "{name}: {:#?}", found.findings);
    assert!((found.rate() / layout.rate_hz - 1.0).abs() < 1e-9, "{name}: {} Hz, {:#?}", found.rate(), found.findings);
    assert!(matches!(found.grid, jounce_measure::recording::Grid::Even { .. }), "{name}: {:#?}", found.findings);
    assert!((found.grid.at(0) - layout.start_s).abs() < 1e-9, "{name}: starts at {}", found.grid.at(0));
    for (c, channel) in found.channels.iter().enumerate() {
        assert_eq!(channel.values.len(), COUNT, "{name}");
        let off = channel.values.iter().enumerate().map(|(k, x)| (x - sample(c, k)).abs()).fold(0.0, f64::max);
        assert!(off < 6e-3, "{name}, {}: off by {off}", channel.name);
    }
}

/// Each layout gives its rate, start, names, units and samples; where something must be said by hand the file is refused until the notes say it.
#[test]
fn every_layout_is_read_as_the_table_says() {
    for layout in all() {
        let name = format!("{}, {}", layout.program, layout.series);
        let notes = (!layout.notes.is_empty()).then_some(layout.notes);
        if !layout.refused.is_empty() {
            let wrong = read(file_name(&layout), layout.text.as_bytes(), None).expect_err(&name).to_string();
            assert!(wrong.contains(layout.refused) && wrong.contains(".channels.toml"), "{name}: {wrong}");
        }
        let contents = read(file_name(&layout), layout.text.as_bytes(), notes).unwrap_or_else(|fault| panic!("{name}: {fault}"));
        assert_eq!(contents.recordings.len(), 1, "{name}");
        check(&layout, &contents.recordings[0]);
    }
}

/// The same with other ends of lines and empty rows at the end.
#[test]
fn ends_of_lines_and_empty_rows_at_the_end_change_nothing() {
    for layout in all() {
        let notes = (!layout.notes.is_empty()).then_some(layout.notes);
        let delimiter = layout.text.lines().last().and_then(|line| line.chars().find(|c| ",;\t".contains(*c))).unwrap_or(' ');
        let width = layout.text.lines().last().map_or(0, |line| line.matches(delimiter).count());
        let empty = format!("{}\n", delimiter.to_string().repeat(width));
        for text in [layout.text.replace('\n', "\r\n"), layout.text.replace('\n', "\r"), layout.text.clone() + &empty.repeat(3)] {
            let contents = read(file_name(&layout), text.as_bytes(), notes).unwrap_or_else(|fault| panic!("{}: {fault}", layout.program));
            check(&layout, &contents.recordings[0]);
        }
    }
}

/// The table of the book holds each layout, and no other.
#[test]
fn the_table_of_the_book_is_this_list() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../book/src/howto/text-layouts.md");
    let book = std::fs::read_to_string(&path).unwrap_or_else(|fault| panic!("{}: {fault}", path.display()));
    let row = |layout: &Layout| format!("| {} | {} | {} | {} |", layout.program, layout.series, layout.recognised, layout.by_hand);
    let due: Vec<String> = all().iter().map(row).collect();
    let found: Vec<&str> = book.lines().filter(|line| line.starts_with("| ")).skip(1).collect();
    assert!(due.len() >= 40, "{}", due.len());
    assert_eq!(found, due, "the table should be\n{}", due.join("\n"));
}
