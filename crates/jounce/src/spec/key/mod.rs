//! The one table of keys: what each key is called, what it holds, what it may hold, and where its value lives.
//!
//! Reading, range checks, suggestions, overrides, sweeps, printing, the JSON Schema and the key reference all walk this table.

mod inner;
mod kind;
mod outline;
mod range;
mod slot;

pub(super) use inner::{Inner, Named, Single};
pub(super) use kind::Kind;
pub(super) use outline::{Row, rows};
pub(super) use range::Range;
pub(super) use slot::Slot;

use super::Quantity;

/// One key of a table that is read into a `T`.
pub(super) struct Key<T: 'static> {
    pub(super) info: KeyInfo,
    pub(super) slot: Slot<T>,
    /// The kind of quantity where it depends on other keys of the same thing.
    pub(super) quantity: Option<DependentQuantity<T>>,
}

/// A kind of quantity that depends on another key of the same thing.
pub(super) struct DependentQuantity<T> {
    /// The other key; it stands before this one in the table.
    pub(super) by: &'static str,
    /// None where a fault of other keys leaves it open; then the key is not read, so that only that fault is told.
    pub(super) quantity: fn(&T) -> Option<Quantity>,
}

/// What is known of a key without knowing the type that it is read into.
#[derive(Debug, Clone, Copy)]
pub(super) struct KeyInfo {
    pub(super) name: &'static str,
    pub(super) kind: Kind,
    pub(super) need: Need,
    pub(super) when: Option<When>,
    /// A key of the same table that gives this one a value where it does not stand.
    pub(super) unless: Option<&'static str>,
    pub(super) range: Range,
    /// One line for the key reference and for editors.
    pub(super) doc: &'static str,
}

/// Whether a key must stand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Need {
    /// It must.
    Required,
    /// It need not; the blank thing holds its default.
    Default,
    /// Exactly one of these must.
    OneOf(&'static [&'static str]),
    /// One of these may, not two.
    AtMostOne(&'static [&'static str]),
}

impl Need {
    /// The keys that exclude each other.
    pub(super) fn alternatives(self) -> &'static [&'static str] {
        match self {
            Self::OneOf(names) | Self::AtMostOne(names) => names,
            Self::Required | Self::Default => &[],
        }
    }
}

/// A key that goes only with some words of an earlier choice.
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
            range: Range::ANY,
            doc,
        };
        Self {
            info,
            slot,
            quantity: None,
        }
    }

    /// A quantity, required and of any value unless said otherwise.
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

    /// A plain number.
    pub(super) const fn number(
        name: &'static str,
        doc: &'static str,
        get: fn(&T) -> f64,
        set: fn(&mut T, f64),
    ) -> Self {
        Self::new(name, Kind::Number, doc, Slot::Number { get, set })
    }

    /// Text of a given kind.
    pub(super) const fn text(
        name: &'static str,
        kind: Kind,
        doc: &'static str,
        get: fn(&T) -> String,
        set: fn(&mut T, &str),
    ) -> Self {
        Self::new(name, kind, doc, Slot::Text { get, set })
    }

    /// A key with a slot of its own kind.
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

    /// The key need not stand.
    pub(super) const fn optional(mut self) -> Self {
        self.info.need = Need::Default;
        self
    }

    /// Exactly one of these keys must stand.
    pub(super) const fn one_of(mut self, names: &'static [&'static str]) -> Self {
        self.info.need = Need::OneOf(names);
        self
    }

    /// One of these keys may stand, not two.
    pub(super) const fn at_most_one_of(mut self, names: &'static [&'static str]) -> Self {
        self.info.need = Need::AtMostOne(names);
        self
    }

    /// Another key gives it a value where it does not stand; that key stands before it in the table.
    pub(super) const fn unless(mut self, key: &'static str) -> Self {
        self.info.unless = Some(key);
        self
    }

    /// The key goes only with some words of a choice that stands before it in the table.
    pub(super) const fn when(mut self, key: &'static str, is: &'static [&'static str]) -> Self {
        self.info.when = Some(When { key, is });
        self
    }

    /// The kind of quantity depends on another key.
    pub(super) const fn measured_by(
        mut self,
        by: &'static str,
        quantity: fn(&T) -> Option<Quantity>,
    ) -> Self {
        self.quantity = Some(DependentQuantity { by, quantity });
        self
    }

    /// What the key holds in this thing.
    pub(super) fn kind_in(&self, thing: &T) -> Kind {
        self.quantity
            .as_ref()
            .and_then(|measure| (measure.quantity)(thing))
            .map_or(self.info.kind, Kind::Quantity)
    }
}

/// The word that a choice has in a thing.
pub(super) fn chosen<T>(keys: &[Key<T>], thing: &T, choice: &str) -> Option<String> {
    keys.iter()
        .find(|key| key.info.name == choice)
        .and_then(|key| match key.slot {
            Slot::Text { get, .. } => Some(get(thing)),
            _ => None,
        })
}

/// True when the key goes with what the thing has chosen.
pub(super) fn applies<T>(keys: &[Key<T>], thing: &T, info: &KeyInfo) -> bool {
    info.when.is_none_or(|when| {
        chosen(keys, thing, when.key).is_some_and(|word| when.is.contains(&word.as_str()))
    })
}
