//! Names and units of the columns of a text, from the lines above its rows.

use super::delimiter::Delimiter;
use super::settings_keys::{is_of_time, is_pair};
use crate::read::heading::axis::is_time;
use crate::read::heading::name;
use crate::recording::{Issue, IssueKind};

/// Words that occur in a line of units but are not known units, in lower case.
const UNIT_WORDS: [&str; 22] = [
    "", "-", "none", "unknown", "sequence", "number", "ts", "rn", "a", "ma", "amp", "amps",
    "ampere", "amperes", "w", "watt", "ohm", "\u{b0}c", "degc", "celsius", "value", "logic",
];
/// Words for a missing unit.
const NO_UNITS: [&str; 9] = [
    "-", "none", "unknown", "sequence", "number", "ts", "rn", "value", "logic",
];
/// Loggers' words for a statistic of many samples, in lower case.
const REDUCTIONS: [&str; 8] = ["", "avg", "smp", "max", "min", "tot", "std", "med"];

/// Name and unit of a column.
#[derive(Debug, Clone, PartialEq, Default)]
pub(in crate::read) struct ColumnHead {
    pub name: String,
    pub unit: String,
    /// True where the column is empty in the first rows; text in it does not count as text among
    /// numbers.
    pub blank: bool,
    /// True for a column before all numbers, where some instruments write their settings.
    pub is_preceding: bool,
    /// True where no line of the text names the column.
    pub has_no_name: bool,
}

impl ColumnHead {
    fn numbered(k: usize) -> Self {
        Self {
            name: format!("column {}", k + 1),
            has_no_name: true,
            ..Self::default()
        }
    }
}

/// Reads names and units of columns, with ambiguities. Names are in the last line above the numbers
/// with one field per column, at least `used` and at most `count`; units in that line or the next.
pub(super) fn heads(
    above: &[&str],
    used: usize,
    count: usize,
    delimiter: Delimiter,
) -> (Vec<ColumnHead>, Vec<Issue>) {
    let mut rows = above
        .iter()
        .rev()
        .map(|line| fields_of_head(line, used, count, delimiter))
        .filter(|fields| (used..=count).contains(&fields.len()) && may_be_headings(fields));
    let Some(last) = rows.next() else {
        return ((0..count).map(ColumnHead::numbered).collect(), Vec::new());
    };
    let (names, units) = match rows
        .next()
        .filter(|names| are_units(&last) && !are_units(names))
    {
        Some(names) => (names, Some(last)),
        None => (last, None),
    };
    let mut issues: Vec<Issue> = if units.is_none() {
        names
            .iter()
            .filter_map(|name| name::ambiguity_issue(name))
            .collect()
    } else {
        Vec::new()
    };
    let head = |k: usize| {
        let (name, unit) = name::split(names.get(k).map_or("", String::as_str));
        let unit = match &units {
            Some(units) => units
                .get(k)
                .map_or(String::new(), |unit| cleaned_unit(unit)),
            None => unit,
        };
        if name.is_empty() {
            ColumnHead {
                unit,
                ..ColumnHead::numbered(k)
            }
        } else {
            ColumnHead {
                name,
                unit,
                ..ColumnHead::default()
            }
        }
    };
    let heads: Vec<ColumnHead> = (0..count).map(head).collect();
    let named = with_unique_names(&heads);
    issues.extend(repeated_names(&heads, &named));
    (named, issues)
}

/// True for a line that is neither a key with its value, nor a title, nor a list of statistics.
fn may_be_headings(fields: &[String]) -> bool {
    // A single word on a line is a title.
    let is_alone = fields.len() > 1 && fields[1..].iter().all(|field| field.trim().is_empty());
    let is_reduction = |field: &String| {
        REDUCTIONS.contains(&field.trim().trim_matches('"').to_lowercase().as_str())
    };
    !is_pair(fields) && !is_alone && !fields.iter().all(is_reduction)
}

/// Names that are consecutive numbers from 0 or 1, in a first row whose columns contain other
/// numbers below.
pub(super) fn numbered(
    first: &str,
    below: &[&str],
    delimiter: Delimiter,
) -> Option<Vec<ColumnHead>> {
    let unquoted = |fields: &[String]| {
        fields
            .iter()
            .map(|field| field.trim().trim_matches('"').to_owned())
            .collect::<Vec<String>>()
    };
    let names = unquoted(&delimiter.fields(first));
    let first_name = names.iter().position(|name| !name.is_empty())?;
    let from: usize = names[first_name].parse().ok().filter(|from| *from < 2)?;
    let in_order = names[first_name..]
        .iter()
        .enumerate()
        .all(|(k, name)| *name == (from + k).to_string());
    // An integer in each column could be the next row of counters.
    let is_integer = |field: &String| field.parse::<i64>().is_ok();
    let rows: Vec<Vec<String>> = below
        .iter()
        .map(|line| unquoted(&delimiter.fields(line)))
        .filter(|fields| fields.len() == names.len())
        .collect();
    let rows_differ = !rows.is_empty()
        && rows
            .iter()
            .all(|fields| !fields[first_name..].iter().any(is_integer));
    if first_name > 1 || names.len() - first_name < 2 || !in_order || !rows_differ {
        return None;
    }
    let head = |(k, name): (usize, &String)| {
        if name.is_empty() {
            ColumnHead::numbered(k)
        } else {
            ColumnHead {
                name: name.clone(),
                ..ColumnHead::default()
            }
        }
    };
    Some(names.iter().enumerate().map(head).collect())
}

