//! Conditions: `[[conditions]]` with `set` and `weight`.

use super::choices::plain;
use crate::problem::Condition;
use jounce_analysis::study::FaultCollector;
use jounce_spec::{KeyRange, SpecFile};
use toml_edit::{Item, Table, TableLike};

/// Largest number of conditions in one table.
const MAX_CONDITIONS: usize = 1000;

/// Changes of the spec by text in conditions.
pub(super) type Changes = Vec<Vec<(String, String)>>;

/// Reads the conditions, and their changes by text, of which the first is none. A band, such as
/// `"9Hz:13Hz:5x"`, has one condition for each of its values, which share the weight.
pub(super) fn conditions(
    reader: &mut FaultCollector,
    item: Option<&Item>,
    file: &SpecFile,
) -> (Vec<Condition>, Changes) {
    let mut changes = vec![Vec::new()];
    let Some(item) = item else {
        let given = Condition {
            change: 0,
            values: Vec::new(),
            weight: 1.0,
        };
        return (vec![given], changes);
    };
    let Some(tables) = item
        .as_array_of_tables()
        .filter(|tables| !tables.is_empty())
    else {
        let message = "conditions must be tables, [[conditions]], each with set = { \"drive.shaker.frequency\" = \"11 Hz\" } and weight = 1";
        reader.fault("conditions", item.span(), message);
        return (Vec::new(), changes);
    };
    let mut all = Vec::new();
    for table in tables {
        all.extend(of_table(reader, table, file, &mut changes));
    }
    (all, changes)
}

fn of_table(
    reader: &mut FaultCollector,
    table: &Table,
    file: &SpecFile,
    changes: &mut Changes,
) -> Vec<Condition> {
    reader.known("conditions.", table, &["set", "weight"]);
    let weight = reader.positive("conditions.weight", table.get("weight"), 1.0);
    let set = table.get("set").and_then(Item::as_table_like);
    let (file, change, numbers) = changed(reader, set, file);
    let mut all = vec![Vec::new()];
    for (path, item) in numbers {
        let text = item.as_str().unwrap_or(reader.bare(item));
        let key = file.numeric_key(path).map_err(|faults| faults.to_string());
        let range = key
            .and_then(|key| KeyRange::parse(key, text).map_err(|fault| fault.message))
            .and_then(|range| match all.len() * range.values().len() {
                count if count > MAX_CONDITIONS => Err(format!(
                    "{path} makes {count} conditions; at most {MAX_CONDITIONS} are allowed"
                )),
                _ => Ok(range),
            });
        match range {
            Ok(range) => {
                let with = |value: f64| {
                    let pair = (range.key().clone(), value);
                    all.iter().map(move |values| {
                        let mut values: Vec<_> = values.clone();
                        values.push(pair.clone());
                        values
                    })
                };
                all = range
                    .values()
                    .iter()
                    .flat_map(|value| with(*value))
                    .collect();
            }
            Err(message) => reader.fault(path, item.span(), format!("conditions: {message}")),
        }
    }
    let weight = weight / all.len() as f64;
    let known = changes.iter().position(|known| *known == change);
    let change = known.unwrap_or_else(|| {
        changes.push(change);
        changes.len() - 1
    });
    let condition = |values| Condition {
        change,
        values,
        weight,
    };
    all.into_iter().map(condition).collect()
}

/// Values of a condition by their keys.
type Values<'t> = Vec<(&'t str, &'t Item)>;

/// Applies the values of a condition that are no numbers of the spec: texts, tables, and an empty text,
/// which removes a key. Returns the changed spec, the change, and the other values.
fn changed<'t>(
    reader: &mut FaultCollector,
    set: Option<&'t dyn TableLike>,
    file: &SpecFile,
) -> (SpecFile, Vec<(String, String)>, Values<'t>) {
    let (mut changed, mut change, mut numbers) = (file.clone(), Vec::new(), Vec::new());
    for (path, item) in set.into_iter().flat_map(|set| set.iter()) {
        let is_removed = item.as_str().is_some_and(str::is_empty);
        if !is_removed && file.numeric_key(path).is_ok() {
            numbers.push((path, item));
            continue;
        }
        let text = match (item.as_str(), item.as_table()) {
            (Some(text), _) => text.to_owned(),
            (None, Some(table)) => table.clone().into_inline_table().to_string(),
            (None, None) => reader.bare(item).to_owned(),
        };
        match changed.set(path, &text) {
            Ok(()) => change.push((path.to_owned(), text)),
            Err(fault) => {
                let message = format!("conditions: {}", fault.message);
                reader.fault(path, item.span(), message);
            }
        }
    }
    if let Some(Err(faults)) = (!change.is_empty()).then(|| changed.spec()) {
        for fault in faults.as_slice() {
            let item = set.and_then(|set| set.get(&fault.key));
            let message = format!("conditions: {}", plain(fault));
            reader.fault(&fault.key, item.and_then(Item::span), message);
        }
    }
    (changed, change, numbers)
}
