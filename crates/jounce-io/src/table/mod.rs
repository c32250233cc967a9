//! Named columns with units, written to files that other programs read.
//!
//! | format | holds | floats |
//! |---|---|---|
//! | CSV | header = column names (the unit is the suffix: `frequency_hz`); the rest in a sidecar `NAME.manifest.json` | shortest text that reads back to the same bits |
//! | Parquet | typed columns, snappy; units, descriptions and manifest under the key `jounce` | bit for bit |
//! | JSON | `columns`, `units`, `about`, `manifest` | shortest text; NaN and infinities become `null` |
//! | HTML | an element of a page: notes and `values` in JSON | shortest text; NaN and infinities as text |
//!
//! Every file is written atomically and contains no time, so the same table gives identical bytes.
//!
//! pandas reads the CSV exactly with `read_csv(path, float_precision="round_trip")`.
mod column;
mod csv;
mod error;
mod json;
mod manifest;
mod named_columns;
mod notes;
mod page;
mod parquet;
mod record;
mod stored;

pub use column::{Column, Values};
pub use error::TableError;
pub use manifest::Manifest;
pub use named_columns::Table;
pub use record::{Record, RecordedInput};
pub use stored::{StoredTable, TableDifference};
