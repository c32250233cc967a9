//! JSON Schema (draft-07) of a spec, generated from the table of keys.

use serde_json::{Map, Value, json};

use super::Spec;
use super::key::{Kind, Need, Row, rows};
use super::keys::SPEC;

/// Pattern of a name chosen by the user.
const NAME: &str = "^[A-Za-z0-9_-]+$";

/// Returns the draft-07 JSON Schema of a spec, for editors that complete and check TOML.
///
/// The schema contains every key, kind, limit and choice. It cannot check references, units of the
/// wrong kind and rules between elements; [`Spec::from_toml`] checks those.
pub fn schema() -> Value {
    let top = rows(SPEC, Spec::default);
    let mut schema = table(&top);
    schema["$schema"] = json!("http://json-schema.org/draft-07/schema#");
    schema["title"] = json!("jounce spec");
    schema["description"] =
        json!("An impact energy harvester: its structure, stops, circuits and drives.");
    schema["anyOf"] =
        json!([{ "required": ["beam"] }, { "required": ["mass"] }, { "required": ["modal"] }]);
    schema
}

fn table(rows: &[Row]) -> Value {
    let mut properties = Map::new();
    for row in rows {
        let mut property = property(row);
        if let Some(other) = properties.get(row.info.name) {
            property["description"] = json!(format!("{}; {}", text(other), text(&property)));
            // Limits that hold in every case; the rules below distinguish the cases. A name has no
            // limits.
            if other.get("pattern").is_some() {
                property["pattern"] = json!(if is_signed(other) || is_signed(&property) {
                    pattern(true)
                } else {
                    pattern(false)
                });
            }
        }
        properties.insert(row.info.name.to_owned(), property);
    }
    let required = rows.iter().filter(|row| {
        row.info.need == Need::Required && row.info.when.is_none() && row.info.unless.is_none()
    });
    let required: Vec<&str> = required.map(|row| row.info.name).collect();
    let mut table = json!({ "type": "object", "properties": properties, "additionalProperties": false, "required": required });
    let rules = rules(rows);
    if !rules.is_empty() {
        table["allOf"] = Value::Array(rules);
    }
    table
}

fn text(property: &Value) -> &str {
    property["description"].as_str().unwrap_or_default()
}

fn is_signed(property: &Value) -> bool {
    property["pattern"] == json!(pattern(true))
}

fn property(row: &Row) -> Value {
    let info = &row.info;
    let mut property = match info.kind {
        Kind::Quantity(_) | Kind::NamedQuantities(_) => {
            let quantity = json!({ "type": "string", "pattern": pattern(info.range.low < 0.0) });
            if matches!(info.kind, Kind::Quantity(_)) {
                quantity
            } else {
                by_name(quantity)
            }
        }
        Kind::Number => number(row, "number"),
        Kind::Count => number(row, "integer"),
        Kind::Numbers => numbers(row),
        Kind::NamedNumbers => by_name(numbers(row)),
        Kind::ChoiceOrPath(_) | Kind::Path | Kind::Text | Kind::Reference { .. } => {
            json!({ "type": "string", "minLength": 1 })
        }
        Kind::References { .. } => {
            json!({ "type": "array", "items": { "type": "string", "minLength": 1 }, "minItems": 1 })
        }
        Kind::Choice(words) => json!({ "type": "string", "enum": words }),
        Kind::Things => by_name(table(&row.inner)),
        Kind::Table => table(&row.inner),
    };
    let mut description = info.doc.to_owned();
    if let Kind::Quantity(quantity) | Kind::NamedQuantities(quantity) = info.kind {
        description = format!(
            "{description}; {}, in {}",
            quantity.kind(),
            quantity.units().join(", ")
        );
    }
    if let Some(default) = &row.default {
        description = format!("{description} (default {default})");
    }
    property["description"] = json!(description);
    property
}

fn by_name(inner: Value) -> Value {
    json!({ "type": "object", "patternProperties": { NAME: inner }, "additionalProperties": false })
}

