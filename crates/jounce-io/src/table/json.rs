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

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::super::Column;
    use super::*;

    #[test]
    fn numbers_read_back_exactly_and_nan_is_null() {
        let numbers = vec![0.1 + 0.2, 5e-324, -0.0, f64::NAN, f64::INFINITY];
        let table = Table::new(vec![Column::new("power_w", "W", "mean power", numbers)]).unwrap();
        let value: Value = serde_json::from_str(&encode(&table, &Manifest::new("ab"))).unwrap();
        let read: Vec<_> = value["columns"]["power_w"]
            .as_array()
            .unwrap()
            .iter()
            .map(Value::as_f64)
            .collect();
        assert_eq!(
            read,
            [Some(0.1 + 0.2), Some(5e-324), Some(-0.0), None, None]
        );
        assert!(read[2].unwrap().is_sign_negative());
        assert_eq!(value["units"]["power_w"], "W");
        assert_eq!(value["manifest"]["spec_sha256"], "ab");
    }
}
