//! An event has one marker in pictures of the program, of the Python package and on the page.

use jounce_plot::{Axis, BifurcationLine, Colour, Marker, bifurcations, event_marker};

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

/// The colour of a curve is that of its kind, in whatever order curves are found.
#[test]
fn a_kind_has_one_colour_in_every_picture() {
    let line = |kind: &str| BifurcationLine {
        kind: kind.to_owned(),
        x: vec![1.0, 2.0],
        y: vec![1.0, 2.0],
    };
    let axis = || Axis::linear("Frequency", "Hz");
    let colour = |kinds: &[&str], of: &str| {
        let lines: Vec<_> = kinds.iter().map(|kind| line(kind)).collect();
        let figure = bifurcations("a", axis(), axis(), &lines);
        let named = figure.panels[0].series.iter();
        let mut named = named.filter(|series| series.label.as_deref() == Some(of));
        named.next().unwrap().colour
    };
    let alone = KINDS.map(|kind| colour(&[kind], kind));
    for (kind, alone) in KINDS.into_iter().zip(alone) {
        assert_eq!(colour(&["peak", "grazing", kind], kind), alone);
    }
    let distinct: Vec<_> = (0..6)
        .filter(|k| !alone[..*k].contains(&alone[*k]))
        .collect();
    assert_eq!(distinct.len(), KINDS.len());
    let periods = [1, 2, 3, 4, 5, 6].map(Colour::of_period);
    assert!((0..6).all(|k| !periods[..k].contains(&periods[k])));
    // The Python package has the same colours.
    let python = file("python/jounce/_plot/style.py");
    for (k, kind) in KINDS.iter().enumerate() {
        let number = (0..6).find(|n| Colour::nth(*n) == alone[k]).unwrap();
        assert!(python.contains(&format!("\"{kind}\": COLOURS[{number}]")));
    }
}

#[test]
fn an_event_has_one_marker_everywhere() {
    let (page, python) = (
        file("web/src/bifurcations.ts").replace('"', ""),
        file("python/jounce/_plot/branch.py"),
    );
    for kind in KINDS {
        let [shape, letter] = names(event_marker(kind));
        let (start, mark) = (format!("{kind}: "), format!("shape: {shape},"));
        let mut lines = page.lines().map(str::trim);
        let has_shape = lines.any(|line| line.starts_with(&start) && line.contains(&mark));
        assert!(has_shape, "{kind} {shape}");
        assert!(
            python.contains(&format!("\"{kind}\": {letter}")),
            "{kind} {letter}"
        );
    }
    let [_, letter] = names(event_marker("mean_power=1 mW"));
    assert!(python.contains(&format!("\"level\": {letter}")));
}
