//! Conditions: `[[conditions]]` with `set` and `weight`.

use crate::problem::Condition;
use jounce_analysis::study::FaultCollector;
use jounce_spec::{KeyRange, SpecFile};
use toml_edit::{Item, Table};

/// Largest number of conditions in one table.
const MAX_CONDITIONS: usize = 1000;

/// Reads the conditions. A band, such as `"9Hz:13Hz:5x"`, has one condition for each of its values,
/// which share the weight.
pub(super) fn conditions(
    reader: &mut FaultCollector,
    item: Option<&Item>,
    file: &SpecFile,
) -> Vec<Condition> {
    let Some(item) = item else {
        return vec![Condition {
            values: Vec::new(),
            weight: 1.0,
        }];
    };
    let Some(tables) = item
        .as_array_of_tables()
        .filter(|tables| !tables.is_empty())
    else {
        let message = "conditions must be tables, [[conditions]], each with set = { \"drive.shaker.frequency\" = \"11 Hz\" } and weight = 1";
        reader.fault("conditions", item.span(), message);
        return Vec::new();
    };
    let mut all = Vec::new();
    for table in tables {
        all.extend(of_table(reader, table, file));
    }
    all
}

fn of_table(reader: &mut FaultCollector, table: &Table, file: &SpecFile) -> Vec<Condition> {
    reader.known("conditions.", table, &["set", "weight"]);
    let weight = reader.positive("conditions.weight", table.get("weight"), 1.0);
    let set = table.get("set").and_then(Item::as_table_like);
    let mut all = vec![Vec::new()];
    for (path, item) in set.into_iter().flat_map(|set| set.iter()) {
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
    let condition = |values| Condition { values, weight };
    all.into_iter().map(condition).collect()
}
