//! The rows of a text to columns.

use std::io::{self, BufRead, Read as _};

use super::super::error::Damage;
use super::super::moment::{Clock, Moment};
use super::super::number::TextField;
use super::super::numbers::ColumnNumbers;
use super::super::raw::RawColumn;
use super::super::samples::SampleStore;
use super::{ColumnHead, Delimiter, TextLayout};
use crate::recording::{Issue, IssueKind, IssuePlace, Series};

/// Columns and what was noticed on the way.
pub(in crate::read) struct Rows {
    pub columns: Vec<RawColumn>,
    pub findings: Vec<Issue>,
}

/// Counts what happens to lines: how often, and where first.
#[derive(Default)]
struct LineTally(Option<(usize, usize)>);

impl LineTally {
    fn add(&mut self, line: usize) {
        let (count, first) = self.0.unwrap_or((0, line));
        self.0 = Some((count + 1, first));
    }

    fn finding(self, kind: IssueKind, about: &str) -> Option<Issue> {
        self.0.map(|(count, first)| {
            Issue::new(kind, count, Some(IssuePlace::Line(first)), about.to_owned())
        })
    }
}

/// Ends each header of an LVM file.
const HEADER_ENDS: &str = "***End_of_Header***";
/// A line this long is no row of samples, bytes.
const MAX_LINE_BYTES: u64 = 16 << 20;
/// Rows after which the number of all is told from the size of the file, so that columns need not grow by doubling.
const ESTIMATE_ROWS: usize = 4096;
/// Share by which that number is taken larger.
const ESTIMATE_MARGIN: f64 = 1.02;

/// Reads the rows below the header of a text of `size` bytes line by line.
pub(in crate::read) fn columns(
    mut source: impl BufRead,
    size: u64,
    layout: &TextLayout,
    store: &SampleStore,
) -> Result<Rows, Damage> {
    let mut rows = RowTable::below(layout, store);
    let (mut bytes, mut read, mut number) = (Vec::new(), 0, 0);
    loop {
        bytes.clear();
        let here = |why: String| Damage::at(IssuePlace::Line(number + 1), why);
        let length = source
            .by_ref()
            .take(MAX_LINE_BYTES)
            .read_until(layout.line_end, &mut bytes)
            .map_err(|fault| here(fault.to_string()))?;
        if length == 0 {
            return rows.finished(layout);
        }
        if length as u64 == MAX_LINE_BYTES {
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
            return Err(Damage::at(IssuePlace::Line(number), why));
        }
        if number > layout.skip && !line.trim().is_empty() {
            rows.line(
                number,
                fields(line, layout),
                bytes.ends_with(&[layout.line_end]),
            )?;
        }
    }
}

/// A column that grows, and what its fields were.
struct GrowingColumn {
    numbers: ColumnNumbers,
    /// Imaginary parts of a column that had a complex number.
    imaginary: Option<ColumnNumbers>,
    /// The moments of a column that holds some, and the first of them.
    clock: Option<(Clock, Moment)>,
    /// How many numbers it holds.
    filled: usize,
    /// True once a moment differs from the first one.
    moves: bool,
}

/// Columns that grow row by row, and what was noticed so far.
struct RowTable<'a> {
    store: &'a SampleStore,
    heads: &'a [ColumnHead],
    least: usize,
    columns: Vec<GrowingColumn>,
    /// Rows without any number whose place is not known yet to be at the end, and the first of them.
    empty: (usize, usize),
    ragged: LineTally,
    text: LineTally,
    cut: LineTally,
    open: LineTally,
}

impl<'a> RowTable<'a> {
    fn below(layout: &'a TextLayout, store: &'a SampleStore) -> Self {
        let column = |_: &ColumnHead| GrowingColumn {
            numbers: store.column(),
            imaginary: None,
            clock: None,
            filled: 0,
            moves: false,
        };
        let columns = layout.heads.iter().map(column).collect();
        let [ragged, text, cut, open] = [(); 4].map(|()| LineTally::default());
        Self {
            store,
            heads: &layout.heads,
            least: layout.least,
            columns,
            empty: (0, 0),
            ragged,
            text,
            cut,
            open,
        }
    }

    /// Takes room for all rows of a text of `size` bytes, once enough of them were `read` to tell how many there are.
    fn expect(&mut self, read: u64, size: u64) {
        if self
            .columns
            .first()
            .is_some_and(|first| first.numbers.count() == ESTIMATE_ROWS)
        {
            let rows = ESTIMATE_MARGIN * ESTIMATE_ROWS as f64 * size.saturating_sub(read) as f64
                / read as f64;
            for column in self
                .columns
                .iter_mut()
                .filter(|column| column.numbers.count() == ESTIMATE_ROWS)
            {
                column.numbers.expect(rows as usize);
            }
        }
    }

