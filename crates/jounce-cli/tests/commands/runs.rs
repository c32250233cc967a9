//! Runs, sweeps and linear responses: keys of their JSON, bad input, the same bits whatever the threads.

use crate::{SPEC, jounce};

#[test]
fn run_prints_every_key() {
    let (code, json, _) = jounce(&[
        "run",
        SPEC,
        "--json",
        "--set",
        "run.duration=\"2 s\"",
        "--set",
        "run.average_over=\"1 s\"",
    ]);
    assert_eq!(code, 0);
    for key in [
        "mean_power_w",
        "voltage_rms_v",
        "voltage_peak_v",
        "max_penetration_m",
        "contacts",
        "energy_residual_relative",
        "settled",
        "wall_time_s",
    ] {
        assert!(!json[key].is_null(), "{key} is missing in {json}");
    }
    assert!(
        json["energy_residual_relative"].as_f64().unwrap().abs() < 1e-6,
        "{json}"
    );
}

/// The lines of the README in Rust and on the command line, with a tolerance.
#[test]
fn the_library_and_the_command_line_give_the_same_bits() {
    let mut harvester = jounce::Harvester::read(SPEC).unwrap();
    harvester.set("stop.tip.gap", "0.5 mm").unwrap();
    let tolerance = Some(1e-8);
    let options = jounce::RunOptions {
        tolerance,
        ..Default::default()
    };
    let result = harvester.run(&options).unwrap();
    let (code, json, _) = jounce(&[
        "run",
        SPEC,
        "--json",
        "--set",
        "stop.tip.gap=0.5 mm",
        "--tolerance",
        "1e-8",
    ]);
    assert_eq!(code, 0);
    let mut library = serde_json::to_value(&result).unwrap();
    for key in ["wall_time_s", "integration_wall_time_s"] {
        library[key] = json[key].clone();
    }
    assert_eq!(library, json);
}

#[test]
fn a_run_in_two_parts_equals_the_full_run() {
    let folder = tempfile::tempdir().unwrap();
    let state = folder.path().join("half.json");
    let full_run = [
        "run",
        SPEC,
        "--json",
        "--tolerance",
        "1e-10",
        "--set",
        "run.duration=2 s",
        "--set",
        "run.average_over=1 s",
    ];
    let half = [
        "run",
        SPEC,
        "--json",
        "--tolerance",
        "1e-10",
        "--set",
        "run.duration=1 s",
        "--set",
        "run.average_over=1 s",
    ];
    let (_, full_json, _) = jounce(&full_run);
    let path = state.to_str().unwrap();
    jounce(&[&half[..], &["--save-state", path]].concat());
    let (_, resumed_json, _) = jounce(&[&half[..], &["--start", path]].concat());
    let (full_json, resumed_json) = (
        full_json["mean_power_w"].as_f64().unwrap(),
        resumed_json["mean_power_w"].as_f64().unwrap(),
    );
    assert!(
        (full_json / resumed_json - 1.0).abs() < 1e-9,
        "{full_json} {resumed_json}"
    );
}

#[test]
fn sweep_gives_the_same_bits_for_any_number_of_threads() {
    let sweep = |threads: &str| {
        let over = "drive.shaker.frequency=10Hz:12Hz:0.5Hz";
        let arguments = [
            "sweep",
            SPEC,
            "--over",
            over,
            "--direction",
            "independent",
            "--fixed-duration",
            "--json",
            "--threads",
            threads,
        ];
        jounce(
            &[
                &arguments[..],
                &[
                    "--set",
                    "run.duration=1 s",
                    "--set",
                    "run.average_over=0.5 s",
                ],
            ]
            .concat(),
        )
        .1
    };
    let full_json = sweep("1");
    assert_eq!(full_json["points"].as_array().unwrap().len(), 5);
    for key in [
        "parameter",
        "direction",
        "mean_power_w",
        "voltage_rms_v",
        "settled",
    ] {
        assert!(!full_json["points"][0][key].is_null(), "{key} is missing");
    }
    assert_eq!(full_json, sweep("3"));
}

#[test]
fn modes_and_frequency_responses_print_every_key() {
    let (code, json, _) = jounce(&["modes", SPEC, "--fixed-table", "--json"]);
    assert_eq!((code, json["modes"].as_array().unwrap().len()), (0, 7));
    assert!((json["modes"][0]["frequency_hz"].as_f64().unwrap() - 8.66343).abs() < 1e-5);
    let coupling = &json["couplings"][0];
    let number = |key: &str| coupling[key].as_f64().unwrap();
    let angular = std::f64::consts::TAU * number("short_circuit_hz");
    let matched_ohm = 1.0 / (angular * number("capacitance_f"));
    assert!((number("matched_resistance_ohm") / matched_ohm - 1.0).abs() < 1e-12);
    assert!(number("optimal_resistance_ohm") < matched_ohm);
    let arguments = [
        "frf",
        SPEC,
        "--low",
        "1Hz",
        "--high",
        "1000Hz",
        "--fixed-table",
        "--open-circuit",
        "--input",
        "beam.hammer",
        "--json",
    ];
    let (code, json, _) = jounce(&arguments);
    assert_eq!(code, 0);
    let voltage = &json["responses"]["mfc.voltage"];
    assert_eq!(
        voltage["re"].as_array().unwrap().len(),
        json["frequency_hz"].as_array().unwrap().len()
    );
    assert_eq!(voltage["unit"], "V/N");
}

