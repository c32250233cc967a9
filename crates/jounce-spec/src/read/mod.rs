//! Reading of the tree of values into the typed spec, by the table of keys.

mod missing_choice;
mod table;
mod value;

pub(super) use table::{read_keys, read_named};
pub(super) use value::read_number;

use std::collections::HashMap;

use super::fault::Faults;
use super::source::SourcePlace;

/// State of the reading of a tree.
pub(super) struct ReadState {
    /// Faults so far.
    pub(super) found: Vec<ReadFault>,
    /// Place of each key that was read, by its dotted path; includes the keys of tables.
    pub(super) positions: HashMap<String, SourcePlace>,
    /// The key that was written for a key that it is stored as, both by their dotted paths.
    pub(super) written_as: HashMap<String, String>,
    /// Dotted paths of the keys that unknown keys probably mean.
    pub(super) misspelt: Vec<String>,
    /// False if lines of the file were skipped; then no key is reported as missing.
    pub(super) complete: bool,
}

/// A fault and its place.
pub(super) struct ReadFault {
    pub(super) position: SourcePlace,
    pub(super) key: String,
    pub(super) message: String,
}

impl ReadState {
    pub(super) fn new(complete: bool) -> Self {
        Self {
            found: Vec::new(),
            positions: HashMap::new(),
            written_as: HashMap::new(),
            misspelt: Vec::new(),
            complete,
        }
    }

    /// Records a fault; the message names the key. Faults beyond the reporting limit are dropped.
    pub(super) fn fault(
        &mut self,
        position: SourcePlace,
        key: &str,
        text: impl FnOnce() -> String,
    ) {
        if self.has_room() {
            self.add(position, key, text());
        }
    }

    fn add(&mut self, position: SourcePlace, key: &str, text: String) {
        self.found.push(ReadFault {
            position,
            key: key.to_owned(),
            message: super::nearest::sentence(key, &text),
        });
    }

    /// Adds violated rules between keys; a key that already has a fault, or that is absent because
    /// it is misspelt, is skipped.
    pub(super) fn add_broken(&mut self, faults: Vec<(String, String)>) {
        let messages: Vec<String> = self.found.iter().map(|issue| issue.key.clone()).collect();
        for (key, message) in faults {
            let (key, message) = match self.written_as.get(&key) {
                Some(written) => (written.clone(), message.replacen(&key, written, 1)),
                None => (key, message),
            };
            let below = format!("{key}.");
            let empty = key == super::validation::NO_STRUCTURE && !messages.is_empty();
            if !empty
                && !messages
                    .iter()
                    .any(|other| *other == key || other.starts_with(&below))
                && !self.is_misspelt(&key)
                && self.has_room()
            {
                let position = self.position(&key);
                let message = match (position, key.split_once('.')) {
                    (SourcePlace::Nowhere, Some((table, _))) => {
                        format!("{message}; the file has no [{table}]")
                    }
                    _ => message,
                };
                self.found.push(ReadFault {
                    position,
                    key,
                    message,
                });
            }
        }
    }

    /// True for a key that is absent because it, or a table that would contain it, is misspelt.
    fn is_misspelt(&self, key: &str) -> bool {
        let contains = |path: &String| {
            let below = key.strip_prefix(path.as_str());
            below.is_some_and(|below| below.is_empty() || below.starts_with('.'))
        };
        let mut absent = self
            .misspelt
            .iter()
            .filter(|path| !self.positions.contains_key(*path));
        absent.any(contains)
    }

    /// Returns the place of a key, or of the nearest table that would contain it.
    fn position(&self, key: &str) -> SourcePlace {
        let mut path = key;
        loop {
            match (self.positions.get(path), path.rsplit_once('.')) {
                (Some(position), _) => return *position,
                (None, Some((parent, _))) => path = parent,
                (None, None) => return SourcePlace::Nowhere,
            }
        }
    }

    /// True while there is room for more faults.
    pub(super) fn has_room(&self) -> bool {
        self.found.len() < Faults::MAX_FOUND
    }
}

/// Returns `path.name`, or `name` at the top.
pub(super) fn join(path: &str, name: &str) -> String {
    if path.is_empty() {
        name.to_owned()
    } else {
        format!("{path}.{name}")
    }
}
