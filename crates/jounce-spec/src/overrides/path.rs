//! Paths of the keys that a file can have.

use crate::Spec;
use crate::key::{KeyInfo, Kind, Row, rows};
use crate::nearest::{clip, join_words, nearest};
use crate::numeric_key::{beyond, list_index};
use crate::read::join;
use crate::source::{Node, Value};

/// Largest number of keys in which the nearest key is searched.
const MAX_COMPARED_PATHS: usize = 5000;

/// True for the path of a table: of settings, of elements, of one element, or of named values.
pub(super) fn is_table(path: &[String]) -> bool {
    is_table_in(&rows(&Spec::default()), path)
}

fn is_table_in(rows: &[Row], path: &[String]) -> bool {
    let Some((name, rest)) = path.split_first() else {
        return false;
    };
    let Some(row) = rows.iter().find(|row| row.info.name == *name) else {
        return false;
    };
    match (row.info.kind, rest) {
        (Kind::Table | Kind::Things | Kind::NamedQuantities(_) | Kind::NamedNumbers, []) => true,
        (Kind::Things, [_]) => true,
        (Kind::Table, rest) | (Kind::Things, [_, rest @ ..]) => is_table_in(&row.inner, rest),
        _ => false,
    }
}

/// Returns the keys that the key at a path excludes, from every rule of its table that names it.
pub(super) fn excluded(path: &[String]) -> Vec<&'static str> {
    excluded_in(&rows(&Spec::default()), path)
}

fn excluded_in(rows: &[Row], path: &[String]) -> Vec<&'static str> {
    let Some((name, rest)) = path.split_first() else {
        return Vec::new();
    };
    if rest.is_empty() {
        let rules = rows.iter().map(|row| row.info.need.alternatives());
        let rules = rules.filter(|names| names.contains(&name.as_str()));
        return rules
            .flatten()
            .copied()
            .filter(|other| other != name)
            .collect();
    }
    let row = rows.iter().find(|row| row.info.name == *name);
    match row.map(|row| (row.info.kind, &row.inner, rest)) {
        Some((Kind::Table, inner, rest) | (Kind::Things, inner, [_, rest @ ..])) => {
            excluded_in(inner, rest)
        }
        _ => Vec::new(),
    }
}

/// Returns the key at a path if the elements on the path exist in the file.
pub(crate) fn resolve(root: &Node, key: &str) -> Result<KeyInfo, String> {
    let top = rows(&Spec::default());
    let segments: Vec<&str> = key.split('.').collect();
    walk(&top, Some(root), &segments, "").map_err(|path_error| {
        let reason = match path_error {
            PathError::InList(reason) => return format!("{}: {reason}", clip(key)),
            PathError::Key(reason) => reason,
        };
        let mut known = Vec::new();
        paths(&top, Some(root), "", &mut known);
        let known: Vec<&str> = known.iter().map(String::as_str).collect();
        let suggestion = nearest(key, &known)
            .or_else(|| with_parts(&segments, &known))
            .map(|near| format!("; the nearest key here is `{near}`"));
        format!("{}: {reason}{}", clip(key), suggestion.unwrap_or_default())
    })
}

/// Returns the only path that has these parts in their order, as `stop.tip.gap` for `stop.gap`.
fn with_parts<'k>(parts: &[&str], paths: &[&'k str]) -> Option<&'k str> {
    let has_parts = |path: &&&str| {
        let mut of_path = path.split('.');
        let mut found = parts.iter().map(|part| of_path.any(|other| other == *part));
        path.ends_with(parts[parts.len() - 1]) && found.all(|is_found| is_found)
    };
    let mut matches = paths.iter().filter(has_parts);
    let first = *matches.next()?;
    matches.next().is_none().then_some(first)
}

/// Reason why a path has no key.
enum PathError {
    /// No key has this name; the nearest one may be meant.
    Key(String),
    /// The list has no such number.
    InList(String),
}

impl From<String> for PathError {
    fn from(reason: String) -> Self {
        Self::Key(reason)
    }
}

