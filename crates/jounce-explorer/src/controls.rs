//! The controls of a page: every number of the spec, with its unit and a sensible range.

use crate::design::Design;
use jounce::spec::NumericKey;
use serde_json::{Value, json};
use toml_edit::{DocumentMut, Item};

/// A slider goes from the value divided by this to the value times this where it is logarithmic.
const DECADE: f64 = 10.0;
/// And up to the value times this where it is linear.
const LINEAR: f64 = 3.0;

/// All controls: first the keys of the file in its order, then those that have defaults.
pub fn controls(design: &Design) -> Vec<Value> {
    let written = paths(&design.file.text());
    let mut all = written.clone();
    for path in paths(&design.spec.to_toml()) {
        let is_spring = path.starts_with("mass.") && path.ends_with(".stiffness");
        if !all.contains(&path) && !is_spring {
            all.push(path);
        }
    }
    let find = |path: &String| NumericKey::find(&design.spec, path).ok().map(|key| (key, written.contains(path)));
    all.iter().filter_map(find).filter_map(|(key, written)| control(design, &key, written)).collect()
}

/// Dotted paths of all leaves of a document.
fn paths(text: &str) -> Vec<String> {
    let mut found = Vec::new();
    if let Ok(document) = text.parse::<DocumentMut>() {
        for (name, item) in document.iter() {
            gather(name.to_owned(), item, &mut found);
        }
    }
    found
}

fn gather(path: String, item: &Item, found: &mut Vec<String>) {
    match item.as_table_like() {
        Some(table) => table.iter().for_each(|(name, item)| gather(format!("{path}.{name}"), item, found)),
        None => found.push(path),
    }
}

/// One control. Numbers are shown in the unit that the file has: `factor` is its size in SI.
fn control(design: &Design, key: &NumericKey, written: bool) -> Option<Value> {
    let value = key.get(&design.spec).ok()?;
    let shown = key.show(value);
    let (number, unit) = shown.split_once(' ').unwrap_or((shown.as_str(), ""));
    let number: f64 = number.parse().ok()?;
    let (unit, factor) = if number == 0.0 { (key.unit(), 1.0) } else { (unit.to_owned(), value / number) };
    let (low, high) = key.limits();
    let scale = scale(key, value, low);
    let (from, to) = ends(&scale, value, (low, high));
    Some(json!({
        "key": key.path(), "value": value, "shown": shown, "unit": unit, "factor": factor, "about": key.about(),
        "scale": scale, "from": from, "to": to, "count": key.is_count(), "written": written,
    }))
}

/// Lengths, frequencies, angles and plain numbers go in equal steps, what spans decades goes by ratios.
fn scale(key: &NumericKey, value: f64, low: f64) -> String {
    let linear = matches!(key.unit().as_str(), "m" | "Hz" | "s" | "rad" | "") || key.is_count();
    if linear || value <= 0.0 || low < 0.0 && key.path().ends_with(".d31") { "linear" } else { "log" }.to_owned()
}

fn ends(scale: &str, value: f64, (low, high): (f64, f64)) -> (f64, f64) {
    let (from, to) = match scale {
        "log" => (value / DECADE, value * DECADE),
        _ if value == 0.0 => (if low < 0.0 { -1.0 } else { 0.0 }, 1.0),
        _ if value < 0.0 => (LINEAR * value, 0.0),
        _ => (0.02 * value, LINEAR * value),
    };
    (from.max(low), to.min(high))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use std::path::Path;

    #[test]
    fn every_number_of_the_paper_has_a_control() {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/impact-harvester-2019/harvester.toml");
        let design = Design::read(Path::new(path), &[]).unwrap();
        let all = controls(&design);
        let find = |key: &str| all.iter().find(|control| control["key"] == key).cloned().unwrap_or_default();
        let gap = find("stop.tip.gap");
        assert_eq!((&gap["unit"], &gap["scale"]), (&json!("mm"), &json!("linear")));
        assert!((gap["factor"].as_f64().unwrap() - 1e-3).abs() < 1e-15);
        let load = find("circuit.load.resistance");
        assert_eq!((&load["scale"], load["from"].as_f64(), load["to"].as_f64()), (&json!("log"), Some(1e5), Some(1e7)));
        assert_eq!(find("beam.beam.point.tip")["written"], json!(true));
        assert!(find("drive.shaker.phase")["written"] == json!(false) || find("drive.shaker.phase").is_null());
        assert!(find("run.start").is_null() && find("drive.shaker.at").is_null());
    }
}
