//! The rows of a text to columns.

use std::io::{self, BufRead, Read as _};

use super::super::error::Damage;
use super::super::moment::{Clock, Moment};
use super::super::number::Field;
use super::super::numbers::Numbers;
use super::super::raw::Column;
use super::super::shelf::Shelf;
use super::{Delimiter, Head, Layout};
use crate::recording::{Finding, FindingKind, Place, Series};

/// Columns and what was noticed on the way.
pub(in crate::read) struct Rows {
    pub columns: Vec<Column>,
    pub findings: Vec<Finding>,
}

/// Counts what happens to lines: how often, and where first.
#[derive(Default)]
struct Tally(Option<(usize, usize)>);

impl Tally {
    fn add(&mut self, line: usize) {
        let (count, first) = self.0.unwrap_or((0, line));
        self.0 = Some((count + 1, first));
    }

    fn finding(self, kind: FindingKind, about: &str) -> Option<Finding> {
        self.0.map(|(count, first)| Finding::new(kind, count, Some(Place::Line(first)), about.to_owned()))
    }
}

/// Ends each header of an LVM file.
const HEADER_ENDS: &str = "***End_of_Header***";
/// A line this long is no row of samples, bytes.
const LONGEST: u64 = 16 << 20;
/// Rows after which the number of all is told from the size of the file, so that columns need not grow by doubling.
const TOLD: usize = 4096;
/// Share by which that number is taken larger.
const SPARE: f64 = 1.02;

/// Reads the rows below the header of a text of `size` bytes line by line.
pub(in crate::read) fn columns(mut source: impl BufRead, size: u64, layout: &Layout, shelf: &Shelf) -> Result<Rows, Damage> {
    let mut rows = Table::below(layout, shelf);
    let (mut bytes, mut read, mut number) = (Vec::new(), 0, 0);
    loop {
        bytes.clear();
        let here = |why: String| Damage::at(Place::Line(number + 1), why);
        let length = source.by_ref().take(LONGEST).read_until(layout.line_end, &mut bytes).map_err(|fault| here(fault.to_string()))?;
        if length == 0 {
            return rows.finished(layout);
        }
        if length as u64 == LONGEST {
            return Err(here("it is longer than 16 MiB; a channel is a column, and each line holds one sample of each".to_owned()));
        }
        number += 1;
        read += length as u64;
        rows.expect(read, size);
        let mark: &[u8] = if number == 1 { b"\xef\xbb\xbf" } else { b"" };
        let decoded = String::from_utf8_lossy(bytes.strip_prefix(mark).unwrap_or(&bytes));
        let line = decoded.trim_end_matches(['\r', '\n']);
        if number > layout.skip && line.trim_start().starts_with(HEADER_ENDS) {
            let why = "the header of another segment ends here; segments need not have the same channels and times: write each to a file of its own";
            return Err(Damage::at(Place::Line(number), why));
        }
        if number > layout.skip && !line.trim().is_empty() {
            rows.line(number, fields(line, layout), bytes.ends_with(&[layout.line_end]))?;
        }
    }
}

/// A column that grows, and what its fields were.
struct Growing {
    numbers: Numbers,
    /// Imaginary parts of a column that had a complex number.
    imaginary: Option<Numbers>,
    /// The moments of a column that holds some, and the first of them.
    clock: Option<(Clock, Moment)>,
    /// How many numbers it holds.
    filled: usize,
    /// True once a moment differs from the first one.
    moves: bool,
}

/// Columns that grow row by row, and what was noticed so far.
struct Table<'a> {
    shelf: &'a Shelf,
    heads: &'a [Head],
    least: usize,
    columns: Vec<Growing>,
    /// Rows without any number whose place is not known yet to be at the end, and the first of them.
    empty: (usize, usize),
    ragged: Tally,
    text: Tally,
    cut: Tally,
    open: Tally,
}

impl<'a> Table<'a> {
    fn below(layout: &'a Layout, shelf: &'a Shelf) -> Self {
        let column = |_: &Head| Growing { numbers: shelf.column(), imaginary: None, clock: None, filled: 0, moves: false };
        let columns = layout.heads.iter().map(column).collect();
        let [ragged, text, cut, open] = [(); 4].map(|()| Tally::default());
        Self { shelf, heads: &layout.heads, least: layout.least, columns, empty: (0, 0), ragged, text, cut, open }
    }

    /// Takes room for all rows of a text of `size` bytes, once enough of them were `read` to tell how many there are.
    fn expect(&mut self, read: u64, size: u64) {
        if self.columns.first().is_some_and(|first| first.numbers.count() == TOLD) {
            let rows = SPARE * TOLD as f64 * size.saturating_sub(read) as f64 / read as f64;
            for column in self.columns.iter_mut().filter(|column| column.numbers.count() == TOLD) {
                column.numbers.expect(rows as usize);
            }
        }
    }

