//! Every folder of `examples/` has a spec, a page, expected numbers and a picture that the page
//! shows.

use crate::rows::folder;
use jounce_spec::SpecFile;

/// Files that are not specs of a harvester.
const BESIDE: [&str; 4] = [
    "expected.toml",
    "measured.toml",
    "study.toml",
    "design.toml",
];

#[test]
fn every_example_is_complete() {
    let folders: Vec<_> = std::fs::read_dir(folder(""))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.is_dir())
        .collect();
    assert!(folders.len() >= 15, "{folders:?}");
    for path in folders {
        let names: Vec<String> = std::fs::read_dir(&path)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        let page = std::fs::read_to_string(path.join("README.md"))
            .unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let expected: toml_edit::DocumentMut = std::fs::read_to_string(path.join("expected.toml"))
            .unwrap()
            .parse()
            .unwrap();
        assert!(
            expected.len() >= 2,
            "{}: {} rows",
            path.display(),
            expected.len()
        );
        let pictures: Vec<&String> = names.iter().filter(|name| name.ends_with(".svg")).collect();
        assert!(!pictures.is_empty(), "{} has no picture", path.display());
        assert!(
            pictures
                .iter()
                .all(|name| page.contains(&format!("]({name})"))),
            "{}: a picture is not on the page",
            path.display()
        );
        let specs: Vec<&String> = names
            .iter()
            .filter(|name| name.ends_with(".toml") && !BESIDE.contains(&name.as_str()))
            .collect();
        assert!(!specs.is_empty(), "{} has no spec", path.display());
        for name in specs {
            SpecFile::read(path.join(name))
                .unwrap()
                .spec()
                .unwrap_or_else(|faults| panic!("{}/{name}: {faults}", path.display()));
        }
    }
}
