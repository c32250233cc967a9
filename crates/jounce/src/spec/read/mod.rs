//! From the tree of values to the typed spec, by the table of keys.

mod doubtful;
mod table;
mod value;

pub(super) use table::{read_keys, read_named};
pub(super) use value::read_number;

use std::collections::HashMap;

use super::fault::Faults;
use super::source::Place;

/// What comes up while a tree is read.
pub(super) struct Reading {
    /// What is wrong so far.
    pub(super) found: Vec<Finding>,
    /// Where each key that was read stands, by its dotted path; the keys of tables too.
    pub(super) places: HashMap<String, Place>,
    /// False where lines of the file were left out: then nothing is called missing.
    pub(super) complete: bool,
}

/// Something wrong, and where.
pub(super) struct Finding {
    pub(super) place: Place,
    pub(super) key: String,
    pub(super) message: String,
}

impl Reading {
    pub(super) fn new(complete: bool) -> Self {
        Self { found: Vec::new(), places: HashMap::new(), complete }
    }

    /// Notes a fault; the message names the key. Past the most that is reported nothing is kept.
    pub(super) fn fault(&mut self, place: Place, key: &str, text: impl FnOnce() -> String) {
        if self.found.len() < Faults::MOST {
            let message = super::nearest::sentence(key, &text());
            self.found.push(Finding { place, key: key.to_owned(), message });
        }
    }

    /// Adds broken rules between keys; a key that has a fault already is left alone.
    pub(super) fn add_broken(&mut self, broken: Vec<(String, String)>) {
        let told: Vec<String> = self.found.iter().map(|finding| finding.key.clone()).collect();
        for (key, message) in broken {
            let below = format!("{key}.");
            let empty = key == super::cross::NO_STRUCTURE && !told.is_empty();
            if !empty && !told.iter().any(|other| *other == key || other.starts_with(&below)) && self.has_room() {
                self.found.push(Finding { place: self.place(&key), key, message });
            }
        }
    }

    /// Where a key stands, or else the table that would hold it.
    fn place(&self, key: &str) -> Place {
        let mut path = key;
        loop {
            match (self.places.get(path), path.rsplit_once('.')) {
                (Some(place), _) => return *place,
                (None, Some((parent, _))) => path = parent,
                (None, None) => return Place::At(0),
            }
        }
    }

    /// True while faults are still kept.
    pub(super) fn has_room(&self) -> bool {
        self.found.len() < Faults::MOST
    }
}

/// `path.name`, or `name` at the top.
pub(super) fn join(path: &str, name: &str) -> String {
    if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") }
}
