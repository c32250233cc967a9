//! LabVIEW measurement files (LVM): text with a header of the file and a header of each segment.
//!
//! With `X_Columns` `Multi`, a column of times precedes each channel. Header entries of a channel
//! are above its values, not above its times.
//!
//! Source: National Instruments, "LabVIEW Measurement File (LVM) Format". If the stamps agree with
//! `Delta_X` within their digits, `Delta_X` is the step. Otherwise the stamps are used: programs
//! that decimate a record often leave its `Delta_X` and `Samples` unchanged.

mod header;
mod sets;

use std::fs::File;
use std::io::{BufReader, Read as _};
use std::path::Path;

use super::text::{Rows, columns, decoded, line_end};
use crate::read::column::samples::SampleStore;
use crate::read::contents::FormatContents;
use crate::read::error::Damage;
use header::Header;
use jounce_io::store;

const HEAD_BYTES: u64 = 1 << 18;

pub(in crate::read) fn read(path: &Path, store: &SampleStore) -> Result<FormatContents, Damage> {
    let io_error = |fault: std::io::Error| Damage::new(store::reason(&fault));
    let mut head = Vec::new();
    File::open(path)
        .map_err(io_error)?
        .take(HEAD_BYTES)
        .read_to_end(&mut head)
        .map_err(io_error)?;
    let end = line_end(&head);
    let (head, _) = decoded(&head);
    let header = Header::read(&head, end)?;
    let file = File::open(path).map_err(io_error)?;
    let size = file.metadata().map_err(io_error)?.len();
    let Rows { columns, issues } = columns(
        BufReader::with_capacity(1 << 20, file),
        size,
        &header.layout,
        store,
    )?;
    let (sets, issues) = header.sets(columns, issues, store)?;
    Ok(FormatContents {
        sets,
        shapes: Vec::new(),
        issues,
    })
}
