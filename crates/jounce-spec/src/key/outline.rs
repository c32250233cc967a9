//! Table of keys without the underlying types, for uses that need only names, kinds and docs.

use super::{Element, KeyInfo, Kind, Need, ValueRef};
use crate::Quantity;

/// A key and its nested keys.
pub(crate) struct Row {
    pub(crate) info: KeyInfo,
    /// Default as it would be written; `None` if there is none.
    pub(crate) default: Option<String>,
    /// Keys of the nested table, if the key is a table.
    pub(crate) inner: Vec<Row>,
    /// Kind of quantity for each word of the key that it depends on, if that is a choice.
    by_word: Vec<(&'static str, Quantity)>,
}

impl Row {
    /// Returns the kind of quantity for a word of the choice that it depends on.
    pub(crate) fn quantity_of_word(&self, choice: &str, word: &str) -> Option<Quantity> {
        let is_by_choice = self.info.measured_by == Some(choice);
        let mut quantities = self.by_word.iter();
        let found = quantities.find(|(other, _)| is_by_choice && *other == word);
        found.map(|(_, quantity)| *quantity)
    }
}

/// Returns the rows of the table of keys of an element. Defaults are those of the blank element,
/// after the choice that the key depends on.
pub(crate) fn rows(element: &dyn Element) -> Vec<Row> {
    let keys = element.keys();
    keys.map(|(index, info)| row(element.boxed_blank(), index, info))
        .collect()
}

fn row(mut blank: Box<dyn Element>, index: usize, info: &KeyInfo) -> Row {
    if let Some(when) = info.when
        && let (Some((choice, _)), Some(word)) = (blank.first(when.key), when.is.first())
    {
        blank.set_text(choice, word);
    }
    let is_optional = info.need == Need::Default;
    Row {
        info: *info,
        default: default(blank.get(index), info.kind).filter(|_| is_optional),
        inner: match blank.get(index) {
            ValueRef::Table(inner) => rows(inner),
            ValueRef::Things(inner) => rows(&*inner.boxed_blank()),
            _ => Vec::new(),
        },
        by_word: quantities_by_word(blank, index, info),
    }
}

/// Returns the kind of quantity of a key for each word of the choice that it depends on.
fn quantities_by_word(
    mut element: Box<dyn Element>,
    index: usize,
    info: &KeyInfo,
) -> Vec<(&'static str, Quantity)> {
    let mut quantities = Vec::new();
    if let Some((choice, by)) = info.measured_by.and_then(|by| element.first(by))
        && let Kind::Choice(words) = by.kind
    {
        for word in words {
            element.set_text(choice, word);
            let quantity = element.dependent_quantity(index);
            quantities.extend(quantity.map(|quantity| (*word, quantity)));
        }
    }
    quantities
}

fn default(value: ValueRef<'_>, kind: Kind) -> Option<String> {
    let number = |value: f64| match kind {
        Kind::Quantity(quantity) => format!("\"{}\"", quantity.write(value)),
        kind => kind.show(value),
    };
    match value {
        ValueRef::Number(value) | ValueRef::Derived(value) => Some(number(value)),
        ValueRef::Optional(value) => value.map(number),
        ValueRef::Count(count) => Some(count.to_string()),
        ValueRef::Text(text) => (!text.is_empty()).then(|| format!("\"{text}\"")),
        _ => None,
    }
}
