//! The rows of `expected.toml` of an example.

use std::path::{Path, PathBuf};

/// Folder of an example.
pub fn folder(example: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples").join(example)
}

/// Every row of `expected.toml` must be among the computed ones and lie within what it allows; the other way round too.
pub fn check(example: &str, computed: &[(&str, f64)]) {
    let text = std::fs::read_to_string(folder(example).join("expected.toml")).unwrap();
    let document: toml_edit::DocumentMut = text.parse().unwrap();
    assert_eq!(document.len(), computed.len());
    for (name, row) in document.iter() {
        let number = |key: &str| row[key].as_float().unwrap();
        let (_, found) = computed.iter().find(|(computed, _)| *computed == name).unwrap_or_else(|| panic!("{name} is not computed"));
        let difference = (found / number("value") - 1.0).abs();
        eprintln!("{example} {name}: {found} against {} ({difference:.1e})", number("value"));
        assert!(difference <= number("allowed"), "{example} {name}: {found} against {}", number("value"));
    }
}
