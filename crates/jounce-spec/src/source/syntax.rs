//! Conversion of TOML to a tree, past as many syntax errors as is safe.
//!
//! After an error the faulty line is blanked and the text is read again, so several errors are
//! reported at once. A line that is valid alone is not blanked: then the cause lies elsewhere, and
//! reading stops.

use toml_edit::Document;

use super::lines::{Lines, boundary};
use super::node::{Node, Value, entries};
use crate::fault::Faults;
use crate::nearest::clip;
use jounce_units::Decimal;

/// Largest number of reported syntax errors.
const MAX_SYNTAX_ERRORS: usize = 20;

/// Largest number of bytes that are read again after errors, in addition to the size of the file.
const MAX_REREAD_BYTES: usize = 4 << 20;

/// A spec as text and as a tree.
#[derive(Debug, Clone)]
pub(crate) struct Source {
    /// The complete file as a table.
    pub(crate) root: Node,
    /// Syntax errors.
    pub(crate) errors: Vec<SyntaxError>,
    /// False if lines were skipped, so keys of the file may be missing.
    pub(crate) complete: bool,
}

/// A syntax error.
#[derive(Debug, Clone)]
pub(crate) struct SyntaxError {
    pub(crate) offset: usize,
    pub(crate) key: String,
    pub(crate) message: String,
}

/// Reads a text.
pub(crate) fn parse(text: &str) -> Source {
    let mut work = text.to_owned();
    let mut source = Source {
        root: Node::at(0, Value::Table(Vec::new())),
        errors: Vec::new(),
        complete: true,
    };
    if let Some(offset) = other_text(text) {
        source.complete = false;
        source.errors.push(SyntaxError {
            offset,
            key: String::new(),
            message: "this is no spec: its first line is neither [TABLE] nor KEY = VALUE; `jounce read` reads a recording".to_owned(),
        });
        return source;
    }
    let most = (MAX_REREAD_BYTES / text.len().max(1)).clamp(1, MAX_SYNTAX_ERRORS);
    loop {
        let error = match Document::parse(work.as_str()) {
            Ok(document) => {
                source.root.value = Value::Table(entries(&work, document.as_table(), 0));
                return source;
            }
            Err(_) if source.errors.len() == most => break,
            Err(error) => error,
        };
        let span = error.span().unwrap_or(0..0);
        let offset = boundary(&work, span.start);
        let duplicate = error.message() == "duplicate key";
        source.complete &= duplicate;
        source.errors.push(if duplicate {
            duplicated(&work, offset, &span)
        } else {
            malformed(&work, offset, error.message())
        });
        if !leave_out(&mut work, offset, duplicate) {
            source.complete = false;
            return source;
        }
    }
    source.complete = false;
    source.errors.push(SyntaxError {
        offset: text.len(),
        key: String::new(),
        message: Faults::MORE.to_owned(),
    });
    source
}

/// Returns the offset of the first line with content where it cannot begin a spec.
fn other_text(text: &str) -> Option<usize> {
    let is_content = |line: &&str| !line.trim().is_empty() && !line.trim_start().starts_with('#');
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let line = text.lines().find(is_content)?;
    let begins = is_header(line) || line.contains('=');
    (!begins).then(|| line.as_ptr() as usize - text.as_ptr() as usize)
}

/// Blanks the faulty text of an error; false if that is ambiguous.
fn leave_out(work: &mut String, offset: usize, duplicate: bool) -> bool {
    let lines = Lines::new(work);
    let line = lines.range(offset);
    let content = &work[line.clone()];
    if content.trim().is_empty() || (!duplicate && Document::parse(content).is_ok()) {
        return false;
    }
    let mut end = line.end;
    if is_header(content) {
        // The keys below a header are blanked with it; in another table they would have another
        // meaning.
        while end < work.len() && !is_header(&work[lines.range(end + 1)]) {
            end = lines.range(end + 1).end;
        }
    }
    let blank: String = work[line.start..end]
        .bytes()
        .map(|byte| if byte == b'\n' { '\n' } else { ' ' })
        .collect();
    work.replace_range(line.start..end, &blank);
    true
}

fn is_header(line: &str) -> bool {
    line.trim_start().starts_with('[')
}

/// Returns `beam.beam` for `[beam.beam]  # comment`.
fn header_name(line: &str) -> &str {
    line.trim_start()
        .trim_start_matches('[')
        .split(']')
        .next()
        .unwrap_or_default()
        .trim()
}

fn duplicated(text: &str, offset: usize, span: &std::ops::Range<usize>) -> SyntaxError {
    let lines = Lines::new(text);
    let line = &text[lines.range(offset)];
    if is_header(line) {
        let name = header_name(line);
        let first = first_line(text, |other| is_header(other) && header_name(other) == name)
            .filter(|first| *first < lines.line_and_column(offset).0);
        let hint = first
            .map(|first| format!(" (first on line {first})"))
            .unwrap_or_default();
        let message = format!(
            "[{}] is defined twice{hint}; rename the second one, or merge the two",
            clip(name)
        );
        return SyntaxError {
            offset,
            key: clip(name),
            message,
        };
    }
    let key = text.get(span.clone()).unwrap_or_default().trim();
    let before = &text[..lines.range(offset).start];
    let path = path_of(before, key);
    let header = before.lines().collect::<Vec<_>>();
    let header = header.iter().rposition(|other| is_header(other));
    let header_before = before
        .lines()
        .enumerate()
        .skip(header.map_or(0, |index| index + 1));
    let first = header_before
        .filter(|(_, other)| {
            other
                .split('=')
                .next()
                .is_some_and(|other| other.trim() == key)
        })
        .map(|(index, _)| index + 1)
        .next();
    let hint = first
        .map(|first| format!(" (first on line {first})"))
        .unwrap_or_default();
    let message = format!("{path}: the key appears twice in this table{hint}; remove one of them");
    SyntaxError {
        offset,
        key: path,
        message,
    }
}

/// Returns the path of a key from the last header before it.
fn path_of(before: &str, key: &str) -> String {
    let header = before.lines().rfind(|other| is_header(other));
    match header.map(header_name).unwrap_or_default() {
        "" => clip(key),
        name => format!("{}.{}", clip(name), clip(key)),
    }
}

fn first_line(text: &str, predicate: impl Fn(&str) -> bool) -> Option<usize> {
    text.lines().position(predicate).map(|index| index + 1)
}

fn malformed(text: &str, offset: usize, reason: &str) -> SyntaxError {
    let range = Lines::new(text).range(offset);
    let hint = text[range.clone()]
        .split_once('=')
        .and_then(|(key, value)| {
            let path = path_of(&text[..range.start], key.trim());
            unquoted(&path, value.trim())
        });
    let message = hint.unwrap_or_else(|| format!("this is not valid TOML: {reason}"));
    SyntaxError {
        offset,
        key: String::new(),
        message,
    }
}

/// Detects the likely mistake `frequency = 13 Hz`.
fn unquoted(path: &str, value: &str) -> Option<String> {
    let value = value.split('#').next().unwrap_or_default().trim();
    let (_, unit) = Decimal::split(value)?;
    let begins_a_unit = unit
        .trim_start()
        .starts_with(|c: char| c.is_alphabetic() || c == '\u{b0}');
    begins_a_unit.then(|| format!("{path}: write the quantity in quotes: \"{}\"", clip(value)))
}
