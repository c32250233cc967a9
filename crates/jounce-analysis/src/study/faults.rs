//! The text of a study or a design as a table whose values have positions, and its faults.

use jounce_spec::{Fault, did_you_mean, nearest};
use std::ops::Range;
use toml_edit::{Document, Item, Table};

/// Collector of faults.
#[derive(Debug)]
pub struct FaultCollector<'t> {
    text: &'t str,
    /// Faults so far.
    pub faults: Vec<Fault>,
    /// Dotted paths of the keys that unknown keys probably mean.
    misspelt: Vec<String>,
}

impl<'t> FaultCollector<'t> {
    /// Starts with the text of a file.
    pub fn new(text: &'t str) -> Self {
        Self {
            text,
            faults: Vec::new(),
            misspelt: Vec::new(),
        }
    }

    /// Parses the document; a syntax error is then the only fault.
    pub fn document(&mut self) -> Option<Document<&'t str>> {
        match Document::parse(self.text) {
            Ok(document) => Some(document),
            Err(error) => {
                let message = format!("this is not valid TOML: {}", error.message());
                self.fault("", error.span(), message);
                None
            }
        }
    }

    /// Returns a value exactly as written.
    pub fn bare(&self, item: &Item) -> &'t str {
        item.span()
            .and_then(|span| self.text.get(span))
            .unwrap_or_default()
    }

    /// Adds a fault.
    pub fn fault(&mut self, key: &str, span: Option<Range<usize>>, message: impl Into<String>) {
        let place = |span: Range<usize>| {
            let before = self.text.get(..span.start).unwrap_or(self.text);
            let last_line = before.rsplit('\n').next().unwrap_or_default();
            (
                before.matches('\n').count() + 1,
                last_line.chars().count() + 1,
            )
        };
        // Something that is missing has no place.
        let (line, column) = span.map_or((0, 0), place);
        self.faults.push(Fault {
            line,
            column,
            key: key.to_owned(),
            message: message.into(),
            set: None,
        });
    }

    /// Refuses unknown keys.
    pub fn known(&mut self, path: &str, table: &Table, known: &[&str]) {
        for (key, item) in table {
            if !known.contains(&key) {
                let meant = nearest(key, known);
                self.misspelt
                    .extend(meant.map(|meant| format!("{path}{meant}")));
                let span = table
                    .key(key)
                    .and_then(toml_edit::Key::span)
                    .or(item.span());
                self.fault(
                    &format!("{path}{key}"),
                    span,
                    format!(
                        "{path}{key}: there is no such key{}; there are {}",
                        did_you_mean(key, known),
                        known.join(", ")
                    ),
                );
            }
        }
    }

    /// Adds the fault that a key is missing, unless an unknown key probably means it.
    pub fn missing(&mut self, key: &str, span: Option<Range<usize>>, message: impl Into<String>) {
        if !self.misspelt.iter().any(|meant| meant == key) {
            self.fault(key, span, message);
        }
    }

    /// Returns all faults in the order of their places, those without a place last.
    pub fn sorted(self) -> Vec<Fault> {
        let Self { mut faults, .. } = self;
        faults.sort();
        faults
    }

    /// Returns a table inside another; `None` if it is absent.
    pub fn table<'i>(&mut self, path: &str, item: Option<&'i Item>) -> Option<&'i Table> {
        let item = item?;
        if item.as_table().is_none() {
            self.fault(
                path,
                item.span(),
                format!("{path} must be a table, [{path}]"),
            );
        }
        item.as_table()
    }

    /// Returns a text.
    pub fn text<'i>(&mut self, path: &str, item: Option<&'i Item>) -> Option<&'i str> {
        let item = item?;
        if item.as_str().is_none() {
            self.fault(
                path,
                item.span(),
                format!("{path} must be a text, as in {path} = \"...\""),
            );
        }
        item.as_str()
    }

    /// Returns an integer within limits, or its default.
    pub fn integer(
        &mut self,
        path: &str,
        item: Option<&Item>,
        limits: (u64, u64),
        default: u64,
    ) -> u64 {
        let Some(item) = item else { return default };
        let value = item
            .as_integer()
            .and_then(|number| u64::try_from(number).ok())
            .filter(|n| (limits.0..=limits.1).contains(n));
        if value.is_none() {
            let message = format!(" is {}; it", self.bare(item));
            self.fault(
                path,
                item.span(),
                format!(
                    "{path}{message} must be a whole number from {} to {}",
                    limits.0, limits.1
                ),
            );
        }
        value.unwrap_or(default)
    }

    /// Returns a number above 0, or its default.
    pub fn positive(&mut self, path: &str, item: Option<&Item>, default: f64) -> f64 {
        let Some(item) = item else { return default };
        let number = item
            .as_float()
            .or(item.as_integer().map(|number| number as f64))
            .filter(|number| *number > 0.0 && number.is_finite());
        if number.is_none() {
            let message = format!(" is {}; it", self.bare(item));
            self.fault(
                path,
                item.span(),
                format!("{path}{message} must be a number greater than 0"),
            );
        }
        number.unwrap_or(default)
    }
}
