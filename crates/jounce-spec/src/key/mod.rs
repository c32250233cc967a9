//! Table of keys: the name of each key, its kind, its allowed values, and where its value is
//! stored.
//!
//! Reading, range checks, suggestions, overrides, sweeps, printing, the JSON Schema and the key
//! reference all use this table.

mod element;
mod kind;
mod outline;
mod range;
mod slot;

pub(super) use element::{Element, Elements, Keyed, ValueMut, ValueRef};
pub(super) use kind::Kind;
pub(super) use outline::{Row, rows};
pub(super) use range::Range;
pub(super) use slot::Slot;

use super::Quantity;

/// One key of a table that is read into a `T`.
pub(super) struct Key<T: 'static> {
    pub(super) info: KeyInfo,
    pub(super) slot: Slot<T>,
    /// Kind of quantity if it depends on another key of the same element; `None` if a fault of other
    /// keys leaves it undefined. Then the key is not read, so only that fault is reported.
    pub(super) quantity: Option<fn(&T) -> Option<Quantity>>,
}

/// Properties of a key that do not depend on the type that it is read into.
#[derive(Debug, Clone, Copy)]
pub(super) struct KeyInfo {
    pub(super) name: &'static str,
    pub(super) kind: Kind,
    pub(super) need: Need,
    pub(super) when: Option<When>,
    /// A key of the same table that gives this key a value if it is omitted.
    pub(super) unless: Option<&'static str>,
    /// The key that the kind of quantity depends on, which precedes this one in the table.
    pub(super) measured_by: Option<&'static str>,
    pub(super) range: Range,
    /// One line of help for the key reference and for editors.
    pub(super) doc: &'static str,
}

/// Requirement of a key.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Need {
    /// Required.
    Required,
    /// Optional; the blank element holds its default.
    Default,
    /// Exactly one of these keys is required.
    OneOf(&'static [&'static str]),
    /// At most one of these keys is allowed.
    AtMostOne(&'static [&'static str]),
}

impl Need {
    /// Returns the keys that exclude each other.
    pub(super) fn alternatives(self) -> &'static [&'static str] {
        match self {
            Self::OneOf(names) | Self::AtMostOne(names) => names,
            Self::Required | Self::Default => &[],
        }
    }
}

/// Condition of a key that applies only with some words of an earlier choice.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct When {
    pub(super) key: &'static str,
    pub(super) is: &'static [&'static str],
}

impl<T> Key<T> {
    const fn new(name: &'static str, kind: Kind, doc: &'static str, slot: Slot<T>) -> Self {
        let info = KeyInfo {
            name,
            kind,
            need: Need::Required,
            when: None,
            unless: None,
            measured_by: None,
            range: Range::ANY,
            doc,
        };
        Self {
            info,
            slot,
            quantity: None,
        }
    }

    /// Returns the key of a quantity: required and of any value unless specified otherwise.
    pub(super) const fn quantity(
        name: &'static str,
        quantity: Quantity,
        doc: &'static str,
        get: fn(&T) -> f64,
        set: fn(&mut T, f64),
    ) -> Self {
        Self::new(
            name,
            Kind::Quantity(quantity),
            doc,
            Slot::Number { get, set },
        )
    }

    /// Returns the key of a plain number.
    pub(super) const fn number(
        name: &'static str,
        doc: &'static str,
        get: fn(&T) -> f64,
        set: fn(&mut T, f64),
    ) -> Self {
        Self::new(name, Kind::Number, doc, Slot::Number { get, set })
    }

    /// Returns the key of text of a given kind.
    pub(super) const fn text(
        name: &'static str,
        kind: Kind,
        doc: &'static str,
        get: fn(&T) -> String,
        set: fn(&mut T, &str),
    ) -> Self {
        Self::new(name, kind, doc, Slot::Text { get, set })
    }

    /// Returns a key with its own kind of slot.
    pub(super) const fn with_slot(
        name: &'static str,
        kind: Kind,
        doc: &'static str,
        slot: Slot<T>,
    ) -> Self {
        Self::new(name, kind, doc, slot)
    }

    /// Sets the limits of the value, in SI.
    pub(super) const fn within(mut self, range: Range) -> Self {
        self.info.range = range;
        self
    }

    /// Makes the key optional.
    pub(super) const fn optional(mut self) -> Self {
        self.info.need = Need::Default;
        self
    }

    /// Requires exactly one of these keys.
    pub(super) const fn one_of(mut self, names: &'static [&'static str]) -> Self {
        self.info.need = Need::OneOf(names);
        self
    }

    /// Allows at most one of these keys.
    pub(super) const fn at_most_one_of(mut self, names: &'static [&'static str]) -> Self {
        self.info.need = Need::AtMostOne(names);
        self
    }

    /// Names a key that gives this one a value if it is omitted; that key precedes it in the table.
    pub(super) const fn unless(mut self, key: &'static str) -> Self {
        self.info.unless = Some(key);
        self
    }

    /// Restricts the key to some words of a choice that precedes it in the table.
    pub(super) const fn when(mut self, key: &'static str, is: &'static [&'static str]) -> Self {
        self.info.when = Some(When { key, is });
        self
    }

    /// Makes the kind of quantity depend on another key.
    pub(super) const fn measured_by(
        mut self,
        by: &'static str,
        quantity: fn(&T) -> Option<Quantity>,
    ) -> Self {
        self.info.measured_by = Some(by);
        self.quantity = Some(quantity);
        self
    }
}
