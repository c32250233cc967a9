//! Headers of the file and of the segment.

use crate::read::error::Damage;
use crate::read::format::text::{ColumnHead, Delimiter, Preamble, TextLayout, complete_lines};
use crate::recording::IssuePlace;

/// Heading of a time column.
pub(super) const X_VALUE: &str = "X_Value";

/// Heading of a comment column.
pub(super) const COMMENT: &str = "Comment";

/// Contents of the two headers.
pub(super) struct Header {
    pub layout: TextLayout,
    /// Keys of the segment with their values, one for each data column.
    fields: Vec<(String, Vec<String>)>,
    pub x_columns: String,
}

impl Header {
    pub(super) fn read(head: &str, end: u8) -> Result<Self, Damage> {
        let lines = complete_lines(head, end, true);
        let heads = lines.iter().position(|line| line.starts_with(X_VALUE));
        let heads = heads.ok_or_else(|| {
            Damage::at(
                IssuePlace::Line(lines.len()),
                "no line of column headings (X_Value ...) follows; is the file truncated?",
            )
        })?;
        let separator = if value(&lines[..heads], "Separator") == Some("Comma") {
            ','
        } else {
            '\t'
        };
        let decimal_comma = value(&lines[..heads], "Decimal_Separator") == Some(",");
        let parts = |line: &str| -> Vec<String> {
            line.split(separator)
                .map(|field| field.trim().to_owned())
                .collect()
        };
        let mut names = parts(lines[heads]);
        while names.len() > 1 && names.last().is_some_and(String::is_empty) {
            names.pop();
        }
        let min_fields = names
            .iter()
            .rposition(|name| name != COMMENT && !name.is_empty())
            .map_or(1, |last| last + 1);
        let head = |name: String| ColumnHead {
            blank: name == COMMENT || name.is_empty(),
            name,
            ..ColumnHead::default()
        };
        let segment = lines[..heads]
            .iter()
            .rposition(|line| line.split(separator).next() == Some("Channels"))
            .unwrap_or(0);
        let field = |line: &&str| {
            let fields = parts(line);
            (fields.first().cloned().unwrap_or_default(), fields)
        };
        Ok(Self {
            x_columns: value(&lines[..heads], "X_Columns")
                .unwrap_or("One")
                .to_owned(),
            fields: lines[segment..heads].iter().map(field).collect(),
            layout: TextLayout {
                delimiter: Delimiter::Byte(separator as u8),
                decimal_comma,
                line_end: end,
                skip: heads + 1,
                min_fields,
                heads: names.into_iter().map(head).collect(),
                preamble: Preamble::default(),
                issues: Vec::new(),
            },
        })
    }

    /// Returns the value of a key for a column. It is normally in that column; some programs
    /// reserve no columns for times and write the values consecutively.
    pub(super) fn value(&self, key: &str, column: usize) -> Option<&str> {
        let (_, fields) = self.fields.iter().rev().find(|(name, _)| name == key)?;
        let names = || {
            self.layout
                .heads
                .iter()
                .map(|head| head.name.as_str())
                .enumerate()
        };
        let packed = names().any(|(k, name)| {
            k > 0 && name == X_VALUE && fields.get(k).is_some_and(|field| !field.is_empty())
        });
        let channel = names()
            .take(column)
            .filter(|(_, name)| *name != X_VALUE)
            .count()
            + 1;
        fields
            .get(if packed { channel } else { column })
            .map(String::as_str)
            .filter(|text| !text.is_empty())
    }

    /// Returns a number of the header for a column; one shared by all channels may be given once.
    pub(super) fn number(&self, key: &str, column: usize) -> Option<f64> {
        let text = self.value(key, column).or_else(|| self.value(key, 1))?;
        text.replace(',', ".")
            .parse::<f64>()
            .ok()
            .filter(|number| number.is_finite())
    }
}

/// Returns the first value of a key of the header.
fn value<'a>(lines: &[&'a str], key: &str) -> Option<&'a str> {
    let line = lines
        .iter()
        .find(|line| line.starts_with(key) && line[key.len()..].starts_with(['\t', ',']))?;
    line[key.len() + 1..].split('\t').next().map(str::trim)
}
