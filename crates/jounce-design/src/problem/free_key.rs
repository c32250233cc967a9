//! Free keys: ranges of numbers, and choices.

use super::FreeRange;
use jounce_spec::{Faults, Spec};
use toml_edit::{DocumentMut, Value};

/// A key that the search may set.
#[derive(Debug, Clone)]
pub struct FreeKey {
    /// Dotted path; for a choice of tables, that of the table.
    pub path: String,
    /// Allowed values.
    pub values: FreeValues,
    /// Choice with which the key is searched; `None` where it always is.
    pub with: Option<ChoiceIndex>,
}

/// A choice of a free key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ChoiceIndex {
    /// Index of the free key.
    pub free: usize,
    /// Index of its choice.
    pub choice: usize,
}

/// Allowed values of a free key.
#[derive(Debug, Clone)]
pub enum FreeValues {
    /// All numbers between two ends.
    Range(Box<FreeRange>),
    /// Some values, such as names of materials, or some tables of values.
    Choice(Vec<Choice>),
}

/// One of several choices: values that are set together.
#[derive(Debug, Clone, PartialEq)]
pub struct Choice {
    /// Dotted paths with their values, as `--set` takes them.
    pub values: Vec<(String, String)>,
}

impl Choice {
    /// Returns the choice as it is written below a path: a value, or a table.
    pub fn text(&self, path: &str) -> String {
        match &self.values[..] {
            [(own, value)] if own == path => value.clone(),
            values => table_text(path, values),
        }
    }
}

impl FreeKey {
    /// Returns the place of the value in a spec; `None` where the spec has another one than allowed.
    pub(crate) fn place(&self, spec: &Spec) -> Option<f64> {
        let place = match &self.values {
            FreeValues::Range(range) => range.place(range.key.get(spec).ok()?),
            FreeValues::Choice(choices) => {
                let has = |(path, value): &(String, String)| text_at(spec, path) == *value;
                let index = choices
                    .iter()
                    .position(|choice| choice.values.iter().all(has))?;
                (index as f64 + 0.5) / choices.len() as f64
            }
        };
        (0.0..=1.0).contains(&place).then_some(place)
    }

    /// Returns the number of choices; 1 for a range.
    pub(crate) fn choice_count(&self) -> usize {
        match &self.values {
            FreeValues::Choice(choices) => choices.len(),
            FreeValues::Range(_) => 1,
        }
    }

    /// Returns the index of the choice at a place; 0 for a range.
    pub(crate) fn choice(&self, place: f64) -> usize {
        match &self.values {
            FreeValues::Choice(choices) => {
                ((place * choices.len() as f64) as usize).min(choices.len() - 1)
            }
            FreeValues::Range(_) => 0,
        }
    }

    /// Returns the range if results have a derivative by the key.
    pub(crate) fn smooth(&self) -> Option<&FreeRange> {
        match &self.values {
            FreeValues::Range(range) if !range.key.is_count() => Some(range),
            FreeValues::Range(_) | FreeValues::Choice(_) => None,
        }
    }

    /// Returns the values at a place as text with their units, as `--set` takes them.
    pub(crate) fn settings(&self, place: f64) -> Vec<(String, String)> {
        match &self.values {
            FreeValues::Choice(choices) => choices[self.choice(place)].values.clone(),
            FreeValues::Range(_) => vec![(self.path.clone(), self.text(place))],
        }
    }

    /// Returns the value at a place as text with its unit; a choice as it is written in the file.
    pub fn text(&self, place: f64) -> String {
        match &self.values {
            FreeValues::Choice(choices) => choices[self.choice(place)].text(&self.path),
            FreeValues::Range(range) => range.text(range.value(place)),
        }
    }

    /// Returns the value in a spec as text with its unit; empty where the spec has none.
    pub fn given(&self, spec: &Spec) -> String {
        match &self.values {
            FreeValues::Choice(choices) => {
                let mut values: Vec<(String, String)> = Vec::new();
                for (path, _) in choices.iter().flat_map(|choice| &choice.values) {
                    let is_new = values.iter().all(|(known, _)| known != path);
                    let value = text_at(spec, path);
                    if is_new && !value.is_empty() {
                        values.push((path.clone(), value));
                    }
                }
                match values.is_empty() {
                    true => String::new(),
                    false => Choice { values }.text(&self.path),
                }
            }
            FreeValues::Range(range) => range
                .key
                .get(spec)
                .map_or_else(|_| String::new(), |value| range.text(value)),
        }
    }
}

/// Returns values below a path as a table in one line.
pub(super) fn table_text(path: &str, values: &[(String, String)]) -> String {
    let short = |own: &str| {
        let rest = own
            .strip_prefix(path)
            .and_then(|rest| rest.strip_prefix('.'));
        rest.unwrap_or(own).to_owned()
    };
    let pairs = values
        .iter()
        .map(|(own, value)| format!("{} = {value:?}", short(own)));
    format!("{{ {} }}", pairs.collect::<Vec<_>>().join(", "))
}

/// Returns a value as `--set` takes it: a text without its quotes; `None` for a list or a table.
pub(super) fn value_text(value: &Value) -> Option<String> {
    match value {
        Value::String(text) => Some(text.value().clone()),
        Value::Integer(_) | Value::Float(_) | Value::Boolean(_) => {
            Some(value.to_string().trim().to_owned())
        }
        Value::Datetime(_) | Value::Array(_) | Value::InlineTable(_) => None,
    }
}

/// Returns the value at a dotted path of a spec; empty without one.
fn text_at(spec: &Spec, path: &str) -> String {
    let Ok(document) = spec.to_toml().parse::<DocumentMut>() else {
        return String::new();
    };
    let mut item = document.as_item();
    for name in path.split('.') {
        match item.get(name) {
            Some(inner) => item = inner,
            None => return String::new(),
        }
    }
    item.as_value().and_then(value_text).unwrap_or_default()
}

/// Returns the messages of faults.
pub(super) fn messages(faults: &Faults) -> Vec<String> {
    let all = faults.as_slice().iter();
    all.map(|fault| fault.message.clone()).collect()
}
