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

/// The rows of a table of keys; defaults are what the blank thing holds.
pub(in crate::spec) fn rows<T>(keys: &[Key<T>], blank: &T) -> Vec<Row> {
    let row = |key: &Key<T>| Row {
        info: key.info,
        default: if key.info.need == Need::Default { default(key, blank) } else { None },
        inner: if let Slot::Inner(inner) = &key.slot { inner.rows() } else { Vec::new() },
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
        Slot::Text { get, .. } => Some(get(blank)).filter(|text| !text.is_empty()).map(|text| format!("\"{text}\"")),
        Slot::Texts { .. } | Slot::Numbers { .. } | Slot::NamedQuantities { .. } | Slot::NamedNumbers { .. } | Slot::Inner(_) => None,
    }
}
