//! An event has one marker in pictures of the program, of the Python package and on the page.

use jounce_plot::{Marker, event_marker};

/// Kinds of events.
const KINDS: [&str; 6] = [
    "fold",
    "period-doubling",
    "neimark-sacker",
    "branch-point",
    "grazing",
    "sticking",
];

/// Names of a marker on the page and in matplotlib.
fn names(marker: Marker) -> [&'static str; 2] {
    match marker {
        Marker::Square => ["square", "(\"s\", \"full\")"],
        Marker::Triangle => ["triangle", "(\"^\", \"full\")"],
        Marker::Diamond => ["diamond", "(\"D\", \"full\")"],
        Marker::Cross => ["cross", "(\"X\", \"full\")"],
        Marker::Circle => ["circle", "(\"o\", \"full\")"],
        Marker::Ring => ["ring", "(\"o\", \"none\")"],
        Marker::Right => ["", "(\">\", \"full\")"],
        Marker::Left => ["", ""],
    }
}

/// Text of a file of the repository.
fn file(path: &str) -> String {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    std::fs::read_to_string(root.join(path)).unwrap()
}

#[test]
fn an_event_has_one_marker_everywhere() {
    let (page, python) = (
        file("web/src/response.ts").replace('"', ""),
        file("python/jounce/_plot/branch.py"),
    );
    for kind in KINDS {
        let [shape, letter] = names(event_marker(kind));
        assert!(page.contains(&format!("{kind}: {shape}")), "{kind} {shape}");
        assert!(
            python.contains(&format!("\"{kind}\": {letter}")),
            "{kind} {letter}"
        );
    }
    let [_, letter] = names(event_marker("mean_power=1 mW"));
    assert!(python.contains(&format!("\"level\": {letter}")));
}
