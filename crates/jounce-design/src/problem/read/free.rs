//! Free keys.

use super::choices::choices;
use super::conditions::Changes;
use crate::problem::{Condition, FreeKey, FreeRange, FreeValues};
use jounce_analysis::study::FaultCollector;
use jounce_spec::SpecFile;
use toml_edit::{Item, Table};

/// Largest number of free keys: a search over more is slower than its user.
const MAX_FREE: usize = 64;

/// Reads the free keys. A choice stands before the ranges that belong to it.
pub(super) fn free(
    reader: &mut FaultCollector,
    item: Option<&Item>,
    file: &SpecFile,
) -> Vec<FreeKey> {
    let table = reader.table("free", item);
    let Some(table) = table.filter(|table| !table.is_empty()) else {
        let message =
            "free names no key; write [free] and \"stop.tip.gap\" = \"0.2mm:3mm\" below it";
        reader.fault("free", item.and_then(Item::span), message);
        return Vec::new();
    };
    let mut all = Vec::new();
    for (path, item) in table {
        let read = match (item.as_str(), item.as_array()) {
            (Some(text), _) => FreeRange::read(file, path, text).map(|range| {
                vec![FreeKey {
                    path: path.to_owned(),
                    values: FreeValues::Range(Box::new(range)),
                    with: None,
                }]
            }),
            (None, Some(array)) => choices(file, path, array, all.len()),
            _ => Err(vec![format!(
                "free.{path} must be a text, as in \"0.2mm:3mm\", under the whole path as one key, or a list of choices"
            )]),
        };
        match read {
            Ok(free) => all.extend(free),
            Err(messages) => messages
                .into_iter()
                .for_each(|message| reader.fault(path, item.span(), message)),
        }
    }
    if all.len() > MAX_FREE {
        let message = format!(
            "free has {} keys; at most {MAX_FREE} are allowed",
            all.len()
        );
        reader.fault("free", item.and_then(Item::span), message);
    }
    all
}

/// Checks that no key is set twice: by two free keys, or by a free key and the conditions.
pub(super) fn check_paths(
    reader: &mut FaultCollector,
    root: &Table,
    free: &[FreeKey],
    conditions: &[Condition],
    changes: &Changes,
) {
    let numbers = conditions.iter().flat_map(|condition| &condition.values);
    let texts = changes.iter().flatten().map(|(path, _)| path.as_str());
    let by_conditions: Vec<&str> = numbers.map(|(key, _)| key.path()).chain(texts).collect();
    let mut set = Vec::new();
    for one in free {
        let paths = set_by(one);
        // The ranges of a choice belong to it, and several of its choices may have the same key.
        let owner = one.with.map_or(&one.path, |with| &free[with.free].path);
        for path in paths {
            let span = span_of(root, owner);
            let is_known = set.contains(&(path, owner));
            let other = set
                .iter()
                .find(|(known, by)| *known == path && *by != owner);
            if is_known {
                continue;
            }
            if other.is_some() {
                let message = format!(
                    "free.{path} is set twice: as a key and in the choices of another key; remove one of the two"
                );
                reader.fault(path, span, message);
            } else if by_conditions.contains(&path) {
                let message = format!(
                    "free.{path}: the conditions set this key, so that it cannot be free; remove it from [free] or from [[conditions]]"
                );
                reader.fault(path, span, message);
            }
            set.push((path, owner));
        }
    }
}

/// Returns the paths that a free key sets, each once.
fn set_by(free: &FreeKey) -> Vec<&str> {
    match &free.values {
        FreeValues::Range(_) => vec![&free.path],
        FreeValues::Choice(choices) => {
            let all = choices.iter().flat_map(|choice| &choice.values);
            let mut paths: Vec<&str> = all.map(|(path, _)| path.as_str()).collect();
            paths.sort_unstable();
            paths.dedup();
            paths
        }
    }
}

/// Returns the place of a free key in the text.
pub(super) fn span_of(root: &Table, path: &str) -> Option<std::ops::Range<usize>> {
    let table = root.get("free")?.as_table()?;
    table.key(path).and_then(toml_edit::Key::span)
}
