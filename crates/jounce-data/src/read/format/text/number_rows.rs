//! Finds the first rows of numbers in a text, and their delimiter.

use super::delimiter::Delimiter;
use super::number::TextField;

/// Consecutive lines with equally many numbers that mark the beginning of the data; two if there
/// are no three.
pub(super) const ROWS: [usize; 2] = [3, 2];

const DELIMITERS: [Delimiter; 4] = [
    Delimiter::Byte(b'\t'),
    Delimiter::Byte(b';'),
    Delimiter::Byte(b','),
    Delimiter::Blanks,
];

/// First line, number of columns, delimiter and decimal comma that give the most columns.
pub(super) fn most_columns(lines: &[&str], rows: usize) -> Option<(usize, usize, Delimiter, bool)> {
    let counted_candidates: Vec<_> = candidates()
        .map(|(delimiter, comma)| (delimiter, comma, counts(lines, delimiter, comma)))
        .collect();
    // A text may have fewer rows than required, but then under every way of reading it.
    let max_rows = counted_candidates
        .iter()
        .map(|(.., counts)| counts.iter().filter(|count| **count > 0).count())
        .max()?;
    let mut best: Option<(usize, usize, Delimiter, bool)> = None;
    for (delimiter, decimal_comma, counts) in counted_candidates {
        let Some((skip, count)) = first_rows(&counts, rows.min(max_rows).max(1)) else {
            continue;
        };
        if best.is_none_or(|(_, most, ..)| count > most) {
            best = Some((skip, count, delimiter, decimal_comma));
        }
    }
    best
}

/// True where a line has only numbers.
pub(super) fn has_numbers(lines: &[&str]) -> bool {
    candidates()
        .any(|(delimiter, comma)| (counts(lines, delimiter, comma).iter()).any(|count| *count > 0))
}

/// Delimiters, each without and with a decimal comma.
fn candidates() -> impl Iterator<Item = (Delimiter, bool)> {
    let candidates = DELIMITERS
        .into_iter()
        .flat_map(|delimiter| [(delimiter, false), (delimiter, true)]);
    candidates.filter(|candidate| *candidate != (Delimiter::Byte(b','), true))
}

/// Number of numbers in each line; 0 for a line with other content.
fn counts(lines: &[&str], delimiter: Delimiter, decimal_comma: bool) -> Vec<usize> {
    let numbers = |line: &str| {
        let fields = delimiter.fields(line);
        let read: Vec<TextField> = fields
            .iter()
            .map(|field| TextField::read(field, decimal_comma))
            .collect();
        let number =
            |field: &TextField| matches!(field, TextField::Real(_) | TextField::Complex(..));
        let row = read.iter().all(|field| field.is_sample()) && read.iter().any(number);
        if row { fields.len() } else { 0 }
    };
    lines
        .iter()
        .map(|line| {
            if line.trim().is_empty() {
                0
            } else {
                numbers(line)
            }
        })
        .collect()
}

/// First line and width of the first rows with equally many numbers. Equally wide rows above them
/// belong to them if only numbers are in between.
fn first_rows(counts: &[usize], rows: usize) -> Option<(usize, usize)> {
    let starts_row = |k: &usize| {
        counts[*k] > 0
            && counts[*k..]
                .iter()
                .take(rows)
                .filter(|count| **count == counts[*k])
                .count()
                == rows
    };
    let found = (0..counts.len()).find(starts_row)?;
    let above = (0..found)
        .rev()
        .take_while(|k| counts[*k] > 0)
        .filter(|k| counts[*k] == counts[found])
        .last();
    Some((above.unwrap_or(found), counts[found]))
}
