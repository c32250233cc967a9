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

pub(super) use heads::Head;
pub(super) use layout::{Delimiter, Layout};
pub(super) use lines::{line_end, whole_lines};
pub(super) use preamble::Preamble;
pub(super) use rows::{Rows, columns};

use super::contents::Found;
use super::error::Damage;
use super::raw::{Header, Raw, Stamps};
use super::shelf::Shelf;
use super::written::Written;
use crate::recording::{Finding, FindingKind, Place};

/// How much of a file is looked at first to find where its numbers begin, and at most. What a line is does not depend on it: the window grows until whole
/// lines show the rows, and a line that it cuts does not count.
const FIRST_WINDOW: u64 = 1 << 18;
const LARGEST_WINDOW: u64 = 1 << 26;

/// Reads a text: the layout from its head, then its rows one by one, so that memory never holds the text.
pub(super) fn read(path: &Path, shelf: &Shelf) -> Result<Found, Damage> {
    let told = |fault: std::io::Error| Damage::new(fault.to_string());
    let mut file = File::open(path).map_err(told)?;
    let size = file.metadata().map_err(told)?.len();
    let (layout, odd_line) = found_layout(&mut file, size)?;
    file.rewind().map_err(told)?;
    let Rows { mut columns, mut findings } = columns(BufReader::with_capacity(1 << 20, file), size, &layout, shelf)?;
    let written = Written::beside(path, &columns);
    written.iter().for_each(|written| columns.iter_mut().for_each(|column| written.tell(column)));
    settle::settle(&mut columns, &layout)?;
    findings.extend(layout.doubts);
    if let Some(line) = odd_line {
        let about = "the header is not UTF-8; it was read as Latin-1".to_owned();
        findings.push(Finding::new(FindingKind::Encoding, 1, Some(Place::Line(line)), about));
    }
    let stamps = match layout.preamble.rate {
        Some(rate) => Stamps::Header(Header { rate, start: layout.preamble.start.unwrap_or(0.0), stamps: None }),
        None => Stamps::Named,
    };
    Ok(Raw { stamps, ..Raw::columns(columns, findings) }.into())
}

/// The layout, and the first line that is no UTF-8.
fn found_layout(file: &mut File, size: u64) -> Result<(Layout, Option<usize>), Damage> {
    let told = |fault: std::io::Error| Damage::new(fault.to_string());
    let (mut head, mut window) = (Vec::new(), FIRST_WINDOW);
    loop {
        let missing = window - head.len() as u64;
        file.by_ref().take(missing).read_to_end(&mut head).map_err(told)?;
        let is_all = (head.len() as u64) < window || head.len() as u64 >= size;
        let end = line_end(&head);
        let (text, latin) = decoded(&head);
        if let Some(layout) = Layout::find(&whole_lines(&text, end, is_all), end) {
            let odd = head.split(|b| *b == end).position(|line| !line.is_ascii()).map_or(1, |line| line + 1);
            return Ok((layout, latin.then_some(odd)));
        }
        if is_all || window >= LARGEST_WINDOW {
            return Err(Damage::new("it holds no rows of numbers"));
        }
        window *= 4;
    }
}

/// The head of a file as text, and true where it is no UTF-8.
pub(super) fn decoded(bytes: &[u8]) -> (String, bool) {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    match std::str::from_utf8(bytes) {
        Ok(text) => (text.to_owned(), false),
        // A character cut in two by the end of the head.
        Err(fault) if fault.error_len().is_none() => (String::from_utf8_lossy(&bytes[..fault.valid_up_to()]).into_owned(), false),
        Err(_) => (bytes.iter().map(|b| char::from(*b)).collect(), true),
    }
}
