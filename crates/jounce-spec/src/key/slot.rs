//! Location of the value of a key in a typed element.

use std::collections::BTreeMap;

use super::{Element, Elements};

/// Access to the value of one key of a `T`; numbers are in SI.
pub(crate) enum Slot<T: 'static> {
    /// A number.
    Number {
        /// reads it
        get: fn(&T) -> f64,
        /// writes it
        set: fn(&mut T, f64),
    },
    /// A number that is stored as another key; not printed.
    Derived {
        /// computes it
        get: fn(&T) -> f64,
        /// writes the other key
        set: fn(&mut T, f64),
    },
    /// A number that may be absent.
    Optional {
        /// reads it
        get: fn(&T) -> Option<f64>,
        /// writes it
        set: fn(&mut T, f64),
    },
    /// A whole number.
    Count {
        /// reads it
        get: fn(&T) -> usize,
        /// writes it
        set: fn(&mut T, usize),
    },
    /// Text, a choice or a reference.
    Text {
        /// reads it
        get: fn(&T) -> String,
        /// writes it; a choice gets only its own words
        set: fn(&mut T, &str),
    },
    /// A list of texts.
    Texts {
        /// returns it for writing
        get: fn(&T) -> &Vec<String>,
        /// opens it
        open: fn(&mut T) -> &mut Vec<String>,
    },
    /// A list of numbers.
    Numbers {
        /// reads it
        get: fn(&T) -> &Vec<f64>,
        /// returns it for writing
        open: fn(&mut T) -> &mut Vec<f64>,
    },
    /// A list of numbers that is stored as another key; not printed.
    DerivedNumbers {
        /// name of that key
        of: &'static str,
        /// reads it
        get: fn(&T) -> &Vec<f64>,
        /// returns it for writing
        open: fn(&mut T) -> &mut Vec<f64>,
    },
    /// Quantities by name.
    NamedQuantities {
        /// reads them
        get: fn(&T) -> &BTreeMap<String, f64>,
        /// returns them for writing
        open: fn(&mut T) -> &mut BTreeMap<String, f64>,
    },
    /// Lists of numbers by name.
    NamedNumbers {
        /// reads them
        get: fn(&T) -> &BTreeMap<String, Vec<f64>>,
        /// returns them for writing
        open: fn(&mut T) -> &mut BTreeMap<String, Vec<f64>>,
    },
    /// A table that occurs once: `[run]`.
    Table {
        /// reads it
        get: fn(&T) -> &dyn Element,
        /// returns it for writing
        open: fn(&mut T) -> &mut dyn Element,
    },
    /// Elements by names that the user chooses: `[beam.NAME]`.
    Things {
        /// reads them
        get: fn(&T) -> &dyn Elements,
        /// returns them for writing
        open: fn(&mut T) -> &mut dyn Elements,
    },
}
