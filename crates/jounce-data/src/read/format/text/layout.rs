//! Layout of a text: delimiter, first row of numbers, headings and settings.

use super::delimiter::Delimiter;
use super::heads::{ColumnHead, heads, numbered};
use super::number::TextField;
use super::number_rows::{ROWS, most_columns};
use super::preamble::Preamble;
use crate::recording::Issue;

/// Layout of a text.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TextLayout {
    pub delimiter: Delimiter,
    pub decimal_comma: bool,
    /// Byte that ends a line.
    pub line_end: u8,
    /// Lines before the first row of numbers.
    pub skip: usize,
    /// Minimum number of fields of a complete row.
    pub min_fields: usize,
    /// Name and unit of each column.
    pub heads: Vec<ColumnHead>,
    /// Instrument settings above the rows, or next to them.
    pub preamble: Preamble,
    /// Issues about ambiguous headings.
    pub issues: Vec<Issue>,
}

impl TextLayout {
    /// Finds the layout: the delimiter that gives the most columns of numbers, at the first
    /// position with consecutive such lines. Returns `None` if there is no such position.
    pub(super) fn find(lines: &[&str], line_end: u8) -> Option<Self> {
        let (mut skip, count, delimiter, decimal_comma) =
            ROWS.iter().find_map(|rows| most_columns(lines, *rows))?;
        let read = |line: &&str| -> Vec<TextField> {
            delimiter
                .fields(line)
                .iter()
                .map(|field| TextField::read(field, decimal_comma))
                .collect()
        };
        let blank = blank_columns(lines[skip..].iter().map(read), count);
        skip -= data_rows_at_end(lines[..skip].iter().rev().map(read), &blank);
        let used = blank
            .iter()
            .rposition(|blank| !blank)
            .map_or(count, |last| last + 1);
        let first_numeric = blank.iter().position(|blank| !blank).unwrap_or(0);
        let (mut columns, mut issues) = heads(&lines[..skip], used, count, delimiter);
        if let Some(numbered_heads) = lines.get(skip).and_then(|first| {
            numbered(
                first,
                &lines[skip + 1..lines.len().min(skip + 1 + ROWS[0])],
                delimiter,
            )
        }) {
            (columns, issues, skip) = (numbered_heads, Vec::new(), skip + 1);
        }
        for (k, (head, blank)) in columns.iter_mut().zip(&blank).enumerate() {
            (head.blank, head.is_preceding) = (*blank, k < first_numeric);
        }
        let preamble = Preamble::read(&preamble_fields(
            lines,
            skip,
            first_numeric,
            delimiter,
            decimal_comma,
        ));
        issues.extend(preamble.issues.iter().cloned());
        Some(Self {
            delimiter,
            decimal_comma,
            line_end,
            skip,
            min_fields: count,
            heads: columns,
            preamble,
            issues,
        })
    }
}

/// True for each column that is empty in the first rows.
fn blank_columns(rows: impl Iterator<Item = Vec<TextField>>, count: usize) -> Vec<bool> {
    let first: Vec<Vec<TextField>> = rows
        .filter(|row| row.len() == count)
        .take(ROWS[0])
        .collect();
    (0..count)
        .map(|k| first.iter().all(|row| !row[k].is_value()))
        .collect()
}

/// Number of rows above the first numbers, from the last, with text only in blank columns. They
/// belong to the data: some oscilloscopes write settings there.
fn data_rows_at_end(above: impl Iterator<Item = Vec<TextField>>, blank: &[bool]) -> usize {
    let is_data_row = |row: &Vec<TextField>| {
        row.len() == blank.len()
            && row
                .iter()
                .zip(blank)
                .all(|(field, blank)| *blank || field.is_value())
    };
    above.take_while(is_data_row).count()
}

/// Number of rows that may have settings next to them.
const SETTINGS_ROWS: usize = 64;

