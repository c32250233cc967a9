//! What jounce noted of a file that it wrote: in the metadata of Parquet, in `NAME.manifest.json` beside `NAME.csv`.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Deserialize;

use super::name;
use super::raw::RawColumn;

/// What stands before the name of a channel in the notes that tell where it was measured.
pub const PLACE: &str = "place of ";
/// The same for its direction.
pub const DIRECTION: &str = "direction of ";
/// The same for where the force of a response function acts.
pub const REFERENCE: &str = "reference of ";

/// The notes of a file of columns.
#[derive(Deserialize)]
pub(super) struct WrittenNotes {
    manifest: Manifest,
    columns: Vec<NotedChannel>,
}

/// Of the manifest, what a reader needs.
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
    /// The notes of a text; none where it is not of jounce.
    pub(super) fn from_json(text: &str) -> Option<Self> {
        serde_json::from_str(text).ok()
    }

    /// The notes beside a text of columns; none where there are none, or where they tell of other columns.
    pub(super) fn beside(path: &Path, columns: &[RawColumn]) -> Option<Self> {
        let found =
            Self::from_json(&std::fs::read_to_string(path.with_extension("manifest.json")).ok()?)?;
        let of_these = found
            .columns
            .iter()
            .map(|noted| name::split(&noted.name).0)
            .eq(columns.iter().map(|column| column.name.clone()));
        of_these.then_some(found)
    }

    /// The unit of a column.
    pub(super) fn unit(&self, head: &str) -> Option<String> {
        self.columns
            .iter()
            .find(|column| column.name == head)
            .map(|column| column.unit.clone())
    }

    /// Tells a column where it was measured, which way, and against what.
    pub(super) fn tell(&self, column: &mut RawColumn) {
        // Both parts of a complex channel have one place.
        let name = column.name.strip_suffix(".re").unwrap_or(&column.name);
        let told = |key: &str| {
            self.manifest
                .options
                .get(&format!("{key}{name}"))
                .cloned()
                .unwrap_or_default()
        };
        (column.place, column.direction, column.reference) =
            (told(PLACE), told(DIRECTION), told(REFERENCE));
    }
}
