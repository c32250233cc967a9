//! Overrides: `--set KEY=VALUE`, and `--set KEY=` to remove a key.

use std::fmt;

use toml_edit::{DocumentMut, Item, TableLike};

use crate::key::Kind;
use crate::nearest::clip;
use crate::numeric_key::list_index;
use crate::source::{Node, SourcePlace, Value, value_of};

mod layout;
mod path;

pub(crate) use path::resolve;

/// An override of one key or one table.
#[derive(Debug, Clone)]
pub(crate) struct Override {
    path: Vec<String>,
    value: String,
    /// The new value; `None` removes the key.
    node: Option<Node>,
    /// Keys of the same table that this key excludes.
    excludes: Vec<&'static str>,
}

impl Override {
    /// Returns the override of a key of a tree. A value without characters removes the key.
    ///
    /// # Errors
    /// A key that the tree cannot have, with the nearest key.
    pub(crate) fn new(root: &Node, key: &str, value: &str, index: usize) -> Result<Self, String> {
        let path: Vec<String> = key.split('.').map(str::to_owned).collect();
        let mut node = (!value.trim().is_empty()).then(|| read_value(value));
        let is_table = match &node {
            Some(node) => node.entries().is_some(),
            None => root.find(&path).is_some(),
        };
        let mut excludes = Vec::new();
        if !(is_table && path::is_table(&path)) {
            let info = resolve(root, key)?;
            excludes = path::excluded(&path);
            match &mut node {
                Some(node) if wants_text(info.kind) && !matches!(node.value, Value::Text(_)) => {
                    node.value = Value::Text(value.to_owned());
                }
                None if in_a_list(root, &path) => {
                    return Err(format!(
                        "{}: one number of a list cannot be removed; set the complete list",
                        clip(key)
                    ));
                }
                _ => {}
            }
        }
        if let Some(node) = &mut node {
            move_to(node, SourcePlace::Set(index));
        }
        Ok(Self {
            path,
            value: value.to_owned(),
            node,
            excludes,
        })
    }

    /// Returns an override as an option of the command line.
    pub(crate) fn option_text(key: &str, value: &str) -> String {
        format!("--set {}={}", clip(key), clip(value))
    }

    /// Returns the key and its value as they were given.
    pub(crate) fn assignment(&self) -> (String, &str) {
        (self.path.join("."), &self.value)
    }

    /// Applies the override to a tree.
    pub(crate) fn apply(&self, root: &mut Node) {
        let path: Vec<&str> = self.path.iter().map(String::as_str).collect();
        let Some(node) = &self.node else {
            root.remove(&path);
            return;
        };
        if let Some((_, parents)) = path.split_last() {
            for other in &self.excludes {
                root.remove(&[parents, &[*other]].concat());
            }
        }
        root.put(&path, node.clone());
    }

    /// Writes the override into a document, in the layout of the previous value.
    pub(crate) fn write_into(&self, document: &mut DocumentMut) {
        let Some((name, parents)) = self.path.split_last() else {
            return;
        };
        let mut table: &mut dyn TableLike = document.as_table_mut();
        for parent in parents {
            let item = match self.node {
                Some(_) => table
                    .entry(parent)
                    .or_insert_with(|| Item::Table(layout::implicit_table())),
                None => match table.get_mut(parent) {
                    Some(item) => item,
                    None => return,
                },
            };
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
        if self.node.is_none() {
            table.remove(name);
            return;
        }
        for other in &self.excludes {
            table.remove(other);
        }
        let item = layout::replacement(self.written(), table.get(name));
        table.insert(name, item);
    }

    fn written(&self) -> toml_edit::Value {
        match self.node.as_ref().map(|node| &node.value) {
            Some(Value::Text(text)) => toml_edit::Value::from(text.as_str()),
            _ => self
                .value
                .trim()
                .parse()
                .unwrap_or_else(|_| toml_edit::Value::from(self.value.as_str())),
        }
    }
}

/// True for keys whose value is text, with or without quotes.
fn wants_text(kind: Kind) -> bool {
    matches!(
        kind,
        Kind::ChoiceOrPath(_) | Kind::Path | Kind::Text | Kind::Choice(_) | Kind::Reference { .. }
    )
}

/// True for the path of a number in a list.
fn in_a_list(root: &Node, path: &[String]) -> bool {
    let list = path.split_last().and_then(|(_, list)| root.find(list));
    list.is_some_and(|list| matches!(list.value, Value::List(_)))
}

impl fmt::Display for Override {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (key, value) = self.assignment();
        out.write_str(&Self::option_text(&key, value))
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
