//! A universal file to its data sets: each stands between two lines that hold `-1`.

use super::super::error::Damage;
use crate::recording::Place;

/// One data set.
pub(super) struct Block<'a> {
    /// Its number.
    pub number: u32,
    /// Where its content begins in the file, byte.
    pub start: usize,
    /// Its text lines: header and, where it is not binary, data.
    pub lines: Vec<String>,
    /// The binary data of 58b.
    pub binary: Option<Binary<'a>>,
}

/// Binary data and how to read them.
pub(super) struct Binary<'a> {
    pub little_endian: bool,
    pub bytes: &'a [u8],
}

/// Cuts a file into its data sets.
pub(super) fn blocks(bytes: &[u8]) -> Result<Vec<Block<'_>>, Damage> {
    let mut cursor = Cursor { bytes, at: 0 };
    let mut found = Vec::new();
    while let Some((start, line)) = cursor.line() {
        if line.trim_ascii().is_empty() {
            continue;
        }
        if line.trim_ascii() != b"-1" {
            return Err(Damage::at(Place::Byte(start), format!("a line with -1 is due before a data set, not {:?}", shown(line))));
        }
        found.extend(block(&mut cursor, start)?);
    }
    Ok(found)
}

fn block<'a>(cursor: &mut Cursor<'a>, opening: usize) -> Result<Option<Block<'a>>, Damage> {
    let cut = |at: usize| Damage::at(Place::Byte(at), "the data set does not end with a line -1: was the file cut?");
    let Some((start, head)) = cursor.line() else {
        // A stray -1 at the end opens nothing.
        return if opening == 0 { Err(cut(opening)) } else { Ok(None) };
    };
    let head = shown(head);
    let word = head.split_whitespace().next().unwrap_or_default();
    let binary = word.ends_with(['b', 'B']);
    let number = word.trim_end_matches(['b', 'B']).parse::<u32>();
    let number = number.map_err(|_| Damage::at(Place::Byte(start), format!("the number of a data set is due, not {:?}", head.trim())))?;
    let mut block = Block { number, start, lines: Vec::new(), binary: None };
    if binary {
        binary_part(cursor, &head, &mut block)?;
    }
    loop {
        let Some((_, line)) = cursor.line() else { return Err(cut(start)) };
        if line.trim_ascii() == b"-1" {
            return Ok(Some(block));
        }
        if block.binary.is_none() {
            block.lines.push(shown(line));
        } else if !line.trim_ascii().is_empty() {
            return Err(Damage::at(Place::Byte(cursor.at), "more follows the binary data than its header says"));
        }
    }
}

/// The header lines and the bytes of 58b, whose first line tells their numbers.
fn binary_part<'a>(cursor: &mut Cursor<'a>, head: &str, block: &mut Block<'a>) -> Result<(), Damage> {
    let wrong = |why: String| Damage::at(Place::Byte(block.start), why);
    let fields: Vec<usize> = head.split_whitespace().skip(1).map_while(|field| field.parse().ok()).collect();
    let [order, format, lines, length, ..] = fields[..] else {
        return Err(wrong(format!("byte order, number format, header lines and length are due behind 58b, not {:?}", head.trim())));
    };
    if format != 2 || !matches!(order, 1 | 2) {
        return Err(wrong(format!("byte order {order} and number format {format}: only IEEE 754 (2) in order 1 or 2 can be read")));
    }
    for _ in 0..lines {
        let (_, line) = cursor.line().ok_or_else(|| wrong(format!("its {lines} header lines are not whole: was the file cut?")))?;
        block.lines.push(shown(line));
    }
    let rest = cursor.bytes.len() - cursor.at;
    let bytes = cursor.bytes.get(cursor.at..cursor.at.saturating_add(length));
    let bytes = bytes.ok_or_else(|| wrong(format!("{length} bytes of data are due, {rest} follow: was the file cut?")))?;
    cursor.at += length;
    block.binary = Some(Binary { little_endian: order == 1, bytes });
    Ok(())
}

/// Text of a line; a byte outside ASCII becomes its Latin-1 character.
fn shown(line: &[u8]) -> String {
    line.iter().map(|b| char::from(*b)).collect::<String>().trim_end().to_owned()
}

struct Cursor<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Cursor<'a> {
    /// The next line with the place where it begins.
    fn line(&mut self) -> Option<(usize, &'a [u8])> {
        let (start, rest) = (self.at, self.bytes.get(self.at..)?);
        if rest.is_empty() {
            return None;
        }
        let length = rest.iter().position(|b| *b == b'\n');
        self.at += length.map_or(rest.len(), |length| length + 1);
        Some((start, &rest[..length.unwrap_or(rest.len())]))
    }
}
