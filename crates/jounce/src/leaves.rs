//! Values of a TOML text with their dotted paths.

use toml_edit::{DocumentMut, Item};

/// Returns the dotted paths of all leaves of a document with their texts.
pub fn leaves(text: &str) -> Vec<(String, String)> {
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
