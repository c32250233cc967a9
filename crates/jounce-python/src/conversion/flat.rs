//! Results of the library to dictionaries of Python.
//!
//! A result is serialised once, as for the JSON of the command line. A list of records becomes one
//! array for each of their fields: `loads: [{name, mean_power_w}]` is `load`, the names, and
//! `load_mean_power_w`. A list of numbers is an array. A missing number is NaN in an array.

use super::arrays::PythonDict;
use super::failure::Failure;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::{Map, Value};

/// Texts that may be missing in all records.
const TEXTS: [&str; 7] = [
    "allowed_laws",
    "attractor",
    "bifurcation_level",
    "bifurcation_stop",
    "mirror_of",
    "reason",
    "stop_carried_by",
];

/// Lists that remain lists of dictionaries, unless they are the main list.
const DICTIONARIES: [&str; 4] = ["attractors", "force_tables", "not_proved", "termination"];

/// Types in messages on options, and their names in Python.
const TYPES: [(&str, &str); 8] = [
    ("invalid type: floating point", "the number"),
    ("invalid type: string", "the text"),
    ("unknown variant", "unknown choice"),
    ("expected u16", "expected a whole number"),
    ("expected f64", "expected a number"),
    ("expected u32", "expected a whole number"),
    ("expected u64", "expected a whole number"),
    ("expected usize", "expected a whole number"),
];

/// Reads options from JSON.
///
/// # Errors
/// `TypeError` for an option of a wrong type, `ArgumentError` for an unknown one or a wrong value.
pub fn options<O: serde::de::DeserializeOwned>(json: &str) -> PyResult<O> {
    let error = match serde_json::from_str(json) {
        Ok(options) => return Ok(options),
        Err(error) => error,
    };
    let fields: Map<String, Value> = serde_json::from_str(json).unwrap_or_default();
    let message = |(name, value): (String, Value)| {
        let option_result = serde_json::from_value::<O>(serde_json::json!({ &name: value }));
        option_result.err().map(|error| format!("{name}: {error}"))
    };
    let message = fields
        .into_iter()
        .find_map(message)
        .unwrap_or_else(|| error.to_string());
    let is_of_type = message.contains("invalid type");
    let message = TYPES
        .iter()
        .fold(message, |text, (rust, python)| text.replace(rust, python));
    Err(match is_of_type {
        true => pyo3::exceptions::PyTypeError::new_err(message),
        false => Failure::new("ArgumentError", message).into(),
    })
}

/// Returns a result as a dictionary of numbers, texts and arrays.
pub fn dict<'py>(py: Python<'py>, result: &impl serde::Serialize) -> PyResult<PythonDict<'py>> {
    dict_with_main(py, result, "")
}

/// Returns a result as a dictionary; the arrays of its `main` list are named after the fields alone.
pub fn dict_with_main<'py>(
    py: Python<'py>,
    result: &impl serde::Serialize,
    main: &str,
) -> PyResult<PythonDict<'py>> {
    let value = serde_json::to_value(result).map_err(|error| Failure::new("JounceError", error))?;
    let mut dict = PythonDict::new(py);
    // Warnings are messages in Python, issues of recordings are objects.
    for (name, value) in value
        .as_object()
        .into_iter()
        .flatten()
        .filter(|entry| entry.0 != "warnings" && entry.0 != "issues")
    {
        dict = match value.as_array() {
            Some(items)
                if items.iter().all(Value::is_object)
                    && (name == main || !DICTIONARIES.contains(&name.as_str())) =>
            {
                let items: Vec<&Value> = items.iter().collect();
                records(dict, name, &items, name == main)?
            }
            Some(items) if items.iter().all(Value::is_number) => {
                column(dict, name, &items.iter().collect::<Vec<_>>())?
            }
            _ => dict.with(name, object(py, value)?)?,
        };
    }
    Ok(dict)
}

/// Adds an array for each field of records; a field with a record has an array for each of its
/// fields, and a field with a list has none.
fn records<'py>(
    dict: PythonDict<'py>,
    list: &str,
    items: &[&Value],
    is_main: bool,
) -> PyResult<PythonDict<'py>> {
    let item_name = singular(list);
    let fields = items
        .first()
        .and_then(|item| item.as_object())
        .into_iter()
        .flat_map(Map::keys);
    let mut dict = dict;
    for field in fields {
        let name = match field.as_str() {
            "name" | "id" => item_name.clone(),
            _ if is_main => field.clone(),
            field if field == item_name => item_name.clone(),
            _ => format!("{item_name}_{field}"),
        };
        let values: Vec<&Value> = items.iter().map(|item| &item[field]).collect();
        dict = match values.first() {
            Some(Value::Array(_)) => dict,
            Some(Value::Object(_)) => records(dict, &name, &values, false)?,
            _ => column(dict, &name, &values)?,
        };
    }
    Ok(dict)
}

/// Adds an array of integers, truth values or numbers, or a list of texts.
fn column<'py>(dict: PythonDict<'py>, name: &str, values: &[&Value]) -> PyResult<PythonDict<'py>> {
    let is_text = |value: &&Value| value.is_string() || value.is_null();
    if values.iter().all(|value| value.is_i64() || value.is_u64()) {
        return dict.array(
            name,
            values.iter().filter_map(|value| value.as_i64()).collect(),
        );
    }
    if values.iter().all(|value| value.is_boolean()) {
        return dict.array(
            name,
            values.iter().filter_map(|value| value.as_bool()).collect(),
        );
    }
    if TEXTS.contains(&name)
        || values.iter().any(|value| value.is_string()) && values.iter().all(is_text)
    {
        return dict.with(
            name,
            values
                .iter()
                .map(|value| value.as_str())
                .collect::<Vec<_>>(),
        );
    }
    let number = |value: &&Value| value.as_f64().unwrap_or(f64::NAN);
    dict.array(name, values.iter().map(number).collect())
}

fn singular(list: &str) -> String {
    let ends = [("patches", "patch"), ("s", "")];
    let renamed = ends.iter().find_map(|(suffix, replacement)| {
        list.strip_suffix(suffix)
            .map(|stem| format!("{stem}{replacement}"))
    });
    renamed.unwrap_or_else(|| list.to_owned())
}

/// Returns a value as `json.loads` does.
pub fn object<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    Ok(match value {
        Value::Null => py.None().into_bound(py),
        Value::Bool(value) => value.into_pyobject(py)?.to_owned().into_any(),
        Value::String(text) => text.into_pyobject(py)?.into_any(),
        Value::Number(number) => match (number.as_i64(), number.as_f64()) {
            (Some(integer), _) => integer.into_pyobject(py)?.into_any(),
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
