//! Notes that jounce writes with a file: in the metadata of Parquet, in `NAME.manifest.json` next
//! to `NAME.csv`.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Deserialize;

use crate::read::column::raw::RawColumn;
use crate::read::heading::name;

/// Prefix of a channel name in the notes that give its node.
pub const PLACE: &str = "place of ";
/// Prefix of a channel name in the notes that give its direction.
pub const DIRECTION: &str = "direction of ";
/// Prefix of a channel name in the notes that give the location of the force of a response
/// function.
pub const REFERENCE: &str = "reference of ";

/// Notes of a file of columns.
#[derive(Deserialize)]
pub(in crate::read) struct WrittenNotes {
    manifest: Manifest,
    columns: Vec<NotedChannel>,
}

/// Fields of the manifest that the reader needs.
#[derive(Deserialize)]
struct Manifest {
    options: BTreeMap<String, String>,
}

#[derive(Deserialize)]
struct NotedChannel {
    name: String,
    unit: String,
}

impl WrittenNotes {
    /// Parses the notes; `None` if they are not from jounce.
    pub(in crate::read) fn from_json(text: &str) -> Option<Self> {
        serde_json::from_str(text).ok()
    }

    /// Notes for a text file of columns; `None` if absent or about other columns.
    pub(in crate::read) fn for_file(path: &Path, columns: &[RawColumn]) -> Option<Self> {
        let result =
            Self::from_json(&std::fs::read_to_string(path.with_extension("manifest.json")).ok()?)?;
        let of_these = result
            .columns
            .iter()
            .map(|channel| name::split(&channel.name).0)
            .eq(columns.iter().map(|column| column.name.clone()));
        of_these.then_some(result)
    }

    /// Returns the unit of a column.
    pub(in crate::read) fn unit(&self, head: &str) -> Option<String> {
        self.columns
            .iter()
            .find(|column| column.name == head)
            .map(|column| column.unit.clone())
    }

    /// Sets node, direction and reference of a column.
    pub(in crate::read) fn apply_to(&self, column: &mut RawColumn) {
        // Both parts of a complex channel have the same location.
        let name = column.name.strip_suffix(".re").unwrap_or(&column.name);
        let attribute = |key: &str| {
            self.manifest
                .options
                .get(&format!("{key}{name}"))
                .cloned()
                .unwrap_or_default()
        };
        (column.place, column.direction, column.reference) =
            (attribute(PLACE), attribute(DIRECTION), attribute(REFERENCE));
    }
}
