//! Overrides: `--set KEY=VALUE`.

use std::fmt;

use toml_edit::{DocumentMut, Item, TableLike};

use super::key::{KeyInfo, Kind, Row, rows};
use super::keys::SPEC;
use super::nearest::{clip, join_words, nearest};
use super::numeric_key::{beyond, list_index};
use super::source::{Node, SourcePlace, Value, value_of};
use super::{Spec, read::join};

/// Largest number of keys in which the nearest key is searched.
const MAX_COMPARED_PATHS: usize = 5000;

/// An override of one key.
#[derive(Debug, Clone)]
pub(super) struct Override {
    path: Vec<String>,
    value: String,
    node: Node,
    /// Keys of the same table that this key excludes.
    excludes: &'static [&'static str],
}

impl Override {
    /// Returns an override of a known key.
    pub(super) fn new(key: &str, value: &str, info: &KeyInfo, index: usize) -> Self {
        let mut node = read_value(value);
        let wants_text = matches!(
            info.kind,
            Kind::ChoiceOrPath(_)
                | Kind::Path
                | Kind::Text
                | Kind::Choice(_)
                | Kind::Reference { .. }
        );
        if wants_text && !matches!(node.value, Value::Text(_)) {
            node.value = Value::Text(value.to_owned());
        }
        move_to(&mut node, SourcePlace::Set(index));
        let excludes = info.need.alternatives();
        Self {
            path: key.split('.').map(str::to_owned).collect(),
            value: value.to_owned(),
            node,
            excludes,
        }
    }

    /// Returns the override as it was written.
    pub(super) fn quoted_value(key: &str, value: &str) -> String {
        format!("--set {}={}", clip(key), clip(value))
    }

    /// Applies the override to a tree.
    pub(super) fn apply(&self, root: &mut Node) {
        let path: Vec<&str> = self.path.iter().map(String::as_str).collect();
        if let Some((name, parents)) = path.split_last() {
            for other in self.excludes.iter().filter(|other| *other != name) {
                root.remove(&[parents, &[*other]].concat());
            }
        }
        root.put(&path, self.node.clone());
    }

    /// Writes the override into a document, in the layout of the previous value.
    pub(super) fn write_into(&self, document: &mut DocumentMut) {
        let Some((name, parents)) = self.path.split_last() else {
            return;
        };
        let mut table: &mut dyn TableLike = document.as_table_mut();
        for parent in parents {
            let item = table.entry(parent).or_insert_with(toml_edit::table);
            if let Some(list) = item.as_array_mut() {
                if let Some(index) = list_index(name).filter(|index| *index < list.len()) {
                    list.replace(index, self.written());
                }
                return;
            }
            let Some(below) = item.as_table_like_mut() else {
                return;
            };
            table = below;
        }
        for other in self.excludes.iter().filter(|other| *other != name) {
            table.remove(other);
        }
        let mut value = self.written();
        if let Some(old) = table.get(name).and_then(Item::as_value) {
            *value.decor_mut() = old.decor().clone();
        }
        table.insert(name, Item::Value(value));
    }

    fn written(&self) -> toml_edit::Value {
        match &self.node.value {
            Value::Text(text) => toml_edit::Value::from(text.as_str()),
            _ => self
                .value
                .trim()
                .parse()
                .unwrap_or_else(|_| toml_edit::Value::from(self.value.as_str())),
        }
    }
}

impl fmt::Display for Override {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(&Self::quoted_value(&self.path.join("."), &self.value))
    }
}

/// Parses a value of a command line: as TOML if valid, otherwise as text.
fn read_value(value: &str) -> Node {
    let line = format!("v = {}", value.trim());
    let parsed = toml_edit::Document::parse(line.as_str())
        .ok()
        .filter(|document| !value.contains('\n') && document.len() == 1);
    let node = parsed.as_ref().and_then(|document| {
        document
            .get("v")?
            .as_value()
            .map(|text_value| value_of(&line, text_value, 0))
    });
    node.unwrap_or_else(|| Node::at(0, Value::Text(value.to_owned())))
}

fn move_to(node: &mut Node, position: SourcePlace) {
    node.position = position;
    match &mut node.value {
        Value::List(items) => items.iter_mut().for_each(|item| move_to(item, position)),
        Value::Table(entries) => entries.iter_mut().for_each(|entry| {
            entry.position = position;
            move_to(&mut entry.node, position);
        }),
        _ => {}
    }
}

/// Returns the key at a path if the elements on the path exist in the file.
pub(super) fn resolve(root: &Node, key: &str) -> Result<KeyInfo, String> {
    let top = rows(SPEC, Spec::default);
    let segments: Vec<&str> = key.split('.').collect();
    walk(&top, Some(root), &segments, "").map_err(|path_error| {
        let reason = match path_error {
            PathError::InList(reason) => return format!("{}: {reason}", clip(key)),
            PathError::Key(reason) => reason,
        };
        let mut known = Vec::new();
        paths(&top, Some(root), "", &mut known);
        let suggestion = nearest(key, known.iter().map(String::as_str))
            .map(|near| format!("; the nearest key here is `{near}`"));
        format!("{}: {reason}{}", clip(key), suggestion.unwrap_or_default())
    })
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
            join_words(rows.iter().map(|row| row.info.name))
        )
        .into());
    };
    let Some(row) = rows.iter().find(|row| row.info.name == *name) else {
        return Err(format!(
            "unknown key; keys {parent_path}: {}",
            join_words(rows.iter().map(|row| row.info.name))
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
        (Kind::Numbers, [number]) => in_list(row.info, below, number, &walked),
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

/// Describes a missing element, with those of the file.
fn no_element(walked: &str, element: &str, below: Option<&Node>) -> String {
    let entries = below.and_then(Node::entries).unwrap_or_default();
    let mut names = join_words(entries.iter().map(|entry| entry.name.as_str()));
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
                kind: Kind::Number,
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
