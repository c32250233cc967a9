//! A universal file to its data sets: each stands between two lines that hold `-1`.

use std::io::{BufRead, Read as _};

use super::super::error::Damage;
use super::super::numbers::ColumnNumbers;
use super::super::samples::SampleStore;
use super::binary;
use super::header::{Header, LINES};
use super::numbers::numbers;
use crate::recording::IssuePlace;

/// A line this long is none of a universal file, bytes.
const MAX_LINE_BYTES: u64 = 1 << 20;

/// One data set.
pub(super) struct Block {
    /// Its number.
    pub number: u32,
    /// Where its content begins in the file, byte.
    pub start: usize,
    /// Its text lines; of data set 58 the header only.
    pub lines: Vec<String>,
    /// What follows the header of data set 58.
    pub data: Data,
}

/// The data of a data set 58.
pub(super) enum Data {
    /// Numbers of text lines; the first word that is none ends them.
    Lines(ColumnNumbers, Option<String>),
    /// Numbers of bytes, as many as the header says.
    Binary(ColumnNumbers),
}

/// Hands every data set of a file to `take`, one after the other, so that the store holds one.
pub(super) fn blocks(
    source: impl BufRead,
    store: &SampleStore,
    mut take: impl FnMut(Block) -> Result<(), Damage>,
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
                    "a line with -1 is due before a data set, not {:?}",
                    shown(&cursor.line)
                ),
            ));
        }
        if let Some(block) = block(&mut cursor, start, store)? {
            take(block)?;
        }
    }
    Ok(())
}

fn block(
    cursor: &mut Cursor<impl BufRead>,
    opening: usize,
    store: &SampleStore,
) -> Result<Option<Block>, Damage> {
    let cut = |at: usize| {
        Damage::at(
            IssuePlace::Byte(at),
            "the data set does not end with a line -1: was the file cut?",
        )
    };
    let Some(start) = cursor.next()? else {
        // A stray -1 at the end opens nothing.
        return if opening == 0 {
            Err(cut(opening))
        } else {
            Ok(None)
        };
    };
    let head = shown(&cursor.line);
    let word = head.split_whitespace().next().unwrap_or_default();
    let binary = word.ends_with(['b', 'B']);
    let number = word.trim_end_matches(['b', 'B']).parse::<u32>();
    let number = number.map_err(|_| {
        Damage::at(
            IssuePlace::Byte(start),
            format!("the number of a data set is due, not {:?}", head.trim()),
        )
    })?;
    let mut block = Block {
        number,
        start,
        lines: Vec::new(),
        data: Data::Lines(store.column(), None),
    };
    let mut row = Vec::new();
    if binary {
        binary_part(cursor, &head, &mut block, store)?;
    }
    loop {
        let Some(at) = cursor.next()? else {
            return Err(cut(start));
        };
        if cursor.trimmed() == b"-1" {
            return Ok(Some(block));
        }
        match &mut block.data {
            Data::Binary(_) if cursor.trimmed().is_empty() => {}
            Data::Binary(_) if !cursor.line.ends_with(b"\n") => return Err(cut(start)),
            Data::Binary(_) => {
                return Err(Damage::at(
                    IssuePlace::Byte(at),
                    "more follows the binary data than its header says",
                ));
            }
            Data::Lines(found, wrong) if number == 58 && block.lines.len() == LINES => {
                if wrong.is_none() {
                    row.clear();
                    *wrong = numbers(&shown(&cursor.line), &mut row).err();
                    row.iter().try_for_each(|x| found.push(*x))?;
                }
            }
            Data::Lines(..) => block.lines.push(shown(&cursor.line)),
        }
    }
}

/// The header lines and the bytes of 58b, whose first line tells their numbers.
fn binary_part(
    cursor: &mut Cursor<impl BufRead>,
    head: &str,
    block: &mut Block,
    store: &SampleStore,
) -> Result<(), Damage> {
    let start = block.start;
    let wrong = |why: String| Damage::at(IssuePlace::Byte(start), why);
    let fields: Vec<usize> = head
        .split_whitespace()
        .skip(1)
        .map_while(|field| field.parse().ok())
        .collect();
    let [order, format, lines, length, ..] = fields[..] else {
        return Err(wrong(format!(
            "byte order, number format, header lines and length are due behind 58b, not {:?}",
            head.trim()
        )));
    };
    if format != 2 || !matches!(order, 1 | 2) {
        return Err(wrong(format!(
            "byte order {order} and number format {format}: only IEEE 754 (2) in order 1 or 2 can be read"
        )));
    }
    for _ in 0..lines {
        cursor.next()?.ok_or_else(|| {
            wrong(format!(
                "its {lines} header lines are not whole: was the file cut?"
            ))
        })?;
        block.lines.push(shown(&cursor.line));
    }
    let found = binary::numbers(
        &mut cursor.source,
        &Header::read(block)?,
        length,
        order == 1,
        store,
    )
    .map_err(wrong)?;
    cursor.at += length;
    block.data = Data::Binary(found);
    Ok(())
}

/// Text of a line; where it is no UTF-8, a byte outside ASCII becomes its Latin-1 character.
fn shown(line: &[u8]) -> String {
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
    /// Reads the next line and gives the place where it begins; none at the end.
    fn next(&mut self) -> Result<Option<usize>, Damage> {
        let start = self.at;
        self.line.clear();
        let told = |fault: std::io::Error| Damage::at(IssuePlace::Byte(start), fault.to_string());
        let length = self
            .source
            .by_ref()
            .take(MAX_LINE_BYTES)
            .read_until(b'\n', &mut self.line)
            .map_err(told)?;
        if length as u64 == MAX_LINE_BYTES {
            return Err(Damage::at(
                IssuePlace::Byte(start),
                "the line that begins here is longer than 1 MiB; lines of 80 characters are due",
            ));
        }
        self.at += length;
        Ok((self.at > start).then_some(start))
    }

    fn trimmed(&self) -> &[u8] {
        self.line.trim_ascii()
    }
}
