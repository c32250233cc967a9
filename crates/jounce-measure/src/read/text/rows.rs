//! The rows of a text to columns.

use std::io::{BufRead, Read as _};

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

/// A line this long is no row of samples, bytes.
const LONGEST: u64 = 16 << 20;
/// Rows after which the number of all is told from the size of the file, so that columns need not grow by doubling.
const TOLD: usize = 4096;
/// Share by which that number is taken larger.
const SPARE: f64 = 1.02;

/// Reads the rows below the header of a text of `size` bytes line by line.
pub(in crate::read) fn columns(mut source: impl BufRead, size: u64, layout: &Layout, shelf: &Shelf) -> Result<Rows, Damage> {
    let width = layout.heads.len();
    let mut columns: Vec<Numbers> = (0..width).map(|_| shelf.column()).collect();
    let mut imaginary: Vec<Option<Numbers>> = (0..width).map(|_| None).collect();
    let (mut ragged, mut text, mut number) = (Tally::default(), Tally::default(), 0);
    let (mut bytes, mut read) = (Vec::new(), 0);
    loop {
        bytes.clear();
        let here = |why: String| Damage::at(Place::Line(number + 1), why);
        let length = source.by_ref().take(LONGEST).read_until(b'\n', &mut bytes).map_err(|fault| here(fault.to_string()))?;
        if length == 0 {
            break;
        }
        if length as u64 == LONGEST {
            return Err(here("it is longer than 16 MiB; a channel is a column, and each line holds one sample of each".to_owned()));
        }
        number += 1;
        read += length as u64;
        if columns.first().is_some_and(|first| first.count() == TOLD) {
            let rows = SPARE * TOLD as f64 * size.saturating_sub(read) as f64 / read as f64;
            for column in columns.iter_mut().filter(|column| column.count() == TOLD) {
                column.expect(rows as usize);
            }
        }
        let line = String::from_utf8_lossy(bytes.trim_ascii_end());
        if number <= layout.skip || line.trim().is_empty() {
            continue;
        }
        let fields = fields(&line, layout);
        let has_text = fields.contains(&Field::Text);
        if has_text && fields.iter().all(|field| matches!(field, Field::Text | Field::Missing)) {
            text.add(number);
            continue;
        }
        // A delimiter at the end of a line is harmless.
        let trailing = fields.len() == width + 1 && fields[width] == Field::Missing;
        if fields.len() != width && !trailing {
            ragged.add(number);
        } else if has_text {
            text.add(number);
        }
        for k in 0..width {
            let (re, im) = match fields.get(k) {
                Some(Field::Real(value)) => (*value, 0.0),
                Some(Field::Complex(re, im)) => (*re, *im),
                _ => (f64::NAN, f64::NAN),
            };
            if matches!(fields.get(k), Some(Field::Complex(..))) && imaginary[k].is_none() {
                let mut zeros = shelf.column();
                (0..columns[k].count()).try_for_each(|_| zeros.push(0.0))?;
                imaginary[k] = Some(zeros);
            }
            columns[k].push(re)?;
            if let Some(imaginary) = &mut imaginary[k] {
                imaginary.push(im)?;
            }
        }
    }
    let ragged =
        ragged.finding(FindingKind::Ragged, "lines with another number of fields than the first row: what is missing is no number");
    let text = text.finding(FindingKind::Skipped, "lines with text among the numbers: the text was left out");
    let column = |((head, values), imaginary): ((&(String, String), _), _)| Column { imaginary, ..Column::new(&head.0, &head.1, values) };
    let columns = layout.heads.iter().zip(columns).zip(imaginary).map(column).collect();
    Ok(Rows { columns, findings: ragged.into_iter().chain(text).collect() })
}

fn fields(line: &str, layout: &Layout) -> Vec<Field> {
    let read = |field: &str| Field::read(field, layout.decimal_comma);
    match layout.delimiter {
        Delimiter::Blanks => line.split_whitespace().map(read).collect(),
        Delimiter::Byte(delimiter) if !line.contains('"') => line.split(char::from(delimiter)).map(read).collect(),
        Delimiter::Byte(_) => layout.delimiter.fields(line).iter().map(|field| read(field)).collect(),
    }
}
