//! A value of a spec and its place.

use toml_edit::{Item, TableLike};

use crate::nearest::clip;
use crate::numeric_key::list_index;

/// Place of a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SourcePlace {
    /// Offset in the text, bytes.
    At(usize),
    /// Override with this index.
    Set(usize),
    /// The file has no such table.
    Nowhere,
}

/// A value and its place.
#[derive(Debug, Clone)]
pub(crate) struct Node {
    pub(crate) position: SourcePlace,
    /// Number as written; empty for other values.
    pub(crate) raw: String,
    pub(crate) value: Value,
}

/// Value of a TOML document.
#[derive(Debug, Clone)]
pub(crate) enum Value {
    Text(String),
    Integer(i64),
    Float(f64),
    Boolean,
    Date,
    List(Vec<Node>),
    Table(Vec<Entry>),
    /// `[[NAME]]`
    Tables,
}

/// A key and its value.
#[derive(Debug, Clone)]
pub(crate) struct Entry {
    pub(crate) name: String,
    /// Place of the key.
    pub(crate) position: SourcePlace,
    pub(crate) node: Node,
}

impl Entry {
    /// Returns the entry under another name.
    pub(crate) fn renamed(&self, name: &str) -> Self {
        Self {
            name: name.to_owned(),
            ..self.clone()
        }
    }
}

impl Node {
    /// Returns the keys, if this is a table.
    pub(crate) fn entries(&self) -> Option<&[Entry]> {
        if let Value::Table(entries) = &self.value {
            Some(entries)
        } else {
            None
        }
    }

    /// Returns the value under a key, if this is a table that has it.
    pub(crate) fn get(&self, name: &str) -> Option<&Entry> {
        self.entries()?.iter().find(|entry| entry.name == name)
    }

    /// Returns the value under a path of tables.
    pub(crate) fn find(&self, path: &[String]) -> Option<&Self> {
        path.iter()
            .try_fold(self, |node, name| Some(&node.get(name)?.node))
    }

    /// Stores a value under a path. Missing tables are created; elements of a list are counted from
    /// 1. False if another value blocks the path.
    pub(crate) fn put(&mut self, path: &[&str], node: Node) -> bool {
        let Some((name, rest)) = path.split_first() else {
            return false;
        };
        let entries = match &mut self.value {
            Value::Table(entries) => entries,
            Value::List(items) => {
                let list_index = list_index(name).filter(|_| rest.is_empty());
                return list_index
                    .and_then(|list_index| items.get_mut(list_index))
                    .map(|item| *item = node)
                    .is_some();
            }
            _ => return false,
        };
        let index = entries
            .iter()
            .position(|entry| entry.name == *name)
            .unwrap_or_else(|| {
                let empty = Node {
                    position: node.position,
                    raw: String::new(),
                    value: Value::Table(Vec::new()),
                };
                entries.push(Entry {
                    name: (*name).to_owned(),
                    position: node.position,
                    node: empty,
                });
                entries.len() - 1
            });
        if rest.is_empty() {
            entries[index] = Entry {
                name: (*name).to_owned(),
                position: node.position,
                node,
            };
            return true;
        }
        entries[index].node.put(rest, node)
    }

    /// Removes a key, if it exists.
    pub(crate) fn remove(&mut self, path: &[&str]) {
        let Value::Table(entries) = &mut self.value else {
            return;
        };
        match path {
            [] => {}
            [name] => entries.retain(|entry| entry.name != *name),
            [name, rest @ ..] => entries
                .iter_mut()
                .filter(|entry| entry.name == *name)
                .for_each(|entry| entry.node.remove(rest)),
        }
    }

    /// Returns a description of the value: `the number 5`.
    pub(crate) fn found(&self) -> String {
        match &self.value {
            Value::Text(text) => format!("the text \"{}\"", clip(text)),
            Value::Integer(_) | Value::Float(_) => format!("the number {}", clip(&self.raw)),
            Value::Boolean => clip(&self.raw),
            Value::Date => "a date".to_owned(),
            Value::List(_) => "a list".to_owned(),
            Value::Table(_) => "a table".to_owned(),
            Value::Tables => "a list of tables".to_owned(),
        }
    }
}

/// Returns a table with the places of its keys; `parent` is the place of entries without one.
pub(super) fn entries(text: &str, table: &dyn TableLike, parent: usize) -> Vec<Entry> {
    let entry = |(name, item): (&str, &Item)| {
        let key = table.get_key_value(name).and_then(|(key, _)| key.span());
        let at = key
            .or_else(|| item.span())
            .map_or(parent, |span| span.start);
        Entry {
            name: name.to_owned(),
            position: SourcePlace::At(at),
            node: node(text, item, at),
        }
    };
    table.iter().map(entry).collect()
}

fn node(text: &str, item: &Item, parent: usize) -> Node {
    match item {
        Item::Value(value) => value_of(text, value, parent),
        Item::Table(table) => Node::at(parent, Value::Table(entries(text, table, parent))),
        Item::ArrayOfTables(_) | Item::None => Node::at(parent, Value::Tables),
    }
}

/// Returns a value with its places.
pub(crate) fn value_of(text: &str, value: &toml_edit::Value, parent: usize) -> Node {
    let span = value.span().unwrap_or(parent..parent);
    let raw = || text.get(span.clone()).unwrap_or_default().to_owned();
    match value {
        toml_edit::Value::String(text) => Node::at(span.start, Value::Text(text.value().clone())),
        toml_edit::Value::Integer(number) => Node {
            raw: raw(),
            ..Node::at(span.start, Value::Integer(*number.value()))
        },
        toml_edit::Value::Float(number) => Node {
            raw: raw(),
            ..Node::at(span.start, Value::Float(*number.value()))
        },
        toml_edit::Value::Boolean(_) => Node {
            raw: raw(),
            ..Node::at(span.start, Value::Boolean)
        },
        toml_edit::Value::Datetime(_) => Node::at(span.start, Value::Date),
        toml_edit::Value::Array(list) => Node::at(
            span.start,
            Value::List(
                list.iter()
                    .map(|value| value_of(text, value, span.start))
                    .collect(),
            ),
        ),
        toml_edit::Value::InlineTable(table) => {
            Node::at(span.start, Value::Table(entries(text, table, span.start)))
        }
    }
}

impl Node {
    /// Returns a value at an offset of the text.
    pub(crate) fn at(offset: usize, value: Value) -> Self {
        Self {
            position: SourcePlace::At(offset),
            raw: String::new(),
            value,
        }
    }
}
