//! Elements with their tables of keys, whatever their types: what reads, changes and prints them is
//! compiled once.

use std::collections::BTreeMap;

use super::{Key, KeyInfo, Kind, Slot};
use crate::Quantity;

/// A type with a table of keys.
pub(crate) trait Keyed: Sized + 'static {
    /// Choices precede the keys that depend on them.
    const KEYS: &'static [Key<Self>];
    /// Blank element: defaults where they exist; required numbers are NaN, texts and lists empty.
    fn blank() -> Self;
}

/// An element of any type; its keys are numbered in the order of their table.
pub(crate) trait Element {
    /// Returns the properties of a key; `None` past the last one.
    fn info(&self, index: usize) -> Option<&'static KeyInfo>;
    /// Returns the kind of quantity of a key that depends on another key.
    fn dependent_quantity(&self, index: usize) -> Option<Quantity>;
    /// Returns the value of a key.
    fn get(&self, index: usize) -> ValueRef<'_>;
    /// Returns the value of a key for writing.
    fn open(&mut self, index: usize) -> ValueMut<'_>;
    /// Writes a number, a whole number too.
    fn set_number(&mut self, index: usize, value: f64);
    /// Writes a text; other keys are left alone.
    fn set_text(&mut self, index: usize, text: &str);
    /// Returns a blank element of the same type.
    fn boxed_blank(&self) -> Box<dyn Element>;
}

