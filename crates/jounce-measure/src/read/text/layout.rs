//! Where the numbers of a text begin, and what parts them.

use super::super::error::Damage;
use super::super::name;
use super::super::number::Field;
use crate::recording::Finding;

/// What parts the fields of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Delimiter {
    /// One character.
    Byte(u8),
    /// Any number of blanks.
    Blanks,
}

/// The layout of a text.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Layout {
    pub delimiter: Delimiter,
    pub decimal_comma: bool,
    /// Lines before the first row of numbers.
    pub skip: usize,
    /// Name and unit of each column.
    pub heads: Vec<(String, String)>,
    /// How heads were read that can be read in two ways.
    pub doubts: Vec<Finding>,
}

/// So many lines in a row with the same number of numbers are the beginning of the data; two where there are no three.
const ROWS: [usize; 2] = [3, 2];
const DELIMITERS: [Delimiter; 4] = [Delimiter::Byte(b'\t'), Delimiter::Byte(b';'), Delimiter::Byte(b','), Delimiter::Blanks];

impl Delimiter {
    /// The fields of a line; quotes keep a delimiter inside a field.
    pub(crate) fn fields(self, line: &str) -> Vec<String> {
        match self {
            Self::Blanks => line.split_whitespace().map(str::to_owned).collect(),
            // Quotes are rare; where there are none a plain split is the same and quicker.
            Self::Byte(delimiter) if !line.contains('"') => line.split(char::from(delimiter)).map(str::to_owned).collect(),
            Self::Byte(delimiter) => {
                let mut reader =
                    csv::ReaderBuilder::new().delimiter(delimiter).has_headers(false).flexible(true).from_reader(line.as_bytes());
                reader.records().next().and_then(Result::ok).map(|record| record.iter().map(str::to_owned).collect()).unwrap_or_default()
            }
        }
    }
}

impl Layout {
    /// Finds the layout: the delimiter that gives the most columns of numbers, at the first place where it gives them in a row.
    pub(super) fn find(head: &str) -> Result<Self, Damage> {
        let lines: Vec<&str> = head.lines().collect();
        let best = ROWS.iter().find_map(|rows| most_columns(&lines, *rows));
        let (skip, count, delimiter, decimal_comma) =
            best.ok_or_else(|| Damage::new("it holds no rows of numbers (dates and times of day are none: write seconds)"))?;
        let (heads, doubts) = heads(&lines[..skip], count, delimiter);
        Ok(Self { delimiter, decimal_comma, skip, heads, doubts })
    }
}

/// First line, number of columns, delimiter and decimal comma that give the most columns.
fn most_columns(lines: &[&str], rows: usize) -> Option<(usize, usize, Delimiter, bool)> {
    let ways = DELIMITERS.into_iter().flat_map(|delimiter| [(delimiter, false), (delimiter, true)]);
    let ways = ways.filter(|way| *way != (Delimiter::Byte(b','), true));
    let counted: Vec<_> = ways.map(|(delimiter, comma)| (delimiter, comma, counts(lines, delimiter, comma))).collect();
    // A text may be shorter than so many rows, but not in one way of reading it only.
    let longest = counted.iter().map(|(.., counts)| counts.iter().filter(|count| **count > 0).count()).max()?;
    let mut best: Option<(usize, usize, Delimiter, bool)> = None;
    for (delimiter, decimal_comma, counts) in counted {
        let Some((skip, count)) = first_rows(&counts, rows.min(longest).max(1)) else { continue };
        if best.is_none_or(|(_, most, ..)| count > most) {
            best = Some((skip, count, delimiter, decimal_comma));
        }
    }
    best
}

/// How many numbers each line holds; 0 for a line with something else.
fn counts(lines: &[&str], delimiter: Delimiter, decimal_comma: bool) -> Vec<usize> {
    let numbers = |line: &str| {
        let fields = delimiter.fields(line);
        let read: Vec<Field> = fields.iter().map(|field| Field::read(field, decimal_comma)).collect();
        let row = read.iter().all(|field| field.is_sample()) && read.iter().any(|field| *field != Field::Missing);
        if row { fields.len() } else { 0 }
    };
    lines.iter().map(|line| if line.trim().is_empty() { 0 } else { numbers(line) }).collect()
}

/// The first line of the first rows of equally many numbers, and how many numbers. Rows of as many that stand above, with nothing but numbers in
/// between, belong to them.
fn first_rows(counts: &[usize], rows: usize) -> Option<(usize, usize)> {
    let begins = |k: &usize| counts[*k] > 0 && counts[*k..].iter().take(rows).filter(|count| **count == counts[*k]).count() == rows;
    let found = (0..counts.len()).find(begins)?;
    let above = (0..found).rev().take_while(|k| counts[*k] > 0).filter(|k| counts[*k] == counts[found]).last();
    Some((above.unwrap_or(found), counts[found]))
}

