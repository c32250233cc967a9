//! Faults of a text.

use crate::example_folder;
use jounce_analysis::study::{Study, StudyError};

/// A text and a part of its error.
const INVALID: [(&str, &str); 18] = [
    ("", "names no spec"),
    ("spec = ", "not valid TOML"),
    ("spec = \"none.toml\"", "none.toml"),
    ("spec = \"harvester.toml\"", "vary names no key"),
    (
        "spec = \"harvester.toml\"\nsampling = \"sobol\"\n[vary]\n\"stop.tip.gap\" = \"1mm:2mm\"",
        "points is missing",
    ),
    (
        "spec = \"harvester.toml\"\nsampling = \"random\"\npoints = 3\n[vary]\n\"stop.tip.gap\" = \"1mm:2mm:3x\"",
        "range",
    ),
    (
        "spec = \"harvester.toml\"\npoints = 3\n[vary]\n\"stop.tip.gap\" = \"1mm\"",
        "does not go with",
    ),
    (
        "spec = \"harvester.toml\"\n[vary]\n\"stop.tip.gap\" = \"1mm:2mm:9x\"\n\"stop.tip.stiffness\" = \"1N/m^1.5:2N/m^1.5:1000000x\"\n\"drive.shaker.frequency\" = \"1Hz:2Hz:1000x\"",
        "more than",
    ),
    (
        "spec = \"harvester.toml\"\n[set]\n\"stop.tip.gap\" = \"1kg\"\n[vary]\n\"stop.tip.gap\" = \"1mm\"",
        "kg",
    ),
    (
        "spec = \"harvester.toml\"\n[vary.stop]\ntip = 3",
        "whole path",
    ),
    (
        "spec = \"harvester.toml\"\n[vary]\n\"stop.tip.gap\" = \"1mm\"\n[quantity]\ncommand = \"branch\"",
        "over is missing",
    ),
    (
        "spec = \"harvester.toml\"\n[vary]\n\"stop.tip.gap\" = \"1mm\"\n[quantity]\ncommand = \"frf\"\nlow = \"9 kg\"",
        "quantity.low",
    ),
    (
        "spec = \"harvester.toml\"\n[vary]\n\"stop.tip.gap\" = \"1mm\"\n[quantity]\ncommand = \"diagram\"\nover = \"drive.shaker.frequency=14Hz,10Hz\"",
        "must rise",
    ),
    (
        "spec = \"harvester.toml\"\n[vary]\n\"stop.tip.gap\" = \"1mm\"\n[quantity]\ncommand = \"sweep\"\nover = \"drive.shaker.frequency=10Hz:14Hz:1Hz\"\ndirection = \"left\"",
        "up, down, both, independent",
    ),
    (
        "spec = \"harvester.toml\"\n[vary]\n\"stop.tip.gap\" = \"1mm\"\n[quantity]\ncommand = \"bifurcations\"\nover = \"drive.shaker.frequency=4Hz:20Hz\"",
        "against is missing",
    ),
    (
        "spec = \"harvester.toml\"\n[vary]\n\"stop.tip.gap\" = \"1mm\"\n[quantity]\ncommand = \"run\"\nstarts = 3",
        "no such key; there are command",
    ),
    (
        "spec = \"harvester.toml\"\n[vary]\n\"stop.tip.gap\" = \"1mm\"\n[quantity]\ncommand = \"runs\"",
        "did you mean `run`?",
    ),
    (
        "spec = \"harvester.toml\"\n[vary]\n\"stop.tip.gap\" = \"1mm\"\n[quantity]\ncommand = \"noise\"",
        "noise needs a drive",
    ),
];

#[test]
fn all_faults_of_a_text_come_at_once_with_their_lines() {
    let text = "spec = \"harvester.toml\"\nsampling = \"grod\"\nseed = -1\npoint = 3\n[vary]\n\"stop.tip.gapp\" = \"1mm\"\n\"stop.tip.gap\" = \"1kg\"\n[quantity]\ncommand = \"guess\"\n";
    let Err(StudyError::Faults(faults)) = Study::parse(text, &example_folder()) else {
        panic!("this text is wrong")
    };
    let mut lines: Vec<usize> = faults.iter().map(|fault| fault.line).collect();
    lines.sort_unstable();
    assert_eq!(lines, [2, 3, 4, 6, 7, 9], "{faults:?}");
    for (text, expected) in INVALID {
        let error = Study::parse(text, &example_folder())
            .unwrap_err()
            .to_string();
        assert!(error.contains(expected), "{text}\n-> {error}");
    }
}
