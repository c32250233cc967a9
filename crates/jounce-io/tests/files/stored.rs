//! Stored tables compared in every format.

use jounce_io::table::{Column, Manifest, StoredTable, Table, TableError};

/// Writes a table in a format and reads it back.
fn stored(format: &str, values: Vec<f64>, unit: &str) -> StoredTable {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("t").with_extension(format);
    let names = vec!["a".to_owned(); values.len()];
    let columns = vec![
        Column::new("name", "", "", names),
        Column::new("power_w", unit, "mean power", values),
    ];
    Table::new(columns)
        .unwrap()
        .write(&path, &Manifest::new("ab"))
        .unwrap();
    StoredTable::read(&path).unwrap()
}

#[test]
fn the_last_bit_of_a_value_is_a_difference_in_every_format() {
    let value = 0.1 + 0.2;
    let next = f64::from_bits(f64::to_bits(value) + 1);
    for format in ["csv", "parquet", "json"] {
        let table = stored(format, vec![1.0, value, -0.0], "W");
        assert_eq!(
            table.first_difference(&stored(format, vec![1.0, value, -0.0], "W")),
            None
        );
        assert_eq!((table.width(), table.rows()), (2, 3));
        let difference = table
            .first_difference(&stored(format, vec![1.0, next, -0.0], "W"))
            .unwrap();
        assert_eq!(
            (difference.column.as_str(), difference.row),
            ("power_w", Some(2))
        );
        assert_eq!(
            (difference.first.as_str(), difference.second.as_str()),
            ("0.30000000000000004", "0.3000000000000001")
        );
        let difference = table
            .first_difference(&stored(format, vec![1.0, value, 0.0], "W"))
            .unwrap();
        assert_eq!(
            (difference.row, difference.first.as_str()),
            (Some(3), "-0.0")
        );
    }
}

#[test]
fn units_and_rows_are_compared_too() {
    let table = stored("csv", vec![1.0], "W");
    let unit = table
        .first_difference(&stored("csv", vec![1.0], "mW"))
        .unwrap();
    assert_eq!(
        (unit.what, unit.first.as_str(), unit.second.as_str()),
        ("unit", "W", "mW")
    );
    let rows = table
        .first_difference(&stored("csv", vec![1.0, 2.0], "W"))
        .unwrap();
    assert_eq!(
        (rows.what, rows.column.as_str(), rows.first.as_str()),
        ("rows", "name", "1")
    );
}

#[test]
fn a_json_file_of_another_program_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("t.json");
    for text in [
        "{}",
        "[1]",
        "{",
        "{\"columns\": {}, \"units\": {}, \"about\": {}, \"manifest\": {}}",
    ] {
        std::fs::write(&path, text).unwrap();
        assert!(
            matches!(StoredTable::read(&path), Err(TableError::Read { .. })),
            "{text}"
        );
    }
}
