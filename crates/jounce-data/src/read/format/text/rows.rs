//! Reads the rows of a text into columns.

use std::io::{self, BufRead, Read as _};

use super::growing_column::GrowingColumn;
use super::number::TextField;
use super::{ColumnHead, TextLayout};
use crate::read::column::raw::RawColumn;
use crate::read::column::samples::SampleStore;
use crate::read::error::Damage;
use crate::recording::{Issue, IssueKind, IssuePlace, Series};

/// Columns with the issues found.
pub(in crate::read) struct Rows {
    pub columns: Vec<RawColumn>,
    pub issues: Vec<Issue>,
}

/// Counter of an event in lines, with the first line.
#[derive(Default)]
struct LineTally(Option<(usize, usize)>);

impl LineTally {
    fn add(&mut self, line: usize) {
        let (count, first) = self.0.unwrap_or((0, line));
        self.0 = Some((count + 1, first));
    }

    fn issue(self, kind: IssueKind, message: &str) -> Option<Issue> {
        self.0.map(|(count, first)| {
            Issue::new(
                kind,
                count,
                Some(IssuePlace::Line(first)),
                message.to_owned(),
            )
        })
    }
}

/// Marks the end of each header of an LVM file.
const HEADER_ENDS: &str = "***End_of_Header***";
/// Maximum length of a row of samples, bytes.
const MAX_LINE_BYTES: u64 = 16 << 20;
/// Rows after which the total number is estimated from the file size, so that columns need not grow
/// by doubling.
const ESTIMATE_ROWS: usize = 4096;
/// Safety factor on that estimate.
const ESTIMATE_MARGIN: f64 = 1.02;