/// Follows a path through the table of keys and the elements of the file.
fn walk(
    rows: &[Row],
    node: Option<&Node>,
    path: &[&str],
    walked: &str,
) -> Result<KeyInfo, PathError> {
    let parent_path = if walked.is_empty() {
        "here".to_owned()
    } else {
        format!("in {walked}")
    };
    let Some((name, rest)) = path.split_first() else {
        return Err(format!(
            "{walked} is a table; its keys: {}",
            join_words(&names(rows))
        )
        .into());
    };
    let Some(row) = rows.iter().find(|row| row.info.name == *name) else {
        return Err(format!(
            "unknown key; keys {parent_path}: {}",
            join_words(&names(rows))
        )
        .into());
    };
    let below = node
        .and_then(|node| node.get(name))
        .map(|entry| &entry.node);
    let walked = join(walked, name);
    match (row.info.kind, rest) {
        (Kind::Table, rest) => walk(&row.inner, below, rest, &walked),
        (Kind::Things, []) => Err(format!(
            "{walked} is a table of named elements; add the name of one and a key"
        )
        .into()),
        (Kind::Things, [element, rest @ ..]) => {
            let Some(child) = below.and_then(|below| below.get(element)) else {
                return Err(no_element(&walked, element, below).into());
            };
            walk(&row.inner, Some(&child.node), rest, &join(&walked, element))
        }
        (Kind::NamedQuantities(_) | Kind::NamedNumbers, [_]) => Ok(row.info),
        (Kind::Numbers | Kind::Quantities(_), [number]) => {
            in_list(row.info, below, number, &walked)
        }
        (Kind::NamedNumbers, [name, number]) => {
            let list = below
                .and_then(|below| below.get(name))
                .map(|entry| &entry.node);
            in_list(row.info, list, number, &join(&walked, name))
        }
        (Kind::NamedQuantities(_) | Kind::NamedNumbers, _) => {
            Err(format!("{walked} is a table of named values; add the name of one").into())
        }
        (_, []) => Ok(row.info),
        (_, _) => Err(format!("{walked} is a single value and has no keys").into()),
    }
}

fn names(rows: &[Row]) -> Vec<&'static str> {
    rows.iter().map(|row| row.info.name).collect()
}

/// Describes a missing element, with those of the file.
fn no_element(walked: &str, element: &str, below: Option<&Node>) -> String {
    let entries = below.and_then(Node::entries).unwrap_or_default();
    let names: Vec<&str> = entries.iter().map(|entry| entry.name.as_str()).collect();
    let mut names = join_words(&names);
    if names.is_empty() {
        "none".clone_into(&mut names);
    }
    format!(
        "this file has no [{walked}.{}]; it has: {names}",
        clip(element)
    )
}

/// Returns one number of a list of the file.
fn in_list(
    info: KeyInfo,
    list: Option<&Node>,
    number: &str,
    walked: &str,
) -> Result<KeyInfo, PathError> {
    match list.map(|list| &list.value) {
        Some(Value::List(items)) if items.is_empty() => {
            Err(PathError::InList(format!("{walked} is empty")))
        }
        Some(Value::List(items)) => match list_index(number).filter(|index| *index < items.len()) {
            Some(_) => Ok(KeyInfo {
                kind: info.kind.of_one(),
                ..info
            }),
            None => Err(PathError::InList(beyond(walked, items.len()))),
        },
        Some(_) => Err(PathError::InList(format!(
            "{walked} is not a list of numbers in this file"
        ))),
        None => Err(PathError::InList(format!(
            "this file has no {walked}; set the complete list first"
        ))),
    }
}

/// Collects every key that the elements of a file have or may have.
fn paths(rows: &[Row], node: Option<&Node>, prefix: &str, out: &mut Vec<String>) {
    for row in rows {
        if out.len() > MAX_COMPARED_PATHS {
            return;
        }
        let path = join(prefix, row.info.name);
        let below = node
            .and_then(|node| node.get(row.info.name))
            .map(|entry| &entry.node);
        let entries = below.and_then(Node::entries).unwrap_or_default();
        match row.info.kind {
            Kind::Table => paths(&row.inner, below, &path, out),
            Kind::Things => entries.iter().for_each(|entry| {
                paths(
                    &row.inner,
                    Some(&entry.node),
                    &join(&path, &entry.name),
                    out,
                )
            }),
            Kind::NamedQuantities(_) | Kind::NamedNumbers => {
                out.extend(entries.iter().map(|entry| join(&path, &entry.name)))
            }
            _ => out.push(path),
        }
    }
}
