//! Results of the library to dictionaries of Python.
//!
//! A result is serialised once, as for the JSON of the command line. A list of records becomes one
//! array for each of their fields: `loads: [{name, mean_power_w}]` is `load`, the names, and
//! `load_mean_power_w`. A missing number is NaN in an array.

use crate::arrays::PythonDict;
use crate::failure::Failure;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::{Map, Value};

/// Reads options from JSON.
pub fn options<O: serde::de::DeserializeOwned>(json: &str) -> Result<O, Failure> {
    serde_json::from_str(json).map_err(|error| Failure::new("ArgumentError", error))
}

/// Returns a result as a dictionary of numbers, texts and arrays.
pub fn dict<'py>(py: Python<'py>, result: &impl serde::Serialize) -> PyResult<PythonDict<'py>> {
    let value = serde_json::to_value(result).map_err(|error| Failure::new("JounceError", error))?;
    let mut dict = PythonDict::new(py);
    for (name, value) in value.as_object().into_iter().flatten() {
        dict = match value.as_array() {
            Some(items) if items.iter().all(Value::is_object) => records(dict, name, items)?,
            _ => dict.with(name, object(py, value)?)?,
        };
    }
    Ok(dict)
}

/// Adds an array for each field of records.
fn records<'py>(dict: PythonDict<'py>, list: &str, items: &[Value]) -> PyResult<PythonDict<'py>> {
    let one = singular(list);
    let items: Vec<&Map<String, Value>> = items.iter().filter_map(Value::as_object).collect();
    let mut dict = dict;
    for field in items
        .iter()
        .flat_map(|item| item.keys())
        .take(items.first().map_or(0, |item| item.len()))
    {
        let values = || {
            items
                .iter()
                .map(|item| item.get(field).unwrap_or(&Value::Null))
        };
        let name = if field == "name" {
            one.clone()
        } else {
            format!("{one}_{field}")
        };
        dict = if values().all(Value::is_string) {
            dict.with(
                &name,
                values().filter_map(Value::as_str).collect::<Vec<_>>(),
            )?
        } else if values().all(|value| value.is_i64() || value.is_u64()) {
            dict.array(&name, values().filter_map(Value::as_i64).collect())?
        } else if values().all(Value::is_boolean) {
            dict.array(&name, values().filter_map(Value::as_bool).collect())?
        } else {
            dict.array(
                &name,
                values()
                    .map(|value| value.as_f64().unwrap_or(f64::NAN))
                    .collect(),
            )?
        };
    }
    Ok(dict)
}

fn singular(list: &str) -> String {
    let ends = [("patches", "patch"), ("s", "")];
    let found = ends
        .iter()
        .find_map(|(end, by)| list.strip_suffix(end).map(|begin| format!("{begin}{by}")));
    found.unwrap_or_else(|| list.to_owned())
}

/// Returns a value as `json.loads` does.
fn object<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    Ok(match value {
        Value::Null => py.None().into_bound(py),
        Value::Bool(value) => value.into_pyobject(py)?.to_owned().into_any(),
        Value::String(text) => text.into_pyobject(py)?.into_any(),
        Value::Number(number) => match (number.as_i64(), number.as_f64()) {
            (Some(whole), _) => whole.into_pyobject(py)?.into_any(),
            (None, value) => value.unwrap_or(f64::NAN).into_pyobject(py)?.into_any(),
        },
        Value::Array(items) => {
            let items: Vec<_> = items
                .iter()
                .map(|item| object(py, item))
                .collect::<PyResult<_>>()?;
            items.into_pyobject(py)?.into_any()
        }
        Value::Object(fields) => {
            let dict = PyDict::new(py);
            for (name, value) in fields {
                dict.set_item(name, object(py, value)?)?;
            }
            dict.into_any()
        }
    })
}
