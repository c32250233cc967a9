//! CSV and text with any header.
mod layout;
mod rows;

use std::fs::File;
use std::io::{BufReader, Read, Seek};
use std::path::Path;

pub(super) use layout::{Delimiter, Layout};
pub(super) use rows::{Rows, columns};

use super::contents::Found;
use super::error::Damage;
use super::raw::Raw;
use super::shelf::Shelf;
use super::written::Written;
use crate::recording::{Finding, FindingKind, Place};

/// How much of a file is looked at to find where its numbers begin.
const HEAD_BYTES: u64 = 1 << 18;

/// Reads a text: the layout from its head, then its rows one by one, so that memory never holds the text.
pub(super) fn read(path: &Path, shelf: &Shelf) -> Result<Found, Damage> {
    let told = |fault: std::io::Error| Damage::new(fault.to_string());
    let mut file = File::open(path).map_err(told)?;
    let mut head = Vec::new();
    file.by_ref().take(HEAD_BYTES).read_to_end(&mut head).map_err(told)?;
    let (text, latin) = decoded(&head);
    let layout = Layout::find(&text)?;
    file.rewind().map_err(told)?;
    let size = file.metadata().map_err(told)?.len();
    let Rows { mut columns, mut findings } = columns(BufReader::with_capacity(1 << 20, file), size, &layout, shelf)?;
    let written = Written::beside(path, &columns);
    written.iter().for_each(|written| columns.iter_mut().for_each(|column| written.tell(column)));
    findings.extend(layout.doubts);
    if latin {
        let line = head.split(|b| *b == b'\n').position(|line| !line.is_ascii()).map_or(1, |line| line + 1);
        let about = "the header is not UTF-8; it was read as Latin-1".to_owned();
        findings.push(Finding::new(FindingKind::Encoding, 1, Some(Place::Line(line)), about));
    }
    Ok(Raw::columns(columns, findings).into())
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
