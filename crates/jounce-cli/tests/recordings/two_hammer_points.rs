//! Hits at two points: one matrix of responses, and its modes.

use super::jounce;
use serde_json::Value;
use std::path::Path;

/// A hit at the hammer's point and one at the tip, each with sensors at both.
fn write_hits_at_two_points(folder: &Path) {
    let spec = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../examples/impact-harvester-2019/harvester.toml"
    );
    for (point, file) in [("beam.hammer", "one.csv"), ("beam.tip", "two.csv")] {
        let test = [
            "--hammer",
            point,
            "--at",
            "beam.tip",
            "--at",
            "beam.hammer",
            "--fixed-table",
            "--hits",
            "1",
            "--block",
            "8s",
        ];
        let rig_options = [
            "--rate",
            "1024Hz",
            "--contact",
            "4ms",
            "--set",
            "circuit.load.resistance=1Mohm",
            "--noise",
            "0.0001",
            "--to",
            file,
        ];
        let (code, _, stderr) = jounce(folder, &[&["rig", spec], &test[..], &rig_options].concat());
        assert_eq!(code, 0, "{stderr}");
    }
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

/// The tip under a hit at the other point responds as that point under a hit at the tip.
fn check_reciprocity(json: &Value) {
    let function_values = |name: &str| {
        (
            json["responses"][name]["re"].as_array().unwrap().clone(),
            json["responses"][name]["reference"].clone(),
        )
    };
    let (values, reference) = function_values("beam.tip.acceleration from beam.hammer");
    let (reciprocal_values, _) = function_values("beam.hammer.acceleration from beam.tip");
    assert_eq!(reference, "beam.hammer");
    let largest = values.iter().map(|x| number(x).abs()).fold(0.0, f64::max);
    let difference = values[1..800]
        .iter()
        .zip(&reciprocal_values[1..800])
        .map(|(a, b)| (number(a) - number(b)).abs() / largest)
        .fold(0.0, f64::max);
    eprintln!("off by {difference:.1e} of the largest");
    assert!(difference < 0.02, "{difference}");
}

/// Hits at two places and two sensors, one file for each place, as CSV whose notes keep the places: one matrix of responses, and modes whose
/// participation at the places is, by reciprocity, their shape at the sensors there.
#[test]
fn hits_at_two_points_give_a_matrix_and_modes_of_both() {
    let folder = tempfile::tempdir().unwrap();
    write_hits_at_two_points(folder.path());
    let measured = [
        "--measured",
        "one.csv",
        "two.csv",
        "--end-ratio",
        "0.01",
        "--json",
        "--out",
        "out",
    ];
    let (code, json, stderr) = jounce(folder.path(), &[&["frf"], &measured[..]].concat());
    assert_eq!(code, 0, "{stderr}");
    assert_eq!(
        json["references"],
        serde_json::json!(["beam.hammer", "beam.tip"])
    );
    assert_eq!(
        (
            json["responses"].as_object().unwrap().len(),
            json["outputs"].as_array().unwrap().len()
        ),
        (4, 2)
    );
    check_reciprocity(&json);
    let (code, json, stderr) = jounce(
        folder.path(),
        &[
            &["modes"],
            &measured[..],
            &["--between", "20Hz:200Hz", "--order", "14"],
        ]
        .concat(),
    );
    assert_eq!(code, 0, "{stderr}");
    assert_eq!(
        json["references"],
        serde_json::json!(["beam.hammer", "beam.tip"])
    );
    for mode in json["modes"].as_array().unwrap() {
        let (shape, participation) = (&mode["shape"]["re"], &mode["participation"]["re"]);
        eprintln!("{} Hz: {shape} {participation}", mode["frequency_hz"]);
        // Sensors stand at tip and hammer, hits at hammer and tip.
        let difference = (number(&shape[0]) * number(&participation[0])
            - number(&shape[1]) * number(&participation[1]))
        .abs();
        assert!(difference < 0.02, "{mode}");
    }
    let head = std::fs::read_to_string(folder.path().join("out/modes.csv")).unwrap();
    assert!(
        head.lines()
            .next()
            .unwrap()
            .contains("beam.hammer.participation.re"),
        "{head}"
    );
}
