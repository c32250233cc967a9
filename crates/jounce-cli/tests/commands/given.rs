//! What is known before a prototype: modes of other programs, materials and chips.

use super::{jounce, outcome, program};
use std::path::Path;

const FOLDER: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../examples/bouncing-and-impact-oscillators"
);

/// Two equal masses in a row: `w^2 = (3 -+ sqrt 5) / 2 k / m`; the file has six digits.
#[test]
fn modes_of_a_universal_file_are_a_structure() {
    let file = format!("{FOLDER}/chain.uff");
    let names = format!("{FOLDER}/chain-names.csv");
    let import = ["import", &file, "--names", &names, "--name", "chain"];
    let (code, json, stderr) = jounce(&[&import[..], &["--json"]].concat());
    assert_eq!((code, stderr.as_str()), (0, ""));
    for (k, sign) in [-1.0, 1.0].into_iter().enumerate() {
        let angular = ((3.0 + sign * 5f64.sqrt()) / 2.0 * 100.0 / 0.5_f64).sqrt();
        let frequency_hz = json["modes"][k]["frequency_hz"].as_f64().unwrap();
        let expected = angular / std::f64::consts::TAU;
        assert!(
            (frequency_hz / expected - 1.0).abs() < 1e-5,
            "{frequency_hz}"
        );
    }
    assert_eq!(
        json["points"],
        serde_json::json!(["below", "middle", "tip"])
    );
    let folder = tempfile::tempdir().unwrap();
    let spec = folder.path().join("chain.toml");
    std::fs::write(&spec, json["spec"].as_str().unwrap()).unwrap();
    let (code, _, stderr) = jounce(&["check", &spec.display().to_string()]);
    assert_eq!(code, 0, "{stderr}");
}

fn refused(folder: &Path, files: &[(&str, &str)], messages: &[&str]) {
    for (name, text) in files {
        std::fs::write(folder.join(name), text).unwrap();
    }
    let (code, _, stderr) = jounce(&["import", &folder.display().to_string()]);
    assert_eq!(code, 4, "{stderr}");
    for message in messages {
        assert!(stderr.contains(message), "{message}\n{stderr}");
    }
    assert!(!stderr.contains("panicked"), "{stderr}");
}

#[test]
fn wrong_matrices_are_refused() {
    let symmetric = "%%MatrixMarket matrix coordinate real symmetric";
    let general = "%%MatrixMarket matrix coordinate real general";
    let mass = &format!("{symmetric}\n2 2 2\n1 1 1\n2 2 1\n");
    let stiffness = &format!("{symmetric}\n2 2 2\n1 1 100\n2 2 200\n");
    let folder = tempfile::tempdir().unwrap();
    refused(folder.path(), &[("mass.mtx", mass)], &["stiffness.mtx"]);
    let skew = &format!("{general}\n2 2 4\n1 1 100\n1 2 5\n2 1 -5\n2 2 200\n");
    let names = "kind,index,name\npoint,3,tip\npoint,x,mid\n";
    refused(
        folder.path(),
        &[("stiffness.mtx", skew), ("names.csv", names)],
        &["names.csv, line 3: the index \"x\" is not a number from 1"],
    );
    let names = "kind,index,name\npoint,3,tip\n";
    refused(
        folder.path(),
        &[("names.csv", names)],
        &["stiffness", "symmetric"],
    );
    refused(
        folder.path(),
        &[("stiffness.mtx", stiffness)],
        &["names: tip has index 3, but there are 2 degrees of freedom"],
    );
    std::fs::remove_file(folder.path().join("names.csv")).unwrap();
    let indefinite = &format!("{symmetric}\n2 2 2\n1 1 100\n2 2 -200\n");
    refused(
        folder.path(),
        &[("stiffness.mtx", indefinite)],
        &["negative"],
    );
    let indefinite = &format!("{symmetric}\n2 2 2\n1 1 1\n2 2 -1\n");
    refused(
        folder.path(),
        &[("stiffness.mtx", stiffness), ("mass.mtx", indefinite)],
        &["mass"],
    );
}

#[test]
fn materials_and_chips_are_listed() {
    let (code, json, _) = jounce(&["materials", "--json"]);
    assert_eq!(code, 0);
    assert!(json["materials"].as_array().unwrap().len() > 5);
    let chips = json["chips"].as_array().unwrap();
    let names: Vec<&str> = chips
        .iter()
        .map(|chip| chip["name"].as_str().unwrap())
        .collect();
    assert_eq!(names, ["LTC3588-1", "BQ25570"]);
    let first = serde_json::json!([5.05, 3.67, 3.3, 0.85, 450e-9, 950e-9]);
    let keys = [
        "start_v",
        "stop_v",
        "output_v",
        "efficiency",
        "idle_a",
        "quiescent_a",
    ];
    assert_eq!(
        serde_json::json!(keys.map(|key| chips[0][key].clone())),
        first
    );
    assert!(chips[1]["source"].as_str().unwrap().contains("SLUSBH2"));
    let (_, text, _) = outcome(program().arg("materials"));
    for line in [
        "BQ25570: regulator, starts at 2.8 V, stops at 2.39 V, output 1.8 V, efficiency 0.9",
        "    current off 445 nA at the start voltage, quiescent current on 488 nA",
    ] {
        assert!(text.contains(line), "{text}");
    }
}

/// Thresholds in the wrong order, all faults at once.
#[test]
fn wrong_regulators_are_refused() {
    let spec = std::fs::read_to_string(format!("{FOLDER}/../wireless-sensor/harvester.toml"));
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("sensor.toml");
    std::fs::write(&path, spec.unwrap()).unwrap();
    let path = path.display().to_string();
    let settings = [
        "start_voltage=2 V",
        "stop_voltage=3 V",
        "output_voltage=3.3 V",
    ];
    let mut arguments = vec!["check".to_owned(), path];
    for setting in settings {
        arguments.extend(["--set".to_owned(), format!("regulator.supply.{setting}")]);
    }
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let (code, _, stderr) = jounce(&arguments);
    assert_eq!(code, 4, "{stderr}");
    for message in [
        "2 V must be above the stop voltage of 3 V",
        "3 V must be at least the output voltage of 3.3 V",
    ] {
        assert!(stderr.contains(message), "{message}\n{stderr}");
    }
}
