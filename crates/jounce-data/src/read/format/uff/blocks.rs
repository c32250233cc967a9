//! Splits a universal file into data sets, each between two lines that contain `-1`.

use std::io::{BufRead, Read as _};

use super::binary;
use super::header::{Header, LINES};
use super::numbers::numbers;
use crate::read::column::numbers::ColumnNumbers;
use crate::read::column::samples::SampleStore;
use crate::read::error::Damage;
use crate::recording::IssuePlace;
use jounce_io::store;

/// Maximum length of a line of a universal file, bytes.
const MAX_LINE_BYTES: u64 = 1 << 20;

/// One data set.
pub(super) struct Block {
    /// Number of the data set.
    pub number: u32,
    /// Offset of its contents in the file, byte.
    pub start: usize,
    /// Text lines; for data set 58 only the header.
    pub lines: Vec<String>,
    /// Data after the header of data set 58.
    pub data: Data,
}

/// Data of a data set 58.
pub(super) enum Data {
    /// Numbers from text lines; the first word that is not a number ends them.
    Lines(ColumnNumbers, Option<String>),
    /// Numbers from bytes, as many as the header specifies.
    Binary(ColumnNumbers),
}

/// Passes each data set of a file to `callback` in turn, so that the store contains one.
pub(super) fn blocks(
    source: impl BufRead,
    store: &SampleStore,
    mut callback: impl FnMut(Block) -> Result<(), Damage>,
) -> Result<(), Damage> {
    let mut cursor = Cursor {
        source,
        at: 0,
        line: Vec::new(),
    };
    while let Some(start) = cursor.next()? {
        if cursor.trimmed().is_empty() {
            continue;
        }
        if cursor.trimmed() != b"-1" {
            return Err(Damage::at(
                IssuePlace::Byte(start),
                format!(
                    "expected a line with -1 before a data set, not {:?}",
                    line_text(&cursor.line)
                ),
            ));
        }
        if let Some(block) = block(&mut cursor, start, store)? {
            callback(block)?;
        }
    }
    Ok(())
}

/// Reads a data set after its first line `-1`; `None` at the end of the file.
fn block(
    cursor: &mut Cursor<impl BufRead>,
    first_line: usize,
    store: &SampleStore,
) -> Result<Option<Block>, Damage> {
    let truncated = |at: usize| {
        Damage::at(
            IssuePlace::Byte(at),
            "the data set does not end with a line -1: is the file truncated?",
        )
    };
    let Some(start) = cursor.next()? else {
        // A stray -1 at the end opens no data set.
        return if first_line == 0 {
            Err(truncated(first_line))
        } else {
            Ok(None)
        };
    };
    let head = line_text(&cursor.line);
    let (number, is_binary) = set_number(&head, start)?;
    let mut block = Block {
        number,
        start,
        lines: Vec::new(),
        data: Data::Lines(store.column(), None),
    };
    let mut row = Vec::new();
    if is_binary {
        binary_part(cursor, &head, &mut block, store)?;
    }
    loop {
        let Some(at) = cursor.next()? else {
            return Err(truncated(start));
        };
        if cursor.trimmed() == b"-1" {
            return Ok(Some(block));
        }
        match &mut block.data {
            Data::Binary(_) if cursor.trimmed().is_empty() => {}
            Data::Binary(_) if !cursor.line.ends_with(b"\n") => return Err(truncated(start)),
            Data::Binary(_) => {
                return Err(Damage::at(
                    IssuePlace::Byte(at),
                    "more bytes follow the binary data than its header specifies",
                ));
            }
            Data::Lines(result, error) if number == 58 && block.lines.len() == LINES => {
                if error.is_none() {
                    row.clear();
                    *error = numbers(&line_text(&cursor.line), &mut row).err();
                    row.iter().try_for_each(|x| result.push(*x))?;
                }
            }
            Data::Lines(..) => block.lines.push(line_text(&cursor.line)),
        }
    }
}

/// Number of a data set in its first line, and whether its data are binary.
fn set_number(head: &str, start: usize) -> Result<(u32, bool), Damage> {
    let word = head.split_whitespace().next().unwrap_or_default();
    let number = word.trim_end_matches(['b', 'B']).parse().map_err(|_| {
        Damage::at(
            IssuePlace::Byte(start),
            format!("expected the number of a data set, not {:?}", head.trim()),
        )
    })?;
    Ok((number, word.ends_with(['b', 'B'])))
}

/// Reads the header lines and the bytes of 58b, whose first line gives their numbers.
fn binary_part(
    cursor: &mut Cursor<impl BufRead>,
    head: &str,
    block: &mut Block,
    store: &SampleStore,
) -> Result<(), Damage> {
    let start = block.start;
    let damage = |why: String| Damage::at(IssuePlace::Byte(start), why);
    let fields: Vec<usize> = head
        .split_whitespace()
        .skip(1)
        .map_while(|field| field.parse().ok())
        .collect();
    let [order, format, lines, length, ..] = fields[..] else {
        return Err(damage(format!(
            "expected byte order, number format, header lines and length after 58b, not {:?}",
            head.trim()
        )));
    };
    if format != 2 || !matches!(order, 1 | 2) {
        return Err(damage(format!(
            "byte order {order} and number format {format}: only IEEE 754 (2) in order 1 or 2 can be read"
        )));
    }
    for _ in 0..lines {
        cursor.next()?.ok_or_else(|| {
            damage(format!(
                "its {lines} header lines are incomplete: is the file truncated?"
            ))
        })?;
        block.lines.push(line_text(&cursor.line));
    }
    let result = binary::numbers(
        &mut cursor.source,
        &Header::read(block)?,
        length,
        order == 1,
        store,
    )
    .map_err(damage)?;
    cursor.at += length;
    block.data = Data::Binary(result);
    Ok(())
}

/// Decodes a line; if it is not UTF-8, bytes outside ASCII are read as Latin-1.
fn line_text(line: &[u8]) -> String {
    let latin = || line.iter().map(|b| char::from(*b)).collect();
    std::str::from_utf8(line)
        .map_or_else(|_| latin(), str::to_owned)
        .trim_end()
        .to_owned()
}

struct Cursor<S> {
    source: S,
    /// Bytes read.
    at: usize,
    /// The last line.
    line: Vec<u8>,
}

impl<S: BufRead> Cursor<S> {
    /// Reads the next line and returns its offset; `None` at the end.
    fn next(&mut self) -> Result<Option<usize>, Damage> {
        let start = self.at;
        self.line.clear();
        let io_error =
            |fault: std::io::Error| Damage::at(IssuePlace::Byte(start), store::reason(&fault));
        let length = self
            .source
            .by_ref()
            .take(MAX_LINE_BYTES)
            .read_until(b'\n', &mut self.line)
            .map_err(io_error)?;
        if length as u64 == MAX_LINE_BYTES {
            return Err(Damage::at(
                IssuePlace::Byte(start),
                "the line at this position is longer than 1 MiB; expected lines of 80 characters",
            ));
        }
        self.at += length;
        Ok((self.at > start).then_some(start))
    }

    fn trimmed(&self) -> &[u8] {
        self.line.trim_ascii()
    }
}