/// Reads the rows below the header of a text of `size` bytes line by line.
pub(in crate::read) fn columns(
    mut source: impl BufRead,
    size: u64,
    layout: &TextLayout,
    store: &SampleStore,
) -> Result<Rows, Damage> {
    let mut rows = RowTable::new(layout, store);
    let (mut bytes, mut read, mut number) = (Vec::new(), 0, 0);
    loop {
        bytes.clear();
        let damage_here = |why: String| Damage::at(IssuePlace::Line(number + 1), why);
        let length = source
            .by_ref()
            .take(MAX_LINE_BYTES)
            .read_until(layout.line_end, &mut bytes)
            .map_err(|fault| damage_here(fault.to_string()))?;
        if length == 0 {
            return rows.into_rows(layout);
        }
        if length as u64 == MAX_LINE_BYTES {
            return Err(damage_here(
                "it is longer than 16 MiB; a channel is a column, and each line \
                contains one sample of each"
                    .to_owned(),
            ));
        }
        number += 1;
        read += length as u64;
        rows.expect(read, size);
        let byte_order_mark: &[u8] = if number == 1 { b"\xef\xbb\xbf" } else { b"" };
        let decoded =
            String::from_utf8_lossy(bytes.strip_prefix(byte_order_mark).unwrap_or(&bytes));
        let line = decoded.trim_end_matches(['\r', '\n']);
        if number > layout.skip && line.trim_start().starts_with(HEADER_ENDS) {
            let why = "the header of another segment begins here; segments may differ in channels \
                and times: write each to a separate file";
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

/// Columns that grow row by row, with the issues found so far.
struct RowTable<'a> {
    store: &'a SampleStore,
    heads: &'a [ColumnHead],
    min_fields: usize,
    columns: Vec<GrowingColumn>,
    /// Count of rows without numbers that may be at the end, and the first of them.
    empty: (usize, usize),
    ragged: LineTally,
    text: LineTally,
    truncated: LineTally,
    unterminated: LineTally,
}

impl<'a> RowTable<'a> {
    fn new(layout: &'a TextLayout, store: &'a SampleStore) -> Self {
        let columns = layout.heads.iter().map(|_| GrowingColumn::new(store));
        let [ragged, text, truncated, unterminated] = [(); 4].map(|()| LineTally::default());
        Self {
            store,
            heads: &layout.heads,
            min_fields: layout.min_fields,
            columns: columns.collect(),
            empty: (0, 0),
            ragged,
            text,
            truncated,
            unterminated,
        }
    }

    /// Reserves memory for all rows of a text of `size` bytes, once `read` bytes suffice for an
    /// estimate.
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

    /// Adds a line; only the last line of a text may lack its ending.
    fn line(
        &mut self,
        number: usize,
        mut fields: Vec<TextField>,
        is_terminated: bool,
    ) -> io::Result<()> {
        let width = self.columns.len();
        for (field, head) in fields.iter_mut().zip(self.heads) {
            if head.is_preceding || head.blank && *field == TextField::Text {
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
        // A truncated number is still a number, but a wrong one: half a stamp would be earlier than
        // all others.
        if !is_terminated
            && (fields.len() < self.min_fields || fields.last() == Some(&TextField::Text))
        {
            self.truncated.add(number);
            return Ok(());
        }
        if !is_terminated && fields.last().is_some_and(|field| field.is_value()) {
            self.unterminated.add(number);
        }
        // A delimiter at the end of a line is harmless.
        let trailing = fields.len() == width + 1 && fields[width] == TextField::Missing;
        if !(self.min_fields..=width).contains(&fields.len()) && !trailing {
            self.ragged.add(number);
        } else if has_text {
            self.text.add(number);
        }
        for _ in 0..std::mem::take(&mut self.empty).0 {
            self.row(&[])?;
        }
        self.row(&fields)
    }

    /// Appends each field to its column.
    fn row(&mut self, fields: &[TextField]) -> io::Result<()> {
        let store = self.store;
        self.columns
            .iter_mut()
            .enumerate()
            .try_for_each(|(k, column)| column.push(fields.get(k), store))
    }

    fn into_rows(self, layout: &TextLayout) -> Result<Rows, Damage> {
        let rows = self
            .columns
            .first()
            .map_or(0, |column| column.numbers.count());
        if let Some((count, first)) = self.ragged.0.filter(|(count, _)| 2 * count > rows) {
            let width = self.columns.len();
            let why = format!(
                "it and {} more of {rows} lines differ in number of fields from the first row, \
                which has {width}: this is not a table with a column for each channel; if the \
                samples of one channel follow each other along the lines, write one per line, and \
                in a file named like this one plus .channels.toml specify rate = \"... Hz\" and \
                under [channel.1] unit = \"...\"",
                count - 1
            );
            return Err(Damage::at(IssuePlace::Line(first), why));
        }
        if rows == 0 {
            let why = "no row of numbers follows it; is the file truncated, or does it contain \
                something other than a table of samples?";
            return Err(Damage::at(IssuePlace::Line(layout.skip), why));
        }
        let ragged =
            "lines differ in number of fields from the first row; missing fields are not a number";
        let text = "lines contain text among the numbers; the text was left out";
        let truncated = "the file ends inside a row (is it truncated?); that row was left out";
        let unterminated = "the last line has no end; its last number is read as complete, but may be \
            truncated";
        let empty = LineTally((self.empty.0 > 0).then_some(self.empty));
        let mut issues: Vec<Issue> = [
            self.ragged.issue(IssueKind::Ragged, ragged),
            self.text.issue(IssueKind::Skipped, text),
            self.truncated.issue(IssueKind::Skipped, truncated),
            self.unterminated.issue(IssueKind::Assumed, unterminated),
            empty.issue(
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
            .map(|(head, column)| column.into_column(head, &mut issues))
            .collect();
        Ok(Rows { columns, issues })
    }
}

fn fields(line: &str, layout: &TextLayout) -> Vec<TextField> {
    let mut fields = Vec::new();
    let decimal_comma = layout.decimal_comma;
    (layout.delimiter).each_field(line, |field| {
        fields.push(TextField::read(field, decimal_comma))
    });
    fields
}
