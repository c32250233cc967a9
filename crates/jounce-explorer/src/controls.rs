//! Controls of the page: every number of the spec, with its unit and range.

use crate::design::Design;
use jounce_core::spec::NumericKey;
use serde_json::{Value, json};
use toml_edit::{DocumentMut, Item};

/// Ratio of the ends of a logarithmic slider to the value.
const LOG_RATIO: f64 = 10.0;
/// Ratio of the upper end of a linear slider to the value.
const LINEAR_RATIO: f64 = 3.0;

/// Returns all controls: first the keys of the file in its order, then the keys with defaults.
pub fn controls(design: &Design) -> Vec<Value> {
    let file_leaves = leaves(&design.file.text());
    let mut keys: Vec<(String, Option<String>)> = file_leaves
        .into_iter()
        .map(|(path, text)| (path, Some(text)))
        .collect();
    for (path, _) in leaves(&design.spec.to_toml()) {
        let is_spring = path.starts_with("mass.") && path.ends_with(".stiffness");
        if !keys.iter().any(|(key, _)| *key == path) && !is_spring {
            keys.push((path, None));
        }
    }
    let find_control = |(path, text): &(String, Option<String>)| {
        control(
            design,
            &NumericKey::find(&design.spec, path).ok()?,
            text.as_deref(),
        )
    };
    keys.iter().filter_map(find_control).collect()
}

/// Returns the dotted paths of all leaves of a document with their texts.
fn leaves(text: &str) -> Vec<(String, String)> {
    let mut leaves = Vec::new();
    if let Ok(document) = text.parse::<DocumentMut>() {
        for (name, item) in document.iter() {
            collect_leaves(name.to_owned(), item, &mut leaves);
        }
    }
    leaves
}

fn collect_leaves(path: String, item: &Item, leaves: &mut Vec<(String, String)>) {
    match item.as_table_like() {
        Some(table) => table
            .iter()
            .for_each(|(name, item)| collect_leaves(format!("{path}.{name}"), item, leaves)),
        None => leaves.push((path, item.as_str().unwrap_or_default().to_owned())),
    }
}

/// Creates one control. Numbers are shown in the unit of the file; `factor` is the size of this
/// unit in SI.
fn control(design: &Design, key: &NumericKey, file_text: Option<&str>) -> Option<Value> {
    let value = key.get(&design.spec).ok()?;
    let value_text = key.show(value);
    let number_and_unit = [file_text.unwrap_or_default(), &value_text]
        .into_iter()
        .find_map(split);
    let (unit, factor) = match number_and_unit {
        Some((number, unit)) if number != 0.0 => (unit, value / number),
        _ => (key.unit(), 1.0),
    };
    let (low, high) = key.limits();
    let scale = slider_scale(key, value, low);
    let (from, to) = slider_ends(&scale, value, (low, high));
    Some(json!({
        "key": key.path(), "value": value, "shown": value_text, "unit": unit, "factor": factor, "about": key.about(),
        "scale": scale, "from": from, "to": to, "count": key.is_count(), "written": file_text.is_some(),
    }))
}

/// Splits a text into number and unit.
fn split(text: &str) -> Option<(f64, String)> {
    let end = text
        .find(|letter: char| !letter.is_ascii_digit() && !"+-.eE".contains(letter))
        .unwrap_or(text.len());
    Some((text[..end].parse().ok()?, text[end..].trim().to_owned()))
}

/// Lengths, frequencies, angles and plain numbers have a linear scale; quantities over decades have
/// a logarithmic one.
fn slider_scale(key: &NumericKey, value: f64, low: f64) -> String {
    let linear = matches!(key.unit().as_str(), "m" | "Hz" | "s" | "rad" | "") || key.is_count();
    if linear || value <= 0.0 || low < 0.0 && key.path().ends_with(".d31") {
        "linear"
    } else {
        "log"
    }
    .to_owned()
}

fn slider_ends(scale: &str, value: f64, (low, high): (f64, f64)) -> (f64, f64) {
    let (from, to) = match scale {
        "log" => (value / LOG_RATIO, value * LOG_RATIO),
        _ if value == 0.0 => (if low < 0.0 { -1.0 } else { 0.0 }, 1.0),
        _ if value < 0.0 => (LINEAR_RATIO * value, 0.0),
        _ => (0.02 * value, LINEAR_RATIO * value),
    };
    (from.max(low), to.min(high))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use crate::source::Source;

    #[test]
    fn every_number_of_the_paper_has_a_control() {
        let path = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../../examples/impact-harvester-2019/harvester.toml"
        );
        let design = Design::read(&Source::File(path.into()), &[]).unwrap();
        let keys = controls(&design);
        let find = |key: &str| {
            keys.iter()
                .find(|control| control["key"] == key)
                .cloned()
                .unwrap_or_default()
        };
        let gap = find("stop.tip.gap");
        assert_eq!(
            (&gap["unit"], &gap["scale"]),
            (&json!("mm"), &json!("linear"))
        );
        assert_eq!(split("0.5 mm"), Some((0.5, "mm".to_owned())));
        assert_eq!(split("1e-3m"), Some((1e-3, "m".to_owned())));
        assert_eq!(split("table"), None);
        assert!((gap["factor"].as_f64().unwrap() - 1e-3).abs() < 1e-15);
        let load = find("circuit.load.resistance");
        assert_eq!(
            (&load["scale"], load["from"].as_f64(), load["to"].as_f64()),
            (&json!("log"), Some(1e5), Some(1e7))
        );
        assert_eq!(find("beam.beam.point.tip")["written"], json!(true));
        assert!(
            find("drive.shaker.phase")["written"] == json!(false)
                || find("drive.shaker.phase").is_null()
        );
        assert!(find("run.start").is_null() && find("drive.shaker.at").is_null());
    }
}
