//! Records of the virtual rig, whose truth is known, through the commands that analyse recordings.

use crate::{SPEC, jounce_in, with_json};
use serde_json::Value;
use std::path::Path;

/// The paper's case of two solutions, where the model has two (20 starts of `basins`): 5.244 uW and period 1, 8.181 uW and period 3.
const CASE: [&str; 8] = [
    "--set",
    "drive.shaker.frequency=13.5 Hz",
    "--set",
    "circuit.load.resistance=100 kohm",
    "--set",
    "drive.shaker.amplitude=42 N",
    "--set",
    "run.average_over=20 s",
];

fn jounce(folder: &Path, arguments: &[&str]) -> (i32, Value, String) {
    with_json(jounce_in(folder, arguments))
}

fn assert_written(folder: &Path, names: &[&str]) {
    names
        .iter()
        .for_each(|name| assert!(folder.join(name).is_file(), "{name} is missing"));
}

/// Arguments of `segments`; without the last two no tables are written.
const SEGMENTS: [&str; 9] = [
    "segments",
    "switch.parquet",
    "--drive",
    "13.5Hz",
    "--resistance",
    "100kohm",
    "--json",
    "--out",
    "out",
];

/// A record that jumps from one solution to the other at 9 s.
fn write_switch(folder: &Path) {
    let solutions = [
        "--solution",
        "1a",
        "--solution",
        "3a@9s",
        "--starts",
        "8",
        "--rate",
        "1536Hz",
        "--noise",
        "0.01",
    ];
    let disturbance_options = [
        "--amplitude-wander",
        "0.002",
        "--frequency-wander",
        "0.00005",
        "--to",
        "switch.parquet",
        "--json",
    ];
    let (code, json, stderr) = jounce(
        folder,
        &[&["rig", SPEC], &CASE[..], &solutions, &disturbance_options].concat(),
    );
    assert!(code == 0 && stderr.contains("not modelled"), "{stderr}");
    assert_eq!(
        json["channels"],
        serde_json::json!(["mfc.voltage", "tip.force", "base.acceleration"])
    );
}

/// Solution, period and power of a segment.
fn check_segment(segment: &Value, id: &str, cycles: i32, power_w: f64) {
    let best = &segment["candidates"][0];
    assert_eq!(
        (&segment["solution"], &best["id"], &best["period_cycles"]),
        (&id.into(), &id.into(), &cycles.into()),
        "{segment}"
    );
    let number = |value: &Value| value.as_f64().unwrap();
    eprintln!(
        "{id}: waveform {:.4} away, spectrum {:.4}",
        number(&best["waveform_distance"]),
        number(&best["spectrum_distance"])
    );
    assert!(
        number(&best["waveform_distance"]) < 0.02 && number(&best["spectrum_distance"]) < 0.02,
        "{best}"
    );
    assert!(
        number(&segment["candidates"][1]["waveform_distance"]) > 0.3,
        "{segment}"
    );
    assert!(
        (number(&segment["mean_power_w"]) / power_w - 1.0).abs() < 0.01,
        "{segment}"
    );
}

/// The linear harvester has one solution: the second segment is none of it.
fn check_segments_of_the_linear_harvester(folder: &Path) {
    let other_model = [
        "--model",
        SPEC,
        "--set",
        "drive.shaker.amplitude=42 N",
        "--set",
        "stop.tip.gap=1 m",
        "--starts",
        "2",
    ];
    let (_, json, _) = jounce(folder, &[&SEGMENTS[..7], &other_model].concat());
    let solutions: Vec<&Value> = json["segments"]
        .as_array()
        .unwrap()
        .iter()
        .map(|segment| &segment["solution"])
        .collect();
    assert_eq!(solutions[1], "none", "{json}");
    assert_ne!(solutions[0], "none", "{json}");
}

/// A record of 20 s at 1536 Hz, noise of 1 %, a shaker that wanders, a jump from one solution to the other at 9 s. Measured: the change
/// within 0.1 s of the jump, the right solution in both segments, waveforms within 0.004, powers within 0.2 %.
#[test]
fn a_switch_between_two_solutions_is_segmented_and_identified() {
    let folder = tempfile::tempdir().unwrap();
    write_switch(folder.path());
    let model = [
        "--model",
        SPEC,
        "--set",
        "drive.shaker.amplitude=42 N",
        "--starts",
        "8",
    ];
    let (code, json, stderr) = jounce(folder.path(), &[&SEGMENTS[..], &model].concat());
    assert_eq!(code, 0, "{stderr}");
    let segments = json["segments"].as_array().unwrap();
    assert_eq!(segments.len(), 2, "{json}");
    assert!(
        (segments[1]["start_s"].as_f64().unwrap() - 9.0).abs()
            < json["uncertainty_s"].as_f64().unwrap(),
        "{json}"
    );
    for (k, (id, cycles, power_w)) in [("1a", 1, 5.244e-6), ("3a", 3, 8.181e-6)]
        .into_iter()
        .enumerate()
    {
        check_segment(&segments[k], id, cycles, power_w);
    }
    assert_written(
        &folder.path().join("out"),
        &[
            "segments.csv",
            "segments-section.svg",
            "segments-time.png",
            "segments-spectra.svg",
        ],
    );
    let table = std::fs::read_to_string(folder.path().join("out/segments.csv")).unwrap();
    assert!(
        table.contains("waveform_distance") && table.contains("3a"),
        "{table}"
    );
    check_segments_of_the_linear_harvester(folder.path());
}