/// Fields of the lines above the rows, and of the columns before `first_numeric` in the first rows.
fn preamble_fields(
    lines: &[&str],
    skip: usize,
    first_numeric: usize,
    delimiter: Delimiter,
    decimal_comma: bool,
) -> Vec<Vec<String>> {
    // A single column shows no delimiter; use the most frequent one of the lines above.
    let occurrences = |byte: &u8| {
        lines[..skip]
            .iter()
            .map(|line| line.bytes().filter(|b| b == byte).count())
            .sum::<usize>()
    };
    let has_one_column = delimiter != Delimiter::Blanks
        && lines
            .get(skip)
            .is_some_and(|row| delimiter.fields(row).len() == 1);
    let preamble_delimiter = [b',', b';', b'\t']
        .into_iter()
        .max_by_key(occurrences)
        .filter(|byte| has_one_column && occurrences(byte) > 0)
        .map_or(delimiter, Delimiter::Byte);
    let fields = |line: &&str| match preamble_delimiter {
        Delimiter::Blanks if line.contains([':', '=']) => vec![(*line).to_owned()],
        _ => preamble_delimiter.fields(line),
    };
    let leading_text = |line: &&str| {
        delimiter
            .fields(line)
            .into_iter()
            .take(first_numeric)
            .collect::<Vec<String>>()
    };
    let has_text = |fields: &Vec<String>| fields.iter().any(|field| !field.trim().is_empty());
    let with_decimal_point = |fields: Vec<String>| {
        if decimal_comma {
            fields.iter().map(|field| field.replace(',', ".")).collect()
        } else {
            fields
        }
    };
    let preamble_lines = lines[..skip].iter().map(fields);
    preamble_lines
        .chain(
            lines[skip..]
                .iter()
                .take(SETTINGS_ROWS)
                .map(leading_text)
                .filter(has_text),
        )
        .map(with_decimal_point)
        .collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    fn found(text: &str) -> (Delimiter, bool, usize, Vec<String>) {
        let lines: Vec<&str> = text.lines().collect();
        let layout = TextLayout::find(&lines, b'\n').unwrap();
        let heads = layout
            .heads
            .iter()
            .filter(|head| !head.blank || !head.has_no_name);
        let heads = heads.map(|head| {
            if head.unit.is_empty() {
                head.name.clone()
            } else {
                format!("{}|{}", head.name, head.unit)
            }
        });
        (
            layout.delimiter,
            layout.decimal_comma,
            layout.skip,
            heads.collect(),
        )
    }

    /// Text, delimiter, decimal comma, lines above the numbers, and headings.
    const CASES: [(&str, Delimiter, bool, usize, &[&str]); 15] = [
        (
            "time_s,a_g\n0,1\n1,2\n2,3\n",
            Delimiter::Byte(b','),
            false,
            1,
            &["time_s|s", "a_g|g"],
        ),
        (
            "# made 2020\n# t [s]; F [lbf]\n0,0;1,5\n0,1;1,6\n0,2;1,7\n",
            Delimiter::Byte(b';'),
            true,
            2,
            &["t|s", "F|lbf"],
        ),
        (
            "Test 5\nn 3\n\n t   a\n s   m/s2\n 0  1\n 1  2\n 2  3\n",
            Delimiter::Blanks,
            false,
            5,
            &["t|s", "a|m/s2"],
        ),
        (
            "0\t1\n1\t\n2\t3\n",
            Delimiter::Byte(b'\t'),
            false,
            0,
            &["column 1", "column 2"],
        ),
        (
            "a,a\n1,2\n",
            Delimiter::Byte(b','),
            false,
            1,
            &["a 1", "a 2"],
        ),
        (
            "t,a,b\n0,1,2\n1,2\n2,3,4\n3,4,5\n",
            Delimiter::Byte(b','),
            false,
            1,
            &["t", "a", "b"],
        ),
        (
            "t,a\n0,1\n1\n2,3\n3,4\n4,5\n",
            Delimiter::Byte(b','),
            false,
            1,
            &["t", "a"],
        ),
        (
            "5\nt a\n0 1\n1 2\n2 3\n",
            Delimiter::Blanks,
            false,
            2,
            &["t", "a"],
        ),
        (
            "\"x, y\",b\n1,2\n3,4\n5,6\n",
            Delimiter::Byte(b','),
            false,
            1,
            &["x, y", "b"],
        ),
        (
            "X,CH1,Start,Increment,\nSequence,Volt,-1e-3,1e-4,\n0,1,\n1,2,\n2,3,\n",
            Delimiter::Byte(b','),
            false,
            2,
            &["X", "CH1|Volt"],
        ),
        (
            "Time(s),CH1V,t0 =-1e-3, tInc = 1e-4,\n-1e-3,1,,\n0,2,,\n1e-3,3,,\n",
            Delimiter::Byte(b','),
            false,
            1,
            &["Time|s", "CH1|V"],
        ),
        (
            "Rate,5,,0,1,\nMode,x,,1,2,\n,,,2,3,\n,,,3,4,\n,,,4,5,\n",
            Delimiter::Byte(b','),
            false,
            0,
            &["column 4", "column 5"],
        ),
        (
            ",0,1\n0,1.5,2.5\n1,2.5,0.5\n2,3.5,1.5\n",
            Delimiter::Byte(b','),
            false,
            1,
            &["column 1", "0", "1"],
        ),
        (
            "1,2\n0.5,1.5\n0.25,2.5\n",
            Delimiter::Byte(b','),
            false,
            1,
            &["1", "2"],
        ),
        (
            "1,2\n2,3\n3,4\n",
            Delimiter::Byte(b','),
            false,
            0,
            &["column 1", "column 2"],
        ),
    ];

    #[test]
    fn layouts_of_many_kinds_are_found() {
        for (text, delimiter, comma, skip, heads) in CASES {
            assert_eq!(
                found(text),
                (
                    delimiter,
                    comma,
                    skip,
                    heads.iter().map(|head| (*head).to_owned()).collect()
                ),
                "{text}"
            );
        }
        assert_eq!(
            TextLayout::find(&["no numbers here", "at all"], b'\n'),
            None
        );
    }
}
