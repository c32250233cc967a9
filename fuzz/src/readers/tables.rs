//! Tables of jounce, as `jounce rerun` and studies read them.

use crate::scratch;
use jounce_io::table::{StoredTable, Table};
use std::path::Path;

/// A table that was read is written to a file that reads back to the same table.
fn check(path: &Path, ending: &str) {
    let (stored, read) = (StoredTable::read(path), Table::read(path));
    let Ok((table, manifest)) = read else {
        return assert!(stored.is_err());
    };
    let written = scratch::folder().join(format!("written.{ending}"));
    table.write(&written, &manifest).expect("it was read");
    let again = StoredTable::read(&written).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(stored.expect("it was read"), again);
}

/// Notes and table, separated by a line `====`.
pub fn csv(data: &[u8]) {
    let [notes, table] = scratch::parts(data);
    scratch::file("table.manifest.json", notes);
    check(&scratch::file("table.csv", table), "csv");
}

pub fn html(data: &[u8]) {
    let begin = b"<script type=\"application/json\" id=\"table\">".as_slice();
    let bytes = [begin, data, b"</script></html>"].concat();
    check(&scratch::file("table.html", &bytes), "parquet");
}

pub fn parquet(data: &[u8]) {
    check(&scratch::file("table.parquet", data), "parquet");
}

pub fn json(data: &[u8]) {
    if let Ok(table) = StoredTable::read(&scratch::file("table.json", data)) {
        assert_eq!(table.first_difference(&table), None);
    }
}
