//! Rules between the keys of a table: keys that depend on a choice, and keys that exclude each
//! other.
//!
//! A rule refuses a key by `false` at the key itself, so that an editor marks this key and not the
//! complete table.

use serde_json::{Map, Value, json};

use super::pattern::pattern;
use crate::key::{Kind, Need, Row};

/// Returns the rules of a table.
pub(super) fn rules(rows: &[Row]) -> Vec<Value> {
    let mut rules = Vec::new();
    for choice in rows {
        if let Kind::Choice(words) = choice.info.kind {
            let words = words.iter();
            rules.extend(words.filter_map(|word| rule_of_word(choice, word, rows)));
        }
    }
    for row in rows {
        let names = row.info.need.alternatives();
        // Alternatives that depend on a choice are part of the rules of its words.
        if names.first() == Some(&row.info.name) && row.info.when.is_none() {
            rules.extend(exclusions(names));
            if let Need::OneOf(_) = row.info.need {
                let other = row.info.unless.iter().copied();
                rules.push(one_required(names.iter().copied().chain(other)));
            }
        }
        if let (Need::Required, None, Some(other)) = (row.info.need, row.info.when, row.info.unless)
        {
            rules.push(one_required([row.info.name, other]));
        }
    }
    rules
}

/// One of the keys is required.
fn one_required<'a>(names: impl IntoIterator<Item = &'a str>) -> Value {
    let alternatives = names.into_iter().map(has);
    json!({ "anyOf": alternatives.collect::<Vec<_>>() })
}

fn has(name: &str) -> Value {
    json!({ "type": "object", "required": [name] })
}

/// A key excludes those after it.
fn exclusions(names: &[&str]) -> Vec<Value> {
    let others = |first: usize| refused(names[first + 1..].iter().copied());
    let pairs = names.iter().enumerate().take(names.len().saturating_sub(1));
    pairs
        .map(|(at, name)| json!({ "if": has(name), "then": { "properties": others(at) } }))
        .collect()
}

fn refused<'a>(names: impl Iterator<Item = &'a str>) -> Value {
    Value::Object(names.map(|name| (name.to_owned(), json!(false))).collect())
}

/// Returns the rule for one word of a choice; `None` if no key depends on it.
fn rule_of_word(choice: &Row, word: &str, rows: &[Row]) -> Option<Value> {
    let name = choice.info.name;
    let is_dependent = |row: &&Row| row.info.when.is_some_and(|when| when.key == name);
    let applies = |row: &&Row| row.info.when.is_some_and(|when| when.is.contains(&word));
    let dependent: Vec<&Row> = rows.iter().filter(is_dependent).collect();
    let present: Vec<&Row> = dependent.iter().copied().filter(applies).collect();
    let is_present = |name: &str| present.iter().any(|row| row.info.name == name);
    let absent = dependent.iter().map(|row| row.info.name);
    let mut properties = match refused(absent.filter(|name| !is_present(name))) {
        Value::Object(properties) => properties,
        _ => Map::new(),
    };
    properties.extend(quantities(name, word, rows, &present));
    let required: Vec<&str> = present
        .iter()
        .filter(|row| row.info.need == Need::Required && row.info.unless.is_none())
        .map(|row| row.info.name)
        .collect();
    let mut then = json!({ "required": required, "properties": properties });
    let further = further(&present);
    if !further.is_empty() {
        then["allOf"] = Value::Array(further);
    }
    let is_default = choice.default.as_deref() == Some(format!("\"{word}\"").as_str());
    let needed = if is_default { json!([]) } else { json!([name]) };
    let has_effect = !dependent.is_empty() || then["properties"] != json!({});
    has_effect.then(|| json!({ "if": { "type": "object", "properties": { name: { "const": word } }, "required": needed }, "then": then }))
}

/// Keys that another key replaces, and alternatives, among the keys of a word.
fn further(present: &[&Row]) -> Vec<Value> {
    let mut rules = Vec::new();
    for row in present {
        match (row.info.need, row.info.unless) {
            (Need::Required, Some(other)) => rules.push(one_required([row.info.name, other])),
            (Need::OneOf(names), other) if names.first() == Some(&row.info.name) => {
                rules.push(one_required(names.iter().copied().chain(other)));
                rules.extend(exclusions(names));
            }
            _ => {}
        }
    }
    rules
}

/// Patterns of the keys whose kind or limits are different for other words of the choice.
fn quantities(choice: &str, word: &str, rows: &[Row], present: &[&Row]) -> Map<String, Value> {
    let mut patterns = Map::new();
    for row in rows {
        let by_word = row.quantity_of_word(choice, word);
        let is_repeated = rows
            .iter()
            .filter(|other| other.info.name == row.info.name)
            .count()
            > 1;
        let is_present = present.iter().any(|other| std::ptr::eq(*other, row));
        let quantity = match row.info.kind {
            Kind::Quantity(_) if by_word.is_some() => by_word,
            Kind::Quantity(quantity)
                if is_repeated && is_present && row.info.measured_by.is_none() =>
            {
                Some(quantity)
            }
            _ => continue,
        };
        let pattern = json!({ "pattern": pattern(&row.info.range, quantity) });
        patterns.insert(row.info.name.to_owned(), pattern);
    }
    patterns
}