    /// Takes a line; only the last one of a text may not be `ended`.
    fn line(&mut self, number: usize, mut fields: Vec<Field>, ended: bool) -> io::Result<()> {
        let width = self.columns.len();
        for (field, head) in fields.iter_mut().zip(self.heads) {
            if head.beside || head.blank && *field == Field::Text {
                *field = Field::Missing;
            }
        }
        let has_text = fields.contains(&Field::Text);
        if has_text && fields.iter().all(|field| matches!(field, Field::Text | Field::Missing)) {
            self.text.add(number);
            return Ok(());
        }
        if !has_text && fields.iter().all(|field| *field == Field::Missing) {
            self.empty = (self.empty.0 + 1, if self.empty.0 == 0 { number } else { self.empty.1 });
            return Ok(());
        }
        // What is left of a number is a number, and a wrong one: half a stamp would lie before all others.
        if !ended && (fields.len() < self.least || fields.last() == Some(&Field::Text)) {
            self.cut.add(number);
            return Ok(());
        }
        if !ended && fields.last().is_some_and(|field| field.is_value()) {
            self.open.add(number);
        }
        // A delimiter at the end of a line is harmless.
        let trailing = fields.len() == width + 1 && fields[width] == Field::Missing;
        if !(self.least..=width).contains(&fields.len()) && !trailing {
            self.ragged.add(number);
        } else if has_text {
            self.text.add(number);
        }
        for _ in 0..std::mem::take(&mut self.empty).0 {
            self.row(&[])?;
        }
        self.row(&fields)
    }

    /// Puts each field below the others of its column.
    fn row(&mut self, fields: &[Field]) -> io::Result<()> {
        let shelf = self.shelf;
        self.columns.iter_mut().enumerate().try_for_each(|(k, column)| column.push(fields.get(k), shelf))
    }

    fn finished(self, layout: &Layout) -> Result<Rows, Damage> {
        let rows = self.columns.first().map_or(0, |column| column.numbers.count());
        if let Some((count, first)) = self.ragged.0.filter(|(count, _)| 2 * count > rows) {
            let width = self.columns.len();
            let why = format!(
                "it and {} more of {rows} lines have another number of fields than the first row, which has {width}: this is no table with a \
                 column for each channel; where the samples of one channel follow each other along the lines, write one to a line, and beside \
                 the file, in its name with .channels.toml behind it, their rate = \"... Hz\" and under [channel.1] their unit = \"...\"",
                count - 1
            );
            return Err(Damage::at(Place::Line(first), why));
        }
        if rows == 0 {
            let why = "no row of numbers follows it; was the file cut, or does it hold something else than a table of samples?";
            return Err(Damage::at(Place::Line(layout.skip), why));
        }
        let ragged = "lines with another number of fields than the first row: what is missing is no number";
        let text = "lines with text among the numbers: the text was left out";
        let cut = "the file ends inside a row (was it cut?); that row was left out";
        let open = "the last line has no end: its last number is taken as whole, and may be cut";
        let empty = Tally((self.empty.0 > 0).then_some(self.empty));
        let mut findings: Vec<Finding> = [
            self.ragged.finding(FindingKind::Ragged, ragged),
            self.text.finding(FindingKind::Skipped, text),
            self.cut.finding(FindingKind::Skipped, cut),
            self.open.finding(FindingKind::Assumed, open),
            empty.finding(FindingKind::Skipped, "rows without a number at the end were left out"),
        ]
        .into_iter()
        .flatten()
        .collect();
        let columns = layout.heads.iter().zip(self.columns).map(|(head, column)| column.finished(head, &mut findings)).collect();
        Ok(Rows { columns, findings })
    }
}

impl Growing {
    /// Puts a field below the others of the column.
    fn push(&mut self, field: Option<&Field>, shelf: &Shelf) -> io::Result<()> {
        let (re, im) = match (field, &mut self.clock) {
            (Some(Field::Real(value)), None) => (*value, 0.0),
            (Some(Field::Complex(re, im)), None) => (*re, *im),
            (Some(Field::Moment(moment)), Some((clock, first))) => {
                self.moves |= moment != first;
                (clock.seconds(*moment), 0.0)
            }
            (Some(Field::Moment(moment)), None) if self.filled == 0 => {
                self.clock = Some((Clock::from(*moment), *moment));
                (0.0, 0.0)
            }
            _ => (f64::NAN, f64::NAN),
        };
        self.filled += usize::from(!re.is_nan());
        if matches!(field, Some(Field::Complex(..))) && self.imaginary.is_none() {
            let mut zeros = shelf.column();
            (0..self.numbers.count()).try_for_each(|_| zeros.push(0.0))?;
            self.imaginary = Some(zeros);
        }
        self.numbers.push(re)?;
        self.imaginary.as_mut().map_or(Ok(()), |imaginary| imaginary.push(im))
    }

    /// The column under its head. One that stays blank is no channel; neither is a date that stands in every row.
    fn finished(self, head: &Head, findings: &mut Vec<Finding>) -> Column {
        let mut column = Column { imaginary: self.imaginary, ..Column::new(&head.name, &head.unit, self.numbers) };
        if let Some((_, first)) = self.clock {
            "s".clone_into(&mut column.unit);
            if self.moves {
                let about = format!("dates and times of day became seconds since the first, {first}");
                findings.push(Finding::new(FindingKind::Converted, self.filled, None, about).of(&head.name));
            } else {
                column.left_out = Some(format!("{first} stands in all rows"));
            }
        } else if self.filled == 0 && head.blank {
            column.left_out = Some(if head.unnamed { String::new() } else { "no row holds a number of it".to_owned() });
        }
        column
    }
}

fn fields(line: &str, layout: &Layout) -> Vec<Field> {
    let read = |field: &str| Field::read(field, layout.decimal_comma);
    match layout.delimiter {
        Delimiter::Blanks => line.split_whitespace().map(read).collect(),
        Delimiter::Byte(delimiter) if !line.contains('"') => line.split(char::from(delimiter)).map(read).collect(),
        Delimiter::Byte(_) => layout.delimiter.fields(line).iter().map(|field| read(field)).collect(),
    }
}
