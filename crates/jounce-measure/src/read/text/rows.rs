//! The rows of a text to columns.

use std::io::{self, BufRead, Read as _};

use super::super::error::Damage;
use super::super::number::Field;
use super::super::numbers::Numbers;
use super::super::raw::Column;
use super::super::shelf::Shelf;
use super::{Delimiter, Layout};
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
    let mut rows = Growing::below(layout, shelf);
    let (mut bytes, mut read, mut number) = (Vec::new(), 0, 0);
    loop {
        bytes.clear();
        let here = |why: String| Damage::at(Place::Line(number + 1), why);
        let length = source.by_ref().take(LONGEST).read_until(b'\n', &mut bytes).map_err(|fault| here(fault.to_string()))?;
        if length == 0 {
            return rows.finished(layout);
        }
        if length as u64 == LONGEST {
            return Err(here("it is longer than 16 MiB; a channel is a column, and each line holds one sample of each".to_owned()));
        }
        number += 1;
        read += length as u64;
        rows.expect(read, size);
        let line = String::from_utf8_lossy(bytes.trim_ascii_end());
        if number > layout.skip && line.trim_start().starts_with(HEADER_ENDS) {
            let why = "the header of another segment ends here; segments need not have the same channels and times: write each to a file of its own";
            return Err(Damage::at(Place::Line(number), why));
        }
        if number > layout.skip && !line.trim().is_empty() {
            rows.line(number, &fields(&line, layout), bytes.ends_with(b"\n"))?;
        }
    }
}

/// Columns that grow row by row, and what was noticed so far.
struct Growing<'a> {
    shelf: &'a Shelf,
    columns: Vec<Numbers>,
    /// Imaginary parts of the columns that had a complex number.
    imaginary: Vec<Option<Numbers>>,
    ragged: Tally,
    text: Tally,
    cut: Tally,
    open: Tally,
}

impl<'a> Growing<'a> {
    fn below(layout: &Layout, shelf: &'a Shelf) -> Self {
        let columns: Vec<Numbers> = layout.heads.iter().map(|_| shelf.column()).collect();
        let imaginary = columns.iter().map(|_| None).collect();
        Self { shelf, columns, imaginary, ragged: Tally::default(), text: Tally::default(), cut: Tally::default(), open: Tally::default() }
    }

    /// Takes room for all rows of a text of `size` bytes, once enough of them were `read` to tell how many there are.
    fn expect(&mut self, read: u64, size: u64) {
        if self.columns.first().is_some_and(|first| first.count() == TOLD) {
            let rows = SPARE * TOLD as f64 * size.saturating_sub(read) as f64 / read as f64;
            for column in self.columns.iter_mut().filter(|column| column.count() == TOLD) {
                column.expect(rows as usize);
            }
        }
    }

    /// Takes a line; only the last one of a text may not be `ended`.
    fn line(&mut self, number: usize, fields: &[Field], ended: bool) -> io::Result<()> {
        let width = self.columns.len();
        let has_text = fields.contains(&Field::Text);
        if has_text && fields.iter().all(|field| matches!(field, Field::Text | Field::Missing)) {
            self.text.add(number);
            return Ok(());
        }
        // What is left of a number is a number, and a wrong one: half a stamp would lie before all others.
        if !ended && (fields.len() < width || fields.last() == Some(&Field::Text)) {
            self.cut.add(number);
            return Ok(());
        }
        if !ended && matches!(fields.last(), Some(Field::Real(_) | Field::Complex(..))) {
            self.open.add(number);
        }
        // A delimiter at the end of a line is harmless.
        let trailing = fields.len() == width + 1 && fields[width] == Field::Missing;
        if fields.len() != width && !trailing {
            self.ragged.add(number);
        } else if has_text {
            self.text.add(number);
        }
        (0..width).try_for_each(|k| self.push(k, fields.get(k)))
    }

    /// Puts a field below the others of its column.
    fn push(&mut self, k: usize, field: Option<&Field>) -> io::Result<()> {
        let (re, im) = match field {
            Some(Field::Real(value)) => (*value, 0.0),
            Some(Field::Complex(re, im)) => (*re, *im),
            _ => (f64::NAN, f64::NAN),
        };
        if matches!(field, Some(Field::Complex(..))) && self.imaginary[k].is_none() {
            let mut zeros = self.shelf.column();
            (0..self.columns[k].count()).try_for_each(|_| zeros.push(0.0))?;
            self.imaginary[k] = Some(zeros);
        }
        self.columns[k].push(re)?;
        self.imaginary[k].as_mut().map_or(Ok(()), |imaginary| imaginary.push(im))
    }

    fn finished(self, layout: &Layout) -> Result<Rows, Damage> {
        let rows = self.columns.first().map_or(0, Series::count);
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
        let ragged = "lines with another number of fields than the first row: what is missing is no number";
        let text = "lines with text among the numbers: the text was left out";
        let cut = "the file ends inside a row (was it cut?); that row was left out";
        let open = "the last line has no end: its last number is taken as whole, and may be cut";
        let findings = [
            self.ragged.finding(FindingKind::Ragged, ragged),
            self.text.finding(FindingKind::Skipped, text),
            self.cut.finding(FindingKind::Skipped, cut),
            self.open.finding(FindingKind::Assumed, open),
        ];
        let column =
            |((head, values), imaginary): ((&(String, String), _), _)| Column { imaginary, ..Column::new(&head.0, &head.1, values) };
        let columns = layout.heads.iter().zip(self.columns).zip(self.imaginary).map(column).collect();
        Ok(Rows { columns, findings: findings.into_iter().flatten().collect() })
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