#[test]
fn bad_input_ends_with_its_code_and_one_clear_sentence() {
    let folder = tempfile::tempdir().unwrap();
    let folder_path = folder.path().to_str().unwrap();
    for (arguments, code, message) in [
        (vec!["check", "missing.toml"], 4, "missing.toml"),
        (vec!["check", folder_path], 4, folder_path),
        (
            vec!["run", SPEC, "--set", "stop.tip.gpa=\"1 mm\""],
            4,
            "gap",
        ),
        (
            vec!["run", SPEC, "--set", "stop.tip.stiffness=-1"],
            4,
            "stiffness",
        ),
        (
            vec!["run", SPEC, "--set", "circuit.load.resistance=0 ohm"],
            4,
            "resistance",
        ),
        (
            vec!["run", SPEC, "--out", "/proc/nowhere"],
            4,
            "/proc/nowhere",
        ),
        (vec!["run"], 2, "SPEC"),
        (vec!["frf", SPEC, "--low", "3 mm"], 2, "--low"),
        (
            vec!["run", SPEC, "--sample-rate", "100 Hz"],
            2,
            "--sample-rate is 100 Hz; nothing is stored at this rate; give --record too",
        ),
    ] {
        let (exit_code, _, stderr) = jounce(&arguments);
        assert_eq!(exit_code, code, "{arguments:?}: {stderr}");
        assert!(
            stderr.contains(message) && !stderr.contains("panicked"),
            "{arguments:?}: {stderr}"
        );
    }
    let (code, json, _) = jounce(&[
        "check",
        SPEC,
        "--json",
        "--set",
        "stop.tip.stiffness=\"-1 N/m^1.5\"",
    ]);
    assert!(
        code == 4
            && json["valid"] == false
            && json["faults"][0]["line"].is_number()
            && json["faults"][0]["message"].is_string(),
        "{json}"
    );
}

/// The last state of a run never replaces its spec.
#[test]
fn a_saved_state_does_not_replace_the_spec() {
    let folder = tempfile::tempdir().unwrap();
    let spec = folder.path().join("harvester.toml");
    std::fs::copy(SPEC, &spec).unwrap();
    let before = std::fs::read(&spec).unwrap();
    let path = spec.to_str().unwrap();
    let (code, _, text) = jounce(&["run", path, "--save-state", path]);
    assert_eq!(code, 2, "{text}");
    assert!(text.contains("choose another name"), "{text}");
    assert_eq!(std::fs::read(&spec).unwrap(), before);
}

/// A slow force bends a cantilever as in statics: `F L^3 / (3 E I)` at its end and `F L h / (2 E I)` at
/// the root of its outer face, next to a patch that is too thin and soft to matter.
#[test]
fn peaks_of_displacement_and_strain_are_those_of_statics() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("spec.toml");
    let text = "[beam.b]\nyoungs_modulus = \"200 GPa\"\ndensity = \"7800 kg/m^3\"\nlength = \"100 mm\"\nwidth = \"20 mm\"\nthickness = \"2 mm\"\n\
        [patch.p]\non = \"b\"\nmaterial = \"MFC-P2\"\nstart = \"0 mm\"\nlength = \"50 mm\"\nwidth = \"1 mm\"\nthickness = \"0.01 mm\"\n\
        [circuit.c]\npatch = \"p\"\nresistance = \"1 ohm\"\n[drive.d]\nat = \"b.end\"\namplitude = \"3 N\"\nfrequency = \"0.5 Hz\"\n\
        [damping]\nbeyond = 0.01\n[reduction]\nmodes = 12\n[run]\nstart = \"linear\"\nduration = \"4 s\"\naverage_over = \"2 s\"\n";
    std::fs::write(&path, text).unwrap();
    let (code, run, text) = jounce(&["run", path.to_str().unwrap(), "--json"]);
    assert_eq!(code, 0, "{text}");
    let stiffness_n_m2 = 200e9 * 0.02 * 0.002_f64.powi(3) / 12.0;
    let end = run["points"]
        .as_array()
        .unwrap()
        .iter()
        .find(|point| point["name"] == "b.end");
    let peak_m = end.unwrap()["displacement_peak_m"].as_f64().unwrap();
    let expected_m = 3.0 * 0.1_f64.powi(3) / (3.0 * stiffness_n_m2);
    assert!(
        (peak_m / expected_m - 1.0).abs() < 2e-3,
        "{peak_m} {expected_m}"
    );
    let strain = run["patches"][0]["strain_peak"].as_f64().unwrap();
    // Twelve modes give the curvature at the root to 5 %.
    let expected = 3.0 * 0.1 * 0.00101 / stiffness_n_m2;
    assert!(
        (strain / expected - 1.0).abs() < 0.05,
        "{strain} {expected}"
    );
}