/// True for a line of units: at least one is known, and all others are words found in such lines.
fn are_units(fields: &[String]) -> bool {
    let cleaned = |field: &String| {
        field
            .trim()
            .trim_matches(['"', '(', ')', '[', ']'])
            .trim()
            .to_lowercase()
    };
    let known = |field: &String| name::is_known(field.trim().trim_matches('"'));
    fields.iter().any(known)
        && fields
            .iter()
            .all(|field| known(field) || UNIT_WORDS.contains(&cleaned(field).as_str()))
}

/// Returns a unit from a line of units; empty for words that mean no unit.
fn cleaned_unit(unit: &str) -> String {
    let cleaned = unit.trim().trim_matches('"').trim();
    if NO_UNITS.contains(&cleaned.to_lowercase().as_str()) {
        String::new()
    } else {
        cleaned.to_owned()
    }
}

/// Splits a heading line into fields, without its comment sign, entries of a step or start, and
/// empty fields at its end. Fields separated by spaces may need two or more.
fn fields_of_head(line: &str, used: usize, count: usize, delimiter: Delimiter) -> Vec<String> {
    let line = line
        .trim_start_matches(['#', '%', '!'])
        .trim_start_matches(' ');
    // In semicolon-separated text the first field may be empty.
    let line = if delimiter == Delimiter::Byte(b';') {
        line
    } else {
        line.trim_start_matches(';')
    };
    let mut fields = delimiter.fields(line);
    if fields.len() > used
        && fields
            .first()
            .is_some_and(|first| first.trim().eq_ignore_ascii_case("headers"))
    {
        fields.remove(0);
    }
    if delimiter == Delimiter::Blanks {
        if fields.len() == count {
            return fields;
        }
        let wide_fields: Vec<String> = line
            .split("  ")
            .map(str::trim)
            .filter(|field| !field.is_empty())
            .map(str::to_owned)
            .collect();
        return if wide_fields.len() == count {
            wide_fields
        } else {
            Delimiter::Byte(b',').fields(line)
        };
    }
    if fields.len() > used {
        let leading_fields = fields.iter().take(used).cloned();
        // Numbers beyond the columns are not names but values of a step and a start, below their
        // keys.
        let is_number = |field: &str| field.trim().parse::<f64>().is_ok();
        let other_fields = fields
            .iter()
            .skip(used)
            .filter(|field| !is_of_time(field) && !is_number(field))
            .cloned();
        fields = leading_fields.chain(other_fields).collect();
    }
    while fields.len() > used && fields.last().is_some_and(|field| field.trim().is_empty()) {
        fields.pop();
    }
    fields
}

/// Appends the column number to duplicate names.
fn with_unique_names(heads: &[ColumnHead]) -> Vec<ColumnHead> {
    let is_repeated = |name: &str| heads.iter().filter(|head| head.name == name).count() > 1;
    let name = |k: usize, name: &str| {
        if is_repeated(name) {
            format!("{name} {}", k + 1)
        } else {
            name.to_owned()
        }
    };
    heads
        .iter()
        .enumerate()
        .map(|(k, head)| ColumnHead {
            name: name(k, &head.name),
            ..head.clone()
        })
        .collect()
}

/// Returns an issue for each name of several columns; a file may have a time for each channel.
fn repeated_names(heads: &[ColumnHead], named: &[ColumnHead]) -> Vec<Issue> {
    let mut issues = Vec::new();
    for (k, head) in heads.iter().enumerate() {
        let same = heads
            .iter()
            .zip(named)
            .filter(|(other, _)| other.name == head.name);
        let names: Vec<String> = same.map(|(_, own)| format!("{:?}", own.name)).collect();
        let is_first = heads[..k].iter().all(|other| other.name != head.name);
        if names.len() > 1 && is_first && !is_time(&head.name) {
            let message = format!(
                "{} columns have the name {:?}; they are read as {}",
                names.len(),
                head.name,
                names.join(", ")
            );
            issues.push(Issue::new(IssueKind::Assumed, names.len(), None, message));
        }
    }
    issues
}