    /// Takes a line; only the last one of a text may not be `ended`.
    fn line(&mut self, number: usize, mut fields: Vec<TextField>, ended: bool) -> io::Result<()> {
        let width = self.columns.len();
        for (field, head) in fields.iter_mut().zip(self.heads) {
            if head.beside || head.blank && *field == TextField::Text {
                *field = TextField::Missing;
            }
        }
        let has_text = fields.contains(&TextField::Text);
        if has_text
            && fields
                .iter()
                .all(|field| matches!(field, TextField::Text | TextField::Missing))
        {
            self.text.add(number);
            return Ok(());
        }
        if !has_text && fields.iter().all(|field| *field == TextField::Missing) {
            self.empty = (
                self.empty.0 + 1,
                if self.empty.0 == 0 {
                    number
                } else {
                    self.empty.1
                },
            );
            return Ok(());
        }
        // What is left of a number is a number, and a wrong one: half a stamp would lie before all others.
        if !ended && (fields.len() < self.least || fields.last() == Some(&TextField::Text)) {
            self.cut.add(number);
            return Ok(());
        }
        if !ended && fields.last().is_some_and(|field| field.is_value()) {
            self.open.add(number);
        }
        // A delimiter at the end of a line is harmless.
        let trailing = fields.len() == width + 1 && fields[width] == TextField::Missing;
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
    fn row(&mut self, fields: &[TextField]) -> io::Result<()> {
        let store = self.store;
        self.columns
            .iter_mut()
            .enumerate()
            .try_for_each(|(k, column)| column.push(fields.get(k), store))
    }

    fn finished(self, layout: &TextLayout) -> Result<Rows, Damage> {
        let rows = self
            .columns
            .first()
            .map_or(0, |column| column.numbers.count());
        if let Some((count, first)) = self.ragged.0.filter(|(count, _)| 2 * count > rows) {
            let width = self.columns.len();
            let why = format!(
                "it and {} more of {rows} lines have another number of fields than the first row, which has {width}: this is no table with a \
                 column for each channel; where the samples of one channel follow each other along the lines, write one to a line, and beside \
                 the file, in its name with .channels.toml behind it, their rate = \"... Hz\" and under [channel.1] their unit = \"...\"",
                count - 1
            );
            return Err(Damage::at(IssuePlace::Line(first), why));
        }
        if rows == 0 {
            let why = "no row of numbers follows it; was the file cut, or does it hold something else than a table of samples?";
            return Err(Damage::at(IssuePlace::Line(layout.skip), why));
        }
        let ragged =
            "lines with another number of fields than the first row: what is missing is no number";
        let text = "lines with text among the numbers: the text was left out";
        let cut = "the file ends inside a row (was it cut?); that row was left out";
        let open = "the last line has no end: its last number is taken as whole, and may be cut";
        let empty = LineTally((self.empty.0 > 0).then_some(self.empty));
        let mut findings: Vec<Issue> = [
            self.ragged.finding(IssueKind::Ragged, ragged),
            self.text.finding(IssueKind::Skipped, text),
            self.cut.finding(IssueKind::Skipped, cut),
            self.open.finding(IssueKind::Assumed, open),
            empty.finding(
                IssueKind::Skipped,
                "rows without a number at the end were left out",
            ),
        ]
        .into_iter()
        .flatten()
        .collect();
        let columns = layout
            .heads
            .iter()
            .zip(self.columns)
            .map(|(head, column)| column.finished(head, &mut findings))
            .collect();
        Ok(Rows { columns, findings })
    }
}

impl GrowingColumn {
    /// Puts a field below the others of the column.
    fn push(&mut self, field: Option<&TextField>, store: &SampleStore) -> io::Result<()> {
        let (re, im) = match (field, &mut self.clock) {
            (Some(TextField::Real(value)), None) => (*value, 0.0),
            (Some(TextField::Complex(re, im)), None) => (*re, *im),
            (Some(TextField::Moment(moment)), Some((clock, first))) => {
                self.moves |= moment != first;
                (clock.seconds(*moment), 0.0)
            }
            (Some(TextField::Moment(moment)), None) if self.filled == 0 => {
                self.clock = Some((Clock::from(*moment), *moment));
                (0.0, 0.0)
            }
            _ => (f64::NAN, f64::NAN),
        };
        self.filled += usize::from(!re.is_nan());
        if matches!(field, Some(TextField::Complex(..))) && self.imaginary.is_none() {
            let mut zeros = store.column();
            (0..self.numbers.count()).try_for_each(|_| zeros.push(0.0))?;
            self.imaginary = Some(zeros);
        }
        self.numbers.push(re)?;
        self.imaginary
            .as_mut()
            .map_or(Ok(()), |imaginary| imaginary.push(im))
    }

    /// The column under its head. One that stays blank is no channel; neither is a date that stands in every row.
    fn finished(self, head: &ColumnHead, findings: &mut Vec<Issue>) -> RawColumn {
        let mut column = RawColumn {
            imaginary: self.imaginary,
            ..RawColumn::new(&head.name, &head.unit, self.numbers)
        };
        if let Some((_, first)) = self.clock {
            "s".clone_into(&mut column.unit);
            if self.moves {
                let about =
                    format!("dates and times of day became seconds since the first, {first}");
                findings.push(
                    Issue::new(IssueKind::Converted, self.filled, None, about).of(&head.name),
                );
            } else {
                column.left_out = Some(format!("{first} stands in all rows"));
            }
        } else if self.filled == 0 && head.blank {
            column.left_out = Some(if head.unnamed {
                String::new()
            } else {
                "no row holds a number of it".to_owned()
            });
        }
        column
    }
}

fn fields(line: &str, layout: &TextLayout) -> Vec<TextField> {
    let read = |field: &str| TextField::read(field, layout.decimal_comma);
    match layout.delimiter {
        Delimiter::Blanks => line.split_whitespace().map(read).collect(),
        Delimiter::Byte(delimiter) if !line.contains('"') => {
            line.split(char::from(delimiter)).map(read).collect()
        }
        Delimiter::Byte(_) => layout
            .delimiter
            .fields(line)
            .iter()
            .map(|field| read(field))
            .collect(),
    }
}
