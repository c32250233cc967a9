//! CSV and text with any header.
mod apply_preamble;
mod delimiter;
mod growing_column;
mod heads;
mod layout;
mod lines;
mod moment;
mod number;
mod number_rows;
mod preamble;
mod rows;
mod settings_keys;

use std::fs::File;
use std::io::{BufReader, Read, Seek};
use std::path::Path;

pub(in crate::read) use delimiter::Delimiter;
pub(in crate::read) use heads::ColumnHead;
pub(in crate::read) use layout::TextLayout;
pub(in crate::read) use lines::{complete_lines, line_end};
pub(in crate::read) use preamble::Preamble;
pub(in crate::read) use rows::{Rows, columns};

use crate::read::column::raw::{Header, Raw, TimeStamps};
use crate::read::column::samples::SampleStore;
use crate::read::contents::FormatContents;
use crate::read::error::Damage;
use crate::read::notes::written::WrittenNotes;
use crate::recording::{Issue, IssueKind, IssuePlace};
use jounce_io::store;
use jounce_units::clip;

/// Initial and maximum size of the window in which the first row of numbers is searched. The result
/// does not depend on it: the window grows until complete lines show the rows, and a truncated line
/// is ignored.
const INITIAL_WINDOW: u64 = 1 << 18;
const MAX_WINDOW: u64 = 1 << 26;

/// Reads a text: the layout from its head, then row by row, so memory never holds the complete
/// text.
pub(in crate::read) fn read(path: &Path, store: &SampleStore) -> Result<FormatContents, Damage> {
    let io_error = |fault: std::io::Error| Damage::new(store::reason(&fault));
    let mut file = File::open(path).map_err(io_error)?;
    let size = file.metadata().map_err(io_error)?.len();
    let (layout, invalid_line) = find_layout(&mut file, size)?;
    file.rewind().map_err(io_error)?;
    let Rows {
        mut columns,
        mut issues,
    } = columns(
        BufReader::with_capacity(1 << 20, file),
        size,
        &layout,
        store,
    )?;
    let written_notes = WrittenNotes::for_file(path, &columns);
    written_notes.iter().for_each(|written_notes| {
        columns
            .iter_mut()
            .for_each(|column| written_notes.apply_to(column))
    });
    apply_preamble::apply_preamble(&mut columns, &layout)?;
    issues.extend(layout.issues);
    if let Some(line) = invalid_line {
        let message = "the header is not UTF-8; it was read as Latin-1".to_owned();
        issues.push(Issue::new(
            IssueKind::Encoding,
            1,
            Some(IssuePlace::Line(line)),
            message,
        ));
    }
    let stamps = match layout.preamble.rate {
        Some(rate) => TimeStamps::Header(Header {
            rate,
            start: layout.preamble.start.unwrap_or(0.0),
            stamps: None,
        }),
        None => TimeStamps::Named,
    };
    Ok(Raw {
        stamps,
        ..Raw::columns(columns, issues)
    }
    .into())
}

/// Finds the layout, and the first line that is not UTF-8.
fn find_layout(file: &mut File, size: u64) -> Result<(TextLayout, Option<usize>), Damage> {
    let io_error = |fault: std::io::Error| Damage::new(store::reason(&fault));
    let (mut head, mut window) = (Vec::new(), INITIAL_WINDOW);
    loop {
        let remaining = window - head.len() as u64;
        file.by_ref()
            .take(remaining)
            .read_to_end(&mut head)
            .map_err(io_error)?;
        let is_all = (head.len() as u64) < window || head.len() as u64 >= size;
        let end = line_end(&head);
        let (text, latin) = decoded(&head);
        if let Some(layout) = TextLayout::find(&complete_lines(&text, end, is_all), end) {
            let invalid = head
                .split(|b| *b == end)
                .position(|line| !line.is_ascii())
                .map_or(1, |line| line + 1);
            return Ok((layout, latin.then_some(invalid)));
        }
        if is_all || window >= MAX_WINDOW {
            let lines: Vec<&str> = text.lines().collect();
            let first = lines.iter().find(|line| !line.trim().is_empty());
            let reason = match number_rows::has_numbers(&lines) {
                true => "no two successive rows have equally many numbers",
                false => "it contains no rows of numbers",
            };
            return Err(Damage::new(format!(
                "{reason}; columns are separated by commas, semicolons, tabs or blanks, but it begins with {:?}",
                clip(first.map_or("", |line| line.trim()))
            )));
        }
        window *= 4;
    }
}

/// Decodes the head of a file; true where it is not UTF-8.
pub(in crate::read) fn decoded(bytes: &[u8]) -> (String, bool) {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    match std::str::from_utf8(bytes) {
        Ok(text) => (text.to_owned(), false),
        // A character truncated by the end of the head.
        Err(fault) if fault.error_len().is_none() => (
            String::from_utf8_lossy(&bytes[..fault.valid_up_to()]).into_owned(),
            false,
        ),
        Err(_) => (bytes.iter().map(|b| char::from(*b)).collect(), true),
    }
}