/// Value of a key, as its [`Slot`].
pub(crate) enum ValueRef<'e> {
    Number(f64),
    Derived(f64),
    Optional(Option<f64>),
    Count(usize),
    Text(String),
    Texts(&'e [String]),
    Numbers(&'e [f64]),
    DerivedNumbers { of: &'static str, list: &'e [f64] },
    NamedQuantities(&'e BTreeMap<String, f64>),
    NamedNumbers(&'e BTreeMap<String, Vec<f64>>),
    Table(&'e dyn Element),
    Things(&'e dyn Elements),
}

/// Value of a key for writing.
pub(crate) enum ValueMut<'e> {
    /// By [`Element::set_number`].
    Number,
    /// By [`Element::set_text`].
    Text,
    Texts(&'e mut Vec<String>),
    Numbers(&'e mut Vec<f64>),
    NamedQuantities(&'e mut BTreeMap<String, f64>),
    NamedNumbers(&'e mut BTreeMap<String, Vec<f64>>),
    Table(&'e mut dyn Element),
    Things(&'e mut dyn Elements),
}

impl<T: Keyed> Element for T {
    fn info(&self, index: usize) -> Option<&'static KeyInfo> {
        T::KEYS.get(index).map(|key| &key.info)
    }

    fn dependent_quantity(&self, index: usize) -> Option<Quantity> {
        T::KEYS[index].quantity.and_then(|quantity| quantity(self))
    }

    fn get(&self, index: usize) -> ValueRef<'_> {
        match T::KEYS[index].slot {
            Slot::Number { get, .. } => ValueRef::Number(get(self)),
            Slot::Derived { get, .. } => ValueRef::Derived(get(self)),
            Slot::Optional { get, .. } => ValueRef::Optional(get(self)),
            Slot::Count { get, .. } => ValueRef::Count(get(self)),
            Slot::Text { get, .. } => ValueRef::Text(get(self)),
            Slot::Texts { get, .. } => ValueRef::Texts(get(self)),
            Slot::Numbers { get, .. } => ValueRef::Numbers(get(self)),
            Slot::DerivedNumbers { of, get, .. } => {
                let list = get(self);
                ValueRef::DerivedNumbers { of, list }
            }
            Slot::NamedQuantities { get, .. } => ValueRef::NamedQuantities(get(self)),
            Slot::NamedNumbers { get, .. } => ValueRef::NamedNumbers(get(self)),
            Slot::Table { get, .. } => ValueRef::Table(get(self)),
            Slot::Things { get, .. } => ValueRef::Things(get(self)),
        }
    }

    fn open(&mut self, index: usize) -> ValueMut<'_> {
        match T::KEYS[index].slot {
            Slot::Number { .. }
            | Slot::Derived { .. }
            | Slot::Optional { .. }
            | Slot::Count { .. } => ValueMut::Number,
            Slot::Text { .. } => ValueMut::Text,
            Slot::Texts { open, .. } => ValueMut::Texts(open(self)),
            Slot::Numbers { open, .. } | Slot::DerivedNumbers { open, .. } => {
                ValueMut::Numbers(open(self))
            }
            Slot::NamedQuantities { open, .. } => ValueMut::NamedQuantities(open(self)),
            Slot::NamedNumbers { open, .. } => ValueMut::NamedNumbers(open(self)),
            Slot::Table { open, .. } => ValueMut::Table(open(self)),
            Slot::Things { open, .. } => ValueMut::Things(open(self)),
        }
    }

    fn set_number(&mut self, index: usize, value: f64) {
        match T::KEYS[index].slot {
            Slot::Number { set, .. } | Slot::Derived { set, .. } | Slot::Optional { set, .. } => {
                set(self, value)
            }
            Slot::Count { set, .. } => set(self, value as usize),
            _ => {}
        }
    }

    fn set_text(&mut self, index: usize, text: &str) {
        if let Slot::Text { set, .. } = T::KEYS[index].slot {
            set(self, text);
        }
    }

    fn boxed_blank(&self) -> Box<dyn Element> {
        Box::new(T::blank())
    }
}

impl dyn Element + '_ {
    /// Returns the numbers of the keys and their properties.
    pub(crate) fn keys(&self) -> impl Iterator<Item = (usize, &'static KeyInfo)> {
        (0..).map_while(|index| Some((index, self.info(index)?)))
    }

    /// Returns the first key of a name.
    pub(crate) fn first(&self, name: &str) -> Option<(usize, &'static KeyInfo)> {
        self.keys().find(|(_, info)| info.name == name)
    }

    /// Returns the first key of a name that applies to the choices of the element.
    pub(crate) fn applicable(&self, name: &str) -> Option<(usize, &'static KeyInfo)> {
        self.keys()
            .find(|(_, info)| info.name == name && self.applies(info))
    }

    /// Returns the kind of a key in this element.
    pub(crate) fn kind(&self, index: usize, info: &KeyInfo) -> Kind {
        self.dependent_quantity(index)
            .map_or(info.kind, Kind::Quantity)
    }

    /// Returns the word of a choice.
    pub(crate) fn chosen(&self, choice: &str) -> Option<String> {
        match self.get(self.first(choice)?.0) {
            ValueRef::Text(word) => Some(word),
            _ => None,
        }
    }

    /// True if a key applies to the choices of the element.
    pub(crate) fn applies(&self, info: &KeyInfo) -> bool {
        info.when.is_none_or(|when| {
            self.chosen(when.key)
                .is_some_and(|word| when.is.contains(&word.as_str()))
        })
    }
}

/// Elements of one type by their names.
pub(crate) trait Elements {
    /// Calls a function with each of them, in the order of their names.
    fn for_each(&self, call: &mut dyn FnMut(&str, &dyn Element));
    /// Returns one of them.
    fn get(&self, name: &str) -> Option<&dyn Element>;
    /// Returns one of them for writing.
    fn get_mut(&mut self, name: &str) -> Option<&mut dyn Element>;
    /// Returns an element for writing, a blank one if there is none of this name.
    fn open(&mut self, name: &str) -> &mut dyn Element;
    /// Returns a blank element.
    fn boxed_blank(&self) -> Box<dyn Element>;
}

impl<T: Keyed> Elements for BTreeMap<String, T> {
    fn for_each(&self, call: &mut dyn FnMut(&str, &dyn Element)) {
        for (name, element) in self {
            call(name, element);
        }
    }

    fn get(&self, name: &str) -> Option<&dyn Element> {
        self.get(name).map(|element| element as &dyn Element)
    }

    fn get_mut(&mut self, name: &str) -> Option<&mut dyn Element> {
        self.get_mut(name)
            .map(|element| element as &mut dyn Element)
    }

    fn open(&mut self, name: &str) -> &mut dyn Element {
        self.entry(name.to_owned()).or_insert_with(T::blank)
    }

    fn boxed_blank(&self) -> Box<dyn Element> {
        Box::new(T::blank())
    }
}
