//! One JSON object: `columns` (name -> values), `units`, `about`, `manifest`.

use serde_json::{Map, Value, json};

use super::{Manifest, Table, Values};

pub(super) fn encode(table: &Table, manifest: &Manifest) -> String {
    let (mut columns, mut units, mut about) = (Map::new(), Map::new(), Map::new());
    for column in table.columns() {
        let values = array(&column.values, Value::from);
        columns.insert(column.name.clone(), values);
        units.insert(column.name.clone(), Value::from(column.unit.as_str()));
        about.insert(column.name.clone(), Value::from(column.about.as_str()));
    }
    json!({ "columns": columns, "units": units, "about": about, "manifest": manifest }).to_string()
        + "\n"
}

/// Returns the values of a column; `number` writes a float, with NaN and infinities, which JSON
/// lacks: `Value::from` makes them `null`.
pub(super) fn array(values: &Values, number: impl Fn(f64) -> Value) -> Value {
    match values {
        Values::Float(v) => v.iter().copied().map(number).collect(),
        Values::Integer(v) => v.iter().copied().collect(),
        Values::Count(v) => v.iter().copied().collect(),
        Values::Flag(v) => v.iter().copied().collect(),
        Values::Text(v) => v.iter().map(String::as_str).collect(),
    }
}
