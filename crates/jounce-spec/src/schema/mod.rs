//! JSON Schema (draft-07) of a spec, generated from the table of keys.

use serde_json::{Map, Value, json};

mod pattern;
mod rules;

use super::key::{Kind, Need, Range, Row, rows};
use super::{Quantity, Spec};
use pattern::pattern;
use rules::rules;

/// Pattern of a name chosen by the user.
const NAME: &str = "^[A-Za-z0-9_-]+$";

/// Returns the draft-07 JSON Schema of a spec, for editors that complete and check TOML.
///
/// The schema contains every key, kind, choice and limit, and the units that are a single symbol.
/// It cannot check references, limits of quantities other than their sign, units with operators
/// and rules between elements; [`Spec::from_toml`] checks those.
pub fn schema() -> Value {
    let top = rows(&Spec::default());
    let mut schema = table(&top);
    schema["$schema"] = json!("http://json-schema.org/draft-07/schema#");
    schema["title"] = json!("jounce spec");
    schema["description"] =
        json!("An impact energy harvester: its structure, stops, circuits and drives.");
    schema["anyOf"] = ["beam", "plate", "mass", "modal"]
        .map(|name| json!({ "required": [name] }))
        .to_vec()
        .into();
    schema
}

fn table(rows: &[Row]) -> Value {
    let mut properties = Map::new();
    for row in rows {
        let mut property = property(row);
        if let Some(other) = properties.get(row.info.name) {
            if text(other) != text(&property) {
                property["description"] = json!(format!("{}; {}", text(other), text(&property)));
            }
            // The rules below distinguish the cases.
            if other.get("pattern").is_some() {
                property["pattern"] = json!(pattern(&Range::ANY, None));
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

fn property(row: &Row) -> Value {
    let info = &row.info;
    let mut property = match info.kind {
        Kind::Quantity(quantity) | Kind::NamedQuantities(quantity) => {
            let kind = row.info.measured_by.is_none().then_some(quantity);
            let value = json!({ "type": "string", "pattern": pattern(&info.range, kind) });
            if matches!(info.kind, Kind::Quantity(_)) {
                value
            } else {
                by_name(value)
            }
        }
        Kind::Number => number(row, "number"),
        Kind::NumberOr(quantity) => {
            json!({ "anyOf": [number(row, "number"), with_unit(row, quantity)] })
        }
        Kind::Count => number(row, "integer"),
        Kind::Numbers => numbers(row),
        Kind::Quantities(quantity) => {
            json!({ "type": "array", "items": with_unit(row, quantity), "minItems": 1 })
        }
        Kind::NamedNumbers => by_name(numbers(row)),
        Kind::ChoiceOrPath(words) => {
            json!({ "type": "string", "anyOf": [{ "enum": words }, { "pattern": r"[./\\]" }] })
        }
        Kind::Path | Kind::Text | Kind::Reference { .. } => {
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
    if let Kind::Quantity(quantity)
    | Kind::NamedQuantities(quantity)
    | Kind::NumberOr(quantity)
    | Kind::Quantities(quantity) = info.kind
    {
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

fn with_unit(row: &Row, quantity: Quantity) -> Value {
    json!({ "type": "string", "pattern": pattern(&row.info.range, Some(quantity)) })
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
    let least = usize::from(row.info.need != Need::Default);
    json!({ "type": "array", "items": number(row, "number"), "minItems": least })
}
