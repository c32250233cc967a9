//! Names and units of channels from texts in the same struct.

use super::spacing::plain;
use super::{Array, Path, Tree};
use crate::read::heading::name;

/// Names of texts that contain a unit or a channel name, in lower case without underscores.
const UNIT_KEYS: [&str; 4] = ["unit", "units", "unitlabel", "yunit"];
const NAME_KEYS: [&str; 7] = [
    "name",
    "names",
    "label",
    "labels",
    "channelname",
    "channelnames",
    "channels",
];

/// Name and unit of each series of an array. Texts of the struct apply only if the array
/// `is_alone`, the only data array in it.
pub(super) fn heads(tree: &Tree, array: &Array, is_alone: bool) -> Vec<(String, String)> {
    let count = array.series.len();
    let texts_for = |names: &[&str]| {
        if is_alone {
            texts_in_scope(tree, array, names, count)
        } else {
            None
        }
    };
    let quantity = Path(array.path.scope().to_vec()).to("quantity");
    let of_quantity = || {
        tree.text_at(&quantity.0, "label")
            .filter(|_| is_alone)
            .cloned()
    };
    let units = unit_of_array(tree, array)
        .or_else(|| texts_for(&UNIT_KEYS))
        .or_else(of_quantity);
    let names = texts_for(&NAME_KEYS);
    let head = |k: usize| {
        let label = array.labels.get(k).map_or("", String::as_str);
        let by_name = || name::split(array.path.name()).1;
        let unit = units
            .as_ref()
            .and_then(|units| units.get(k).or(units.first()))
            .cloned()
            .unwrap_or_else(by_name);
        match names
            .as_ref()
            .and_then(|names| names.get(k))
            .filter(|name| !name.is_empty())
        {
            Some(name) => (name.clone(), unit),
            None => (format!("{}{label}", array.path), unit),
        }
    };
    (0..count).map(head).collect()
}

/// Unit stored with the array, or in a text `NAME_unit`.
fn unit_of_array(tree: &Tree, array: &Array) -> Option<Vec<String>> {
    if !array.unit.is_empty() {
        return Some(vec![array.unit.clone()]);
    }
    let name = array.path.name();
    let found_units = ["_unit", "_units", "Unit", "Units"]
        .iter()
        .find_map(|suffix| tree.text_at(array.path.scope(), &format!("{name}{suffix}")));
    found_units
        .filter(|units| units.len() == 1 || units.len() == array.series.len())
        .cloned()
}

/// Returns the texts of one of these names in the same struct, if there are as many as series.
fn texts_in_scope(tree: &Tree, array: &Array, names: &[&str], count: usize) -> Option<Vec<String>> {
    let texts = tree.texts.get(array.path.scope())?;
    texts
        .iter()
        .find(|(name, texts)| names.contains(&plain(name).as_str()) && texts.len() == count)
        .map(|(_, texts)| texts.clone())
}
