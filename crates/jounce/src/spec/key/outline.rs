//! The table of keys without the types behind it, for what only looks at names, kinds and docs.

use super::{Key, KeyInfo, Kind, Need, Slot};

/// One key and what lies below it.
pub(in crate::spec) struct Row {
    pub(in crate::spec) info: KeyInfo,
    /// The default as it would be written; `None` where there is none.
    pub(in crate::spec) default: Option<String>,
    /// Keys of the table within, if it is one.
    pub(in crate::spec) inner: Vec<Row>,
}

/// The rows of a table of keys; defaults are what the blank thing holds, after the choice without which a key does not go.
pub(in crate::spec) fn rows<T>(keys: &[Key<T>], blank: impl Fn() -> T) -> Vec<Row> {
    let chosen = |key: &Key<T>| {
        let mut thing = blank();
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
            set(&mut thing, word);
        }
        thing
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
