//! Rows of `expected.toml` of an example.

use std::path::{Path, PathBuf};

/// Folder of an example.
pub fn folder(example: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../examples")
        .join(example)
}

fn expected(example: &str) -> toml_edit::DocumentMut {
    std::fs::read_to_string(folder(example).join("expected.toml"))
        .unwrap()
        .parse()
        .unwrap()
}

/// Every row of `expected.toml` must be among the computed ones and lie within its tolerance, and
/// every computed one must have a row.
pub fn check(example: &str, computed: &[(&str, f64)]) {
    let document = expected(example);
    assert_eq!(document.len(), computed.len());
    for (name, _) in document.iter() {
        let (_, value) = computed
            .iter()
            .find(|(computed, _)| *computed == name)
            .unwrap_or_else(|| panic!("{name} is not computed"));
        check_row(example, name, *value);
    }
}

/// Checks one row of `expected.toml`.
pub fn check_row(example: &str, name: &str, value: f64) {
    let document = expected(example);
    let row = document
        .get(name)
        .unwrap_or_else(|| panic!("{example} expects no {name}"));
    let number = |key: &str| row[key].as_float().unwrap();
    let difference = (value / number("value") - 1.0).abs();
    eprintln!(
        "{example} {name}: {value} against {} ({difference:.1e})",
        number("value")
    );
    assert!(
        difference <= number("allowed"),
        "{example} {name}: {value} against {}",
        number("value")
    );
}
