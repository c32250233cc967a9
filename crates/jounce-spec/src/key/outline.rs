//! Table of keys without the underlying types, for uses that need only names, kinds and docs.

use super::{Key, KeyInfo, Kind, Need, Slot};

/// A key and its nested keys.
pub(crate) struct Row {
    pub(crate) info: KeyInfo,
    /// Default as it would be written; `None` if there is none.
    pub(crate) default: Option<String>,
    /// Keys of the nested table, if the key is a table.
    pub(crate) inner: Vec<Row>,
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
    };
    keys.iter().map(row).collect()
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
        | Slot::NamedQuantities { .. }
        | Slot::NamedNumbers { .. }
        | Slot::Inner(_) => None,
    }
}
