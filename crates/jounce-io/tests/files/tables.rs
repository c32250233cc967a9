//! Tables written and read again, and tables that are refused.

use jounce_io::table::{Column, Manifest, Table, TableError, Values};

fn awkward() -> Table {
    let floats = vec![
        0.1 + 0.2,
        -0.0,
        f64::NAN,
        5e-324,
        f64::MAX,
        f64::NEG_INFINITY,
        1e-7,
        7.023_747_569_4e-5,
    ];
    let texts = [
        "plain",
        "comma, quote \" and\nnewline",
        "",
        "µΩ",
        " ",
        "NaN",
        "1",
        "'",
    ];
    Table::new(vec![
        Column::new("power_w", "W", "mean power", floats),
        Column::new(
            "shift",
            "",
            "signed",
            vec![i64::MIN, -1, 0, 1, 2, 3, 4, i64::MAX],
        ),
        Column::new(
            "contacts",
            "",
            "count",
            vec![0u64, 1, 2, 3, 4, 5, 1 << 53 | 1, u64::MAX],
        ),
        Column::new(
            "settled",
            "",
            "yes or no",
            vec![true, false, true, true, false, false, true, false],
        ),
        Column::new("label", "", "text", texts.map(str::to_owned).to_vec()),
    ])
    .unwrap()
}

fn manifest() -> Manifest {
    Manifest::new("00ff")
        .with("command", "sweep")
        .with("over", "drive.shaker.frequency=4Hz:20Hz:0.1Hz")
        .with("seed", 7)
}

/// True where the bits are equal; `==` differs for NaN and -0.
fn same_bits(a: &Table, b: &Table) -> bool {
    let bits = |t: &Table| {
        t.floats("power_w")
            .unwrap()
            .iter()
            .map(|x| x.to_bits())
            .collect::<Vec<_>>()
    };
    bits(a) == bits(b) && a.columns()[1..] == b.columns()[1..]
}

#[test]
fn csv_and_parquet_round_trip_bit_for_bit() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["t.csv", "t.parquet"] {
        let path = folder.path().join(name);
        awkward().write(&path, &manifest()).unwrap();
        let (table, read) = Table::read(&path).unwrap();
        assert!(same_bits(&table, &awkward()), "{name}: {table:?}");
        assert_eq!(read, manifest(), "{name}");
        assert_eq!(table.columns()[0].unit, "W");
    }
}

#[test]
fn the_same_table_gives_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["t.csv", "t.parquet", "t.json"] {
        let (a, b) = (
            folder.path().join(name),
            folder.path().join(format!("again-{name}")),
        );
        awkward().write(&a, &manifest()).unwrap();
        awkward().write(&b, &manifest()).unwrap();
        assert_eq!(
            std::fs::read(&a).unwrap(),
            std::fs::read(&b).unwrap(),
            "{name}"
        );
    }
}

#[test]
fn empty_tables_survive() {
    let folder = tempfile::tempdir().unwrap();
    let no_rows = Table::new(vec![Column::new("a", "m", "", Vec::<f64>::new())]).unwrap();
    for (name, table) in [
        ("a.csv", &no_rows),
        ("a.parquet", &no_rows),
        ("b.csv", &Table::default()),
        ("b.parquet", &Table::default()),
    ] {
        let path = folder.path().join(name);
        table.write(&path, &manifest()).unwrap();
        assert_eq!(&Table::read(&path).unwrap().0, table, "{name}");
    }
}

#[test]
fn unequal_lengths_and_double_names_are_errors() {
    let two = || Column::new("a", "", "", vec![1.0, 2.0]);
    let three = Column::new("b", "", "", vec![1.0, 2.0, 3.0]);
    assert!(matches!(
        Table::new(vec![two(), three]),
        Err(TableError::Lengths {
            rows: 3,
            expected: 2,
            ..
        })
    ));
    assert!(matches!(
        Table::new(vec![two(), two()]),
        Err(TableError::Name { .. })
    ));
}

#[test]
fn unwritable_or_unreadable_path_is_an_error() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    std::fs::write(at("file"), b"").unwrap();
    assert!(matches!(
        awkward().write(&at("file/t.csv"), &manifest()),
        Err(TableError::Store(_))
    ));
    assert!(matches!(
        awkward().write(&at("t.xls"), &manifest()),
        Err(TableError::Format { .. })
    ));
    for name in ["t.csv", "t.parquet"] {
        assert!(
            matches!(Table::read(&at(name)), Err(TableError::Read { .. })),
            "{name} is missing"
        );
        std::fs::write(at(name), b"\xff\x00garbage").unwrap();
        assert!(
            matches!(Table::read(&at(name)), Err(TableError::Read { .. })),
            "{name} is garbage"
        );
    }
}

/// The notes of a CSV file are a file of their own. Where the table cannot be replaced, they stay
/// those of the older table.
#[test]
fn a_table_and_its_notes_are_replaced_together() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("t.csv");
    let table = |power_w: f64| {
        let column = Column::new("power_w", "W", "", vec![power_w]);
        Table::new(vec![column]).unwrap()
    };
    let set_read_only = |is_read_only: bool| {
        let mut permissions = std::fs::metadata(&path).unwrap().permissions();
        permissions.set_readonly(is_read_only);
        std::fs::set_permissions(&path, permissions).unwrap();
    };
    table(1.0).write(&path, &Manifest::new("old")).unwrap();
    set_read_only(true);
    let new = Manifest::new("new");
    assert!(table(2.0).write(&path, &new).is_err());
    let joined = [Ok::<_, TableError>(table(2.0))];
    assert!(Table::write_joined(&path, &new, joined).is_err());
    let failing = [Ok(table(2.0)), Err(TableError::Name { column: "a".into() })];
    assert!(Table::write_joined(&path, &new, failing).is_err());
    let (stored, notes) = Table::read(&path).unwrap();
    assert_eq!((stored, notes.spec_sha256.as_str()), (table(1.0), "old"));
    set_read_only(false);
    table(2.0).write(&path, &new).unwrap();
    assert_eq!(Table::read(&path).unwrap(), (table(2.0), new));
}

/// Tables of other names, units or kinds are refused in every format, and nothing is written.
#[test]
fn joined_tables_have_the_same_columns() {
    let folder = tempfile::tempdir().unwrap();
    let table = |name: &str, unit: &str, values: Values| {
        Table::new(vec![Column::new(name, unit, "", values)]).unwrap()
    };
    let first = || table("power_w", "W", Values::Float(vec![1.0]));
    let others = [
        table("power_mw", "W", Values::Float(vec![2.0])),
        table("power_w", "mW", Values::Float(vec![2.0])),
        table("power_w", "W", Values::Count(vec![2])),
    ];
    for name in ["t.csv", "t.parquet"] {
        let path = folder.path().join(name);
        for other in &others {
            let tables = [Ok::<_, TableError>(first()), Ok(other.clone())];
            let error = Table::write_joined(&path, &manifest(), tables).unwrap_err();
            assert!(error.to_string().contains("different columns"), "{error}");
            assert!(!path.exists());
        }
        let tables = [Ok::<_, TableError>(first()), Ok(first())];
        Table::write_joined(&path, &manifest(), tables).unwrap();
        assert_eq!(Table::read(&path).unwrap().0.rows(), 2);
    }
}