fn number(row: &Row, kind: &str) -> Value {
    let range = &row.info.range;
    let mut number = json!({ "type": kind });
    if range.low.is_finite() {
        number[if range.open {
            "exclusiveMinimum"
        } else {
            "minimum"
        }] = json!(range.low);
    }
    if range.high.is_finite() {
        number["maximum"] = json!(range.high);
    }
    number
}

fn numbers(row: &Row) -> Value {
    let least = usize::from(row.info.need == Need::Required);
    json!({ "type": "array", "items": number(row, "number"), "minItems": least })
}

/// Returns the pattern of a number followed by a unit.
fn pattern(signed: bool) -> String {
    let sign = if signed { "[+-]?" } else { "\\+?" };
    format!(
        r"^\s*{sign}(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?\s*[^\s\d.,+-].*$|^\s*{sign}(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?\s+1/.*$"
    )
}

/// Returns the rules for keys that depend on a choice or exclude each other.
fn rules(rows: &[Row]) -> Vec<Value> {
    let mut rules = Vec::new();
    for choice in rows {
        let Kind::Choice(words) = choice.info.kind else {
            continue;
        };
        let dependent: Vec<&Row> = rows
            .iter()
            .filter(|row| {
                row.info
                    .when
                    .is_some_and(|when| when.key == choice.info.name)
            })
            .collect();
        if !dependent.is_empty() {
            rules.extend(words.iter().map(|word| rule(choice, word, &dependent)));
        }
    }
    for row in rows {
        let names = row.info.need.alternatives();
        // Alternatives that depend on a choice are part of the rules of its words.
        if names.first() == Some(&row.info.name) && row.info.when.is_none() {
            let alternatives = alternatives(names);
            rules.push(match (row.info.need, row.info.unless) {
                (Need::AtMostOne(_), _) => json!({ "not": { "required": names } }),
                (_, None) => json!({ "oneOf": alternatives }),
                (_, Some(other)) => {
                    let exactly = json!({ "oneOf": alternatives });
                    json!({ "if": { "required": [other] }, "then": { "not": { "required": names } }, "else": exactly })
                }
            });
        }
        if let (Need::Required, None, Some(other)) = (row.info.need, row.info.when, row.info.unless)
        {
            rules.push(
                json!({ "anyOf": [{ "required": [row.info.name] }, { "required": [other] }] }),
            );
        }
    }
    rules
}

fn alternatives(names: &[&str]) -> Vec<Value> {
    names
        .iter()
        .map(|name| json!({ "required": [name] }))
        .collect()
}

fn rule(choice: &Row, word: &str, dependent: &[&Row]) -> Value {
    let name = choice.info.name;
    let goes = |row: &&&Row| row.info.when.is_some_and(|when| when.is.contains(&word));
    let present: Vec<&str> = dependent
        .iter()
        .filter(goes)
        .map(|row| row.info.name)
        .collect();
    let required: Vec<&str> = dependent
        .iter()
        .filter(goes)
        .filter(|row| row.info.need == Need::Required && row.info.unless.is_none())
        .map(|row| row.info.name)
        .collect();
    let absent = dependent
        .iter()
        .map(|row| row.info.name)
        .filter(|other| !present.contains(other));
    let absent: Map<String, Value> = absent
        .map(|other| (other.to_owned(), json!(false)))
        .collect();
    let is_default = choice.default.as_deref() == Some(format!("\"{word}\"").as_str());
    let needed = if is_default { json!([]) } else { json!([name]) };
    let elsewhere = dependent
        .iter()
        .filter(goes)
        .filter(|row| row.info.need == Need::Required);
    let either =
        elsewhere.filter_map(|row| Some(json!({ "anyOf": [{ "required": [row.info.name] }, { "required": [row.info.unless?] }] })));
    let exactly = dependent
        .iter()
        .filter(goes)
        .filter_map(|row| match row.info.need {
            Need::OneOf(names) if names.first() == Some(&row.info.name) => {
                Some(json!({ "oneOf": alternatives(names) }))
            }
            _ => None,
        });
    let either: Vec<Value> = either.chain(exactly).collect();
    let mut then = json!({ "required": required, "properties": absent });
    if !either.is_empty() {
        then["allOf"] = Value::Array(either);
    }
    json!({ "if": { "properties": { name: { "const": word } }, "required": needed }, "then": then })
}
