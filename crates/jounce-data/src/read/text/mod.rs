//! CSV and text with any header.
mod heads;
mod layout;
mod lines;
mod preamble;
mod rows;
mod settle;

use std::fs::File;
use std::io::{BufReader, Read, Seek};
use std::path::Path;

pub(super) use heads::ColumnHead;
pub(super) use layout::{Delimiter, TextLayout};
pub(super) use lines::{line_end, whole_lines};
pub(super) use preamble::Preamble;
pub(super) use rows::{Rows, columns};

use super::contents::FormatContents;
use super::error::Damage;
use super::jounce_notes::WrittenNotes;
use super::raw::{Header, Raw, TimeStamps};
use super::samples::SampleStore;
use crate::recording::{Issue, IssueKind, IssuePlace};

/// Initial and maximum size of the window in which the first row of numbers is searched. The result
/// does not depend on it: the window grows until complete lines show the rows, and a truncated line
/// is ignored.
const INITIAL_WINDOW: u64 = 1 << 18;
const MAX_WINDOW: u64 = 1 << 26;

/// Reads a text: the layout from its head, then row by row, so memory never holds the complete
/// text.
pub(super) fn read(path: &Path, store: &SampleStore) -> Result<FormatContents, Damage> {
    let told = |fault: std::io::Error| Damage::new(fault.to_string());
    let mut file = File::open(path).map_err(told)?;
    let size = file.metadata().map_err(told)?.len();
    let (layout, odd_line) = found_layout(&mut file, size)?;
    file.rewind().map_err(told)?;
    let Rows {
        mut columns,
        mut findings,
    } = columns(
        BufReader::with_capacity(1 << 20, file),
        size,
        &layout,
        store,
    )?;
    let written = WrittenNotes::beside(path, &columns);
    written
        .iter()
        .for_each(|written| columns.iter_mut().for_each(|column| written.tell(column)));
    settle::settle(&mut columns, &layout)?;
    findings.extend(layout.doubts);
    if let Some(line) = odd_line {
        let about = "the header is not UTF-8; it was read as Latin-1".to_owned();
        findings.push(Issue::new(
            IssueKind::Encoding,
            1,
            Some(IssuePlace::Line(line)),
            about,
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
        ..Raw::columns(columns, findings)
    }
    .into())
}

/// Finds the layout, and the first line that is not UTF-8.
fn found_layout(file: &mut File, size: u64) -> Result<(TextLayout, Option<usize>), Damage> {
    let told = |fault: std::io::Error| Damage::new(fault.to_string());
    let (mut head, mut window) = (Vec::new(), INITIAL_WINDOW);
    loop {
        let missing = window - head.len() as u64;
        file.by_ref()
            .take(missing)
            .read_to_end(&mut head)
            .map_err(told)?;
        let is_all = (head.len() as u64) < window || head.len() as u64 >= size;
        let end = line_end(&head);
        let (text, latin) = decoded(&head);
        if let Some(layout) = TextLayout::find(&whole_lines(&text, end, is_all), end) {
            let odd = head
                .split(|b| *b == end)
                .position(|line| !line.is_ascii())
                .map_or(1, |line| line + 1);
            return Ok((layout, latin.then_some(odd)));
        }
        if is_all || window >= MAX_WINDOW {
            return Err(Damage::new("it contains no rows of numbers"));
        }
        window *= 4;
    }
}

/// Decodes the head of a file; true where it is not UTF-8.
pub(super) fn decoded(bytes: &[u8]) -> (String, bool) {
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
