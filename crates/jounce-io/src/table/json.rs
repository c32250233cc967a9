//! One JSON object: `columns` (name -> values), `units`, `about`, `manifest`.

use serde_json::{Map, Value, json};

use super::{Manifest, Table, Values};

pub(super) fn encode(table: &Table, manifest: &Manifest) -> String {
    let (mut columns, mut units, mut about) = (Map::new(), Map::new(), Map::new());
    for column in table.columns() {
        columns.insert(column.name.clone(), array(&column.values));
        units.insert(column.name.clone(), Value::from(column.unit.as_str()));
        about.insert(column.name.clone(), Value::from(column.about.as_str()));
    }
    json!({ "columns": columns, "units": units, "about": about, "manifest": manifest }).to_string()
        + "\n"
}

/// NaN and infinities become `null`, because JSON lacks them.
fn array(values: &Values) -> Value {
    match values {
        Values::Float(v) => v.iter().map(|&x| Value::from(x)).collect(),
        Values::Integer(v) => v.iter().copied().collect(),
        Values::Count(v) => v.iter().copied().collect(),
        Values::Flag(v) => v.iter().copied().collect(),
        Values::Text(v) => v.iter().map(String::as_str).collect(),
    }
}