/// A record of the solution of period 3.
fn write_second_solution(folder: &Path) {
    let short_options = [
        "--solution",
        "3a",
        "--starts",
        "8",
        "--rate",
        "1536Hz",
        "--to",
        "one.csv",
    ];
    let (code, _, stderr) = jounce(
        folder,
        &[
            &["rig", SPEC],
            &CASE[..6],
            &["--set", "run.average_over=6 s"],
            &short_options,
        ]
        .concat(),
    );
    assert_eq!(code, 0, "{stderr}");
}

/// The order lines of the first segment are those of one period; the spectrogram and its convention are written.
#[test]
fn spectra_print_their_convention_and_mark_the_orders() {
    let folder = tempfile::tempdir().unwrap();
    write_second_solution(folder.path());
    let (code, json, stderr) = jounce(
        folder.path(),
        &[
            "spectra", "one.csv", "--drive", "13.5Hz", "--json", "--out", "out",
        ],
    );
    assert_eq!(code, 0, "{stderr}");
    let convention = json["convention"].as_str().unwrap();
    assert!(
        convention.contains("hann")
            && convention.contains("zero to peak")
            && convention.contains("overlap 0.5"),
        "{convention}"
    );
    let density = json["density"].as_array().unwrap();
    let spacing = json["resolution_hz"].as_f64().unwrap();
    let sum: f64 = density.iter().map(|s| s.as_f64().unwrap() * spacing).sum();
    // Parseval: the density's integral is the mean square, here that of the orders.
    let orders: f64 = json["orders"]
        .as_array()
        .unwrap()
        .iter()
        .map(|o| o["amplitude_peak"].as_f64().unwrap().powi(2) / 2.0)
        .sum();
    assert!((sum / orders - 1.0).abs() < 0.02, "{sum} {orders}");
    assert_written(
        &folder.path().join("out"),
        &[
            "spectra.csv",
            "spectra.svg",
            "spectrogram.parquet",
            "spectrogram.png",
            "spectrogram.svg",
        ],
    );
    let picture = std::fs::read_to_string(folder.path().join("out/spectrogram.svg")).unwrap();
    assert!(
        picture.contains(">drive<") && picture.contains(">8× drive<"),
        "order lines are marked"
    );
}

/// Options of a test, exit code and a part of the error.
const IMPOSSIBLE: &[(&[&str], i32, &str)] = &[
    (&["--at", "beam.tpi"], 4, "beam.tip"),
    (
        &["--solution", "9z", "--starts", "2"],
        2,
        "the model's solutions are",
    ),
    (
        &["--solution", "1a", "--solution", "1a", "--starts", "2"],
        2,
        "@42s",
    ),
    (&["--amplitude-wander", "2"], 2, "from 0 to 0.3"),
    (&["--wander-time", "3s"], 2, "give --amplitude-wander or"),
    (&["--cable", "0nF"], 2, "--cable"),
    (&["--base", "missing.csv"], 4, "missing.csv"),
    (
        &["--hammer", "beam.hammer", "--solution", "1a"],
        2,
        "applies to a shaker test",
    ),
    (&["--sensor-mass", "1g"], 2, "accelerometers"),
];

/// Wrong options end with one clear sentence; rig and analysis report hits before the structure is at rest.
#[test]
fn an_impossible_test_is_reported() {
    let folder = tempfile::tempdir().unwrap();
    let rig = |options: &[&str]| {
        jounce(
            folder.path(),
            &[&["rig", SPEC, "--to", "a.csv"], options].concat(),
        )
    };
    for (arguments, code, convention) in IMPOSSIBLE {
        let (exit_code, _, stderr) = rig(arguments);
        assert!(
            exit_code == *code && stderr.contains(convention) && !stderr.contains("panicked"),
            "{arguments:?}: {exit_code} {stderr}"
        );
    }
    let hits = [
        "--hammer",
        "beam.hammer",
        "--at",
        "beam.tip",
        "--fixed-table",
        "--rate",
        "1024Hz",
        "--noise",
        "0.001",
        "--hits",
        "2",
    ];
    let (code, _, stderr) = rig(&[&hits[..], &["--block", "8s"]].concat());
    assert!(
        code == 0
            && stderr.contains("43.0 % of its motion")
            && stderr.contains("use blocks of 44 s"),
        "{stderr}"
    );
    let (code, json, _) = jounce(folder.path(), &["frf", "--measured", "a.csv", "--json"]);
    let has_ringing_warning =
        |k: usize| json["hits"][k]["warnings"].to_string().contains("ringing");
    assert!(
        code == 0 && !has_ringing_warning(0) && has_ringing_warning(1),
        "{}",
        json["hits"]
    );
}
