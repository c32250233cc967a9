//! From the tree of values to the typed spec, by the table of keys.

mod missing_choice;
mod table;
mod value;

pub(super) use table::{read_keys, read_named};
pub(super) use value::read_number;

use std::collections::HashMap;

use super::fault::Faults;
use super::source::SourcePlace;

/// What comes up while a tree is read.
pub(super) struct ReadState {
    /// What is wrong so far.
    pub(super) found: Vec<ReadFault>,
    /// Where each key that was read stands, by its dotted path; the keys of tables too.
    pub(super) places: HashMap<String, SourcePlace>,
    /// False where lines of the file were left out: then nothing is called missing.
    pub(super) complete: bool,
}

/// Something wrong, and where.
pub(super) struct ReadFault {
    pub(super) place: SourcePlace,
    pub(super) key: String,
    pub(super) message: String,
}

impl ReadState {
    pub(super) fn new(complete: bool) -> Self {
        Self {
            found: Vec::new(),
            places: HashMap::new(),
            complete,
        }
    }

    /// Notes a fault; the message names the key. Past the most that is reported nothing is kept.
    pub(super) fn fault(&mut self, place: SourcePlace, key: &str, text: impl FnOnce() -> String) {
        if self.found.len() < Faults::MAX_REPORTED {
            let message = super::nearest::sentence(key, &text());
            self.found.push(ReadFault {
                place,
                key: key.to_owned(),
                message,
            });
        }
    }

    /// Adds broken rules between keys; a key that has a fault already is left alone.
    pub(super) fn add_broken(&mut self, broken: Vec<(String, String)>) {
        let told: Vec<String> = self
            .found
            .iter()
            .map(|finding| finding.key.clone())
            .collect();
        for (key, message) in broken {
            let below = format!("{key}.");
            let empty = key == super::validation::NO_STRUCTURE && !told.is_empty();
            if !empty
                && !told
                    .iter()
                    .any(|other| *other == key || other.starts_with(&below))
                && self.has_room()
            {
                self.found.push(ReadFault {
                    place: self.place(&key),
                    key,
                    message,
                });
            }
        }
    }

    /// Where a key stands, or else the table that would hold it.
    fn place(&self, key: &str) -> SourcePlace {
        let mut path = key;
        loop {
            match (self.places.get(path), path.rsplit_once('.')) {
                (Some(place), _) => return *place,
                (None, Some((parent, _))) => path = parent,
                (None, None) => return SourcePlace::At(0),
            }
        }
    }

    /// True while faults are still kept.
    pub(super) fn has_room(&self) -> bool {
        self.found.len() < Faults::MAX_REPORTED
    }
}

/// `path.name`, or `name` at the top.
pub(super) fn join(path: &str, name: &str) -> String {
    if path.is_empty() {
        name.to_owned()
    } else {
        format!("{path}.{name}")
    }
}
