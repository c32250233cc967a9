//! Values whose choice is missing or wrong: `stiffness` without a `law`.
//!
//! The applicable row of the table of keys is unknown. A value is reported only if it is wrong for
//! every choice, or if its unit fits and its magnitude does not.

use super::value::{read_number, read_slot};
use super::{ReadState, join};
use crate::key::{Element, KeyInfo, Range, ValueMut};
use crate::nearest::join_words;
use crate::source::Entry;

/// Verdict of one row of the table of keys on a value.
enum RowVerdict {
    Good,
    /// The unit fits the row, but the magnitude is not allowed.
    Size(String),
    /// The row cannot read the value.
    Kind(String),
}

impl RowVerdict {
    fn size(&self) -> Option<&str> {
        match self {
            Self::Size(text) => Some(text),
            _ => None,
        }
    }

    fn kind(&self) -> Option<&str> {
        match self {
            Self::Kind(text) => Some(text),
            _ => None,
        }
    }
}

/// Reports the faults of a value of a key whose rows all depend on the choice `on`.
pub(super) fn check(
    on: &str,
    path: &str,
    entry: &Entry,
    element: &mut dyn Element,
    reading: &mut ReadState,
) {
    let keys = element.keys();
    let rows: Vec<_> = keys.filter(|(_, info)| info.name == entry.name).collect();
    let path = join(path, &entry.name);
    reading.positions.insert(path.clone(), entry.node.position);
    if let [row] = rows[..] {
        read_slot(row, &path, &entry.node, element, reading);
        return;
    }
    let verdicts: Vec<RowVerdict> = rows
        .iter()
        .map(|row| verdict(*row, entry, element))
        .collect();
    let good = rows
        .iter()
        .zip(&verdicts)
        .filter(|(_, verdict)| matches!(verdict, RowVerdict::Good))
        .map(|((_, info), _)| info);
    let words: Vec<&str> = good
        .filter_map(|info| info.when)
        .flat_map(|when| when.is.iter().copied())
        .collect();
    let mut kinds: Vec<&str> = verdicts.iter().filter_map(RowVerdict::kind).collect();
    kinds.dedup();
    match verdicts.iter().find_map(RowVerdict::size) {
        Some(text) if words.is_empty() => {
            reading.fault(entry.node.position, &path, || text.to_owned())
        }
        Some(text) => reading.fault(entry.node.position, &path, || {
            format!("{text}, except with {on} = {}", join_words(&words))
        }),
        None if words.is_empty() => {
            reading.fault(entry.node.position, &path, || kinds.join("; or "))
        }
        None => {}
    }
}

fn verdict(
    (index, info): (usize, &KeyInfo),
    entry: &Entry,
    element: &mut dyn Element,
) -> RowVerdict {
    if !matches!(element.open(index), ValueMut::Number) {
        return RowVerdict::Good;
    }
    let kind = element.kind(index, info);
    match (
        read_number(kind, Range::ANY, &entry.node),
        read_number(kind, info.range, &entry.node),
    ) {
        (_, Ok(_)) => RowVerdict::Good,
        (Ok(_), Err(text)) => RowVerdict::Size(text),
        (Err(text), Err(_)) => RowVerdict::Kind(text),
    }
}
