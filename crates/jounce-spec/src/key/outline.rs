//! Table of keys without the underlying types, for uses that need only names, kinds and docs.

use super::{Key, KeyInfo, Kind, Need, Slot};
use crate::Quantity;

/// A key and its nested keys.
pub(crate) struct Row {
    pub(crate) info: KeyInfo,
    /// Default as it would be written; `None` if there is none.
    pub(crate) default: Option<String>,
    /// Keys of the nested table, if the key is a table.
    pub(crate) inner: Vec<Row>,
    /// The key that the kind of quantity depends on.
    pub(crate) by: Option<&'static str>,
    /// Kind of quantity for each word of that key, if it is a choice.
    by_word: Vec<(&'static str, Quantity)>,
}

impl Row {
    /// Returns the kind of quantity for a word of the choice that it depends on.
    pub(crate) fn quantity_of_word(&self, choice: &str, word: &str) -> Option<Quantity> {
        let quantities = self.by_word.iter().filter(|_| self.by == Some(choice));
        quantities
            .filter(|(other, _)| *other == word)
            .map(|(_, quantity)| *quantity)
            .next()
    }
}

/// Returns the rows of a table of keys. Defaults are those of the blank element, after the choice
/// that the key depends on.
pub(crate) fn rows<T>(keys: &[Key<T>], blank: impl Fn() -> T) -> Vec<Row> {
    let chosen = |key: &Key<T>| {
        let mut element = blank();
        let choice = key.info.when.and_then(|when| {
            Some((
                keys.iter().find(|key| key.info.name == when.key)?,
                when.is.first()?,
            ))
        });
        if let Some((
            Key {
                slot: Slot::Text { set, .. },
                ..
            },
            word,
        )) = choice
        {
            set(&mut element, word);
        }
        element
    };
    let row = |key: &Key<T>| Row {
        info: key.info,
        default: if key.info.need == Need::Default {
            default(key, &chosen(key))
        } else {
            None
        },
        inner: if let Slot::Inner(inner) = &key.slot {
            inner.rows()
        } else {
            Vec::new()
        },
        by: key.quantity.as_ref().map(|quantity| quantity.by),
        by_word: quantities_by_word(keys, key, chosen(key)),
    };
    keys.iter().map(row).collect()
}

/// Returns the kind of quantity of a key for each word of the choice that it depends on.
fn quantities_by_word<T>(
    keys: &[Key<T>],
    key: &Key<T>,
    mut element: T,
) -> Vec<(&'static str, Quantity)> {
    let Some(dependent) = &key.quantity else {
        return Vec::new();
    };
    let choice = keys.iter().find(|other| other.info.name == dependent.by);
    let (Some(Kind::Choice(words)), Some(Slot::Text { set, .. })) =
        (choice.map(|key| key.info.kind), choice.map(|key| &key.slot))
    else {
        return Vec::new();
    };
    let mut quantities = Vec::new();
    for word in words {
        set(&mut element, word);
        if let Some(quantity) = (dependent.quantity)(&element) {
            quantities.push((*word, quantity));
        }
    }
    quantities
}

fn default<T>(key: &Key<T>, blank: &T) -> Option<String> {
    let number = |value: f64| match key.info.kind {
        Kind::Quantity(quantity) => format!("\"{}\"", quantity.write(value)),
        kind => kind.show(value),
    };
    match key.slot {
        Slot::Number { get, .. } | Slot::Derived { get, .. } => Some(number(get(blank))),
        Slot::Optional { get, .. } => get(blank).map(number),
        Slot::Count { get, .. } => Some(get(blank).to_string()),
        Slot::Text { get, .. } => Some(get(blank))
            .filter(|text| !text.is_empty())
            .map(|text| format!("\"{text}\"")),
        Slot::Texts { .. }
        | Slot::Numbers { .. }
        | Slot::DerivedNumbers { .. }
        | Slot::NamedQuantities { .. }
        | Slot::NamedNumbers { .. }
        | Slot::Inner(_) => None,
    }
}
