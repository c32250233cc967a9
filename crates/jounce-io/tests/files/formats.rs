//! Tables as other programs see them.

use jounce_io::table::{Column, Manifest, Table};
use parquet::basic::Compression;
use parquet::file::reader::{FileReader, SerializedFileReader};
use serde_json::Value;
use std::fs::File;

#[test]
fn any_parquet_reader_sees_the_types_and_the_notes() {
    let table = Table::new(vec![
        Column::new("power_w", "W", "mean power", vec![1.0, f64::NAN]),
        Column::new("contacts", "", "", vec![0u64, u64::MAX]),
        Column::new("label", "", "", vec!["a".to_owned(), "b".to_owned()]),
    ])
    .unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("t.parquet");
    table.write(&path, &Manifest::new("ab")).unwrap();
    let reader = SerializedFileReader::new(File::open(&path).unwrap()).unwrap();
    let row = reader.get_row_iter(None).unwrap().nth(1).unwrap().unwrap();
    let row: Vec<_> = row
        .get_column_iter()
        .map(|(name, field)| format!("{name}={field}"))
        .collect();
    assert_eq!(
        row,
        [
            "power_w=NaN",
            "contacts=18446744073709551615",
            "label=\"b\""
        ]
    );
    assert_eq!(
        reader.metadata().row_group(0).column(0).compression(),
        Compression::SNAPPY
    );
    assert_eq!(Table::read(&path).unwrap().0.columns()[0].unit, "W");
}

#[test]
fn numbers_of_json_read_back_exactly_and_nan_is_null() {
    let numbers = vec![0.1 + 0.2, 5e-324, -0.0, f64::NAN, f64::INFINITY];
    let table = Table::new(vec![Column::new("power_w", "W", "mean power", numbers)]).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("t.json");
    table.write(&path, &Manifest::new("ab")).unwrap();
    let value: Value = serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
    let read: Vec<_> = value["columns"]["power_w"]
        .as_array()
        .unwrap()
        .iter()
        .map(Value::as_f64)
        .collect();
    assert_eq!(
        read,
        [Some(0.1 + 0.2), Some(5e-324), Some(-0.0), None, None]
    );
    assert!(read[2].unwrap().is_sign_negative());
    assert_eq!(value["units"]["power_w"], "W");
    assert_eq!(value["manifest"]["spec_sha256"], "ab");
}

#[test]
fn csv_matches_spreadsheet_conventions() {
    let columns = vec![
        Column::new(
            "frequency_hz",
            "Hz",
            "drive frequency",
            vec![4.0, 0.1 + 0.2, 1e-7],
        ),
        Column::new("settled", "", "", vec![true, false, true]),
        Column::new(
            "note",
            "",
            "",
            vec!["a,b".to_owned(), String::new(), "say \"no\"".to_owned()],
        ),
    ];
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("sweep.csv");
    Table::new(columns)
        .unwrap()
        .write(&path, &Manifest::new("ab"))
        .unwrap();
    let expected = "frequency_hz,settled,note\n4.0,true,\"a,b\"\n0.30000000000000004,false,\n1e-7,true,\"say \"\"no\"\"\"\n";
    assert_eq!(std::fs::read_to_string(&path).unwrap(), expected);
    assert!(folder.path().join("sweep.manifest.json").is_file());
}

#[test]
fn a_header_that_was_edited_is_an_error() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("t.csv");
    Table::new(vec![Column::new("a", "", "", vec![1.0])])
        .unwrap()
        .write(&path, &Manifest::new(""))
        .unwrap();
    std::fs::write(&path, "b\n1.0\n").unwrap();
    let message = Table::read(&path).unwrap_err().to_string();
    assert!(message.contains("header"), "{message}");
}
