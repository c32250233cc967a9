//! Nested tables: elements by name (`[beam.NAME]`) and single tables (`[run]`).

use std::collections::BTreeMap;

use super::outline::{Row, rows};
use super::{Key, Kind};
use crate::numeric_key::{Numeric, locate, store};
use crate::read::{ReadState, read_keys, read_named};
use crate::source::Node;
use crate::write::write_keys;

/// A table within a `P`, independent of the type that it is read into.
pub(crate) trait Inner<P>: Sync {
    /// Reads the table into the parent.
    fn read(&self, parent: &mut P, path: &str, node: &Node, reading: &mut ReadState);
    /// Prints the table as TOML under its header.
    fn write(&self, parent: &P, path: &str, out: &mut String);
    /// Returns the keys of the table.
    fn rows(&self) -> Vec<Row>;
    /// Returns the number at a path below the table.
    fn locate(&self, parent: &P, path: &[&str]) -> Option<Numeric>;
    /// Stores a number at a path below the table; false if there is none.
    fn store(&self, parent: &mut P, path: &[&str], value: f64) -> bool;
}

/// Elements by names that the user chooses.
pub(crate) struct Named<P: 'static, T: 'static> {
    pub(crate) get: fn(&P) -> &BTreeMap<String, T>,
    pub(crate) open: fn(&mut P) -> &mut BTreeMap<String, T>,
    /// Blank element: defaults where they exist; required numbers are NaN, texts and lists empty.
    pub(crate) blank: fn() -> T,
    pub(crate) keys: &'static [Key<T>],
}

impl<P, T> Inner<P> for Named<P, T> {
    fn read(&self, parent: &mut P, path: &str, node: &Node, reading: &mut ReadState) {
        read_named(
            path,
            node,
            Kind::Things,
            reading,
            &mut |name, path, node, reading| {
                let mut element = (self.blank)();
                read_keys(self.keys, path, node, &mut element, reading);
                (self.open)(parent).insert(name.to_owned(), element);
            },
        );
    }

    fn write(&self, parent: &P, path: &str, out: &mut String) {
        for (name, element) in (self.get)(parent) {
            write_keys(
                self.keys,
                element,
                &format!("{path}.{}", toml_edit::Key::new(name)),
                true,
                out,
            );
        }
    }

    fn rows(&self) -> Vec<Row> {
        rows(self.keys, self.blank)
    }

    fn locate(&self, parent: &P, path: &[&str]) -> Option<Numeric> {
        let (name, rest) = path.split_first()?;
        locate(self.keys, (self.get)(parent).get(*name)?, rest)
    }

    fn store(&self, parent: &mut P, path: &[&str], value: f64) -> bool {
        let Some((name, rest)) = path.split_first() else {
            return false;
        };
        (self.open)(parent)
            .get_mut(*name)
            .is_some_and(|element| store(self.keys, element, rest, value))
    }
}

/// A table that occurs once.
pub(crate) struct Single<P: 'static, T: 'static> {
    pub(crate) get: fn(&P) -> &T,
    pub(crate) open: fn(&mut P) -> &mut T,
    pub(crate) keys: &'static [Key<T>],
}

impl<P, T: Default> Inner<P> for Single<P, T> {
    fn read(&self, parent: &mut P, path: &str, node: &Node, reading: &mut ReadState) {
        read_keys(self.keys, path, node, (self.open)(parent), reading);
    }

    fn write(&self, parent: &P, path: &str, out: &mut String) {
        write_keys(self.keys, (self.get)(parent), path, false, out);
    }

    fn rows(&self) -> Vec<Row> {
        rows(self.keys, T::default)
    }

    fn locate(&self, parent: &P, path: &[&str]) -> Option<Numeric> {
        locate(self.keys, (self.get)(parent), path)
    }

    fn store(&self, parent: &mut P, path: &[&str], value: f64) -> bool {
        store(self.keys, (self.open)(parent), path, value)
    }
}