/// Names and units from the last line above the numbers with as many fields, and a line of units below it; and what is doubtful about them.
fn heads(above: &[&str], count: usize, delimiter: Delimiter) -> (Vec<(String, String)>, Vec<Finding>) {
    let mut rows = above.iter().rev().map(|line| fields_of_head(line, count, delimiter)).filter(|fields| fields.len() == count);
    let Some(last) = rows.next() else {
        return ((1..=count).map(|number| (format!("column {number}"), String::new())).collect(), Vec::new());
    };
    let are_units = last.iter().all(|field| name::is_known(field));
    let (names, units) = match rows.next().filter(|_| are_units) {
        Some(names) => (names, Some(last)),
        None => (last, None),
    };
    let head = |(k, field): (usize, &String)| {
        let (name, unit) = name::split(field);
        let name = if name.is_empty() { format!("column {}", k + 1) } else { name };
        (name, units.as_ref().map_or(unit, |units| units[k].trim().to_owned()))
    };
    let doubts = if units.is_none() { names.iter().filter_map(|name| name::doubt(name)).collect() } else { Vec::new() };
    (distinct(names.iter().enumerate().map(head).collect()), doubts)
}

/// The fields of a line of heads, its comment sign taken away; fields that blanks part may be parted by two blanks or more.
fn fields_of_head(line: &str, count: usize, delimiter: Delimiter) -> Vec<String> {
    let line = line.trim_start_matches(['#', '%', '!']).trim();
    let fields = delimiter.fields(line);
    if delimiter != Delimiter::Blanks || fields.len() == count {
        return fields;
    }
    let wide: Vec<String> = line.split("  ").map(str::trim).filter(|field| !field.is_empty()).map(str::to_owned).collect();
    if wide.len() == count { wide } else { Delimiter::Byte(b',').fields(line) }
}

/// Names used twice get their column's number.
fn distinct(heads: Vec<(String, String)>) -> Vec<(String, String)> {
    let twice = |name: &str| heads.iter().filter(|(other, _)| other == name).count() > 1;
    let name = |k: usize, name: &str| if twice(name) { format!("{name} {}", k + 1) } else { name.to_owned() };
    heads.iter().enumerate().map(|(k, (head, unit))| (name(k, head), unit.clone())).collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    fn found(text: &str) -> (Delimiter, bool, usize, Vec<String>) {
        let layout = Layout::find(text).unwrap();
        let heads = layout.heads.iter().map(|(name, unit)| if unit.is_empty() { name.clone() } else { format!("{name}|{unit}") });
        (layout.delimiter, layout.decimal_comma, layout.skip, heads.collect())
    }

    #[test]
    fn layouts_of_many_kinds_are_found() {
        let cases = [
            ("time_s,a_g\n0,1\n1,2\n2,3\n", Delimiter::Byte(b','), false, 1, vec!["time_s|s", "a_g|g"]),
            ("# made 2020\n# t [s]; F [lbf]\n0,0;1,5\n0,1;1,6\n0,2;1,7\n", Delimiter::Byte(b';'), true, 2, vec!["t|s", "F|lbf"]),
            ("Test 5\nn 3\n\n t   a\n s   m/s2\n 0  1\n 1  2\n 2  3\n", Delimiter::Blanks, false, 5, vec!["t|s", "a|m/s2"]),
            ("0\t1\n1\t\n2\t3\n", Delimiter::Byte(b'\t'), false, 0, vec!["column 1", "column 2"]),
            ("a,a\n1,2\n", Delimiter::Byte(b','), false, 1, vec!["a 1", "a 2"]),
            ("t,a,b\n0,1,2\n1,2\n2,3,4\n3,4,5\n", Delimiter::Byte(b','), false, 1, vec!["t", "a", "b"]),
            ("t,a\n0,1\n1\n2,3\n3,4\n4,5\n", Delimiter::Byte(b','), false, 1, vec!["t", "a"]),
            ("5\nt a\n0 1\n1 2\n2 3\n", Delimiter::Blanks, false, 2, vec!["t", "a"]),
            ("\"x, y\",b\n1,2\n3,4\n5,6\n", Delimiter::Byte(b','), false, 1, vec!["x, y", "b"]),
        ];
        for (text, delimiter, comma, skip, heads) in cases {
            assert_eq!(found(text), (delimiter, comma, skip, heads.into_iter().map(str::to_owned).collect()), "{text}");
        }
        assert!(Layout::find("no numbers here\nat all\n").is_err());
    }
}
