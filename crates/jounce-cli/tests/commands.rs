//! The program from the outside: keys of its JSON answers, exit codes, and sweeps that stay the same whatever the threads.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use assert_cmd::Command;
use serde_json::Value;

const SPEC: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/impact-harvester-2019/harvester.toml");

fn jounce(arguments: &[&str]) -> (i32, Value, String) {
    let cache = tempfile::tempdir().unwrap();
    let output = Command::cargo_bin("jounce").unwrap().args(arguments).env("JOUNCE_CACHE", cache.path()).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let json = serde_json::from_str(&text).unwrap_or(Value::Null);
    (output.status.code().unwrap(), json, String::from_utf8(output.stderr).unwrap())
}

#[test]
fn run_answers_with_every_key() {
    let (code, json, _) = jounce(&["run", SPEC, "--json", "--set", "run.duration=\"2 s\"", "--set", "run.average_over=\"1 s\""]);
    assert_eq!(code, 0);
    for key in ["mean_power_w", "voltage_rms_v", "max_penetration_m", "contacts", "energy_residual_relative", "settled", "march_s"] {
        assert!(!json[key].is_null(), "{key} is missing in {json}");
    }
    assert!(json["energy_residual_relative"].as_f64().unwrap().abs() < 1e-6, "{json}");
}

#[test]
fn a_run_in_two_parts_is_the_run_in_one() {
    let folder = tempfile::tempdir().unwrap();
    let state = folder.path().join("half.json");
    let whole = ["run", SPEC, "--json", "--tolerance", "1e-10", "--set", "run.duration=2 s", "--set", "run.average_over=1 s"];
    let half = ["run", SPEC, "--json", "--tolerance", "1e-10", "--set", "run.duration=1 s", "--set", "run.average_over=1 s"];
    let (_, one, _) = jounce(&whole);
    let path = state.to_str().unwrap();
    jounce(&[&half[..], &["--save-state", path]].concat());
    let (_, two, _) = jounce(&[&half[..], &["--start", path]].concat());
    let (one, two) = (one["mean_power_w"].as_f64().unwrap(), two["mean_power_w"].as_f64().unwrap());
    assert!((one / two - 1.0).abs() < 1e-9, "{one} {two}");
}

#[test]
fn sweep_gives_the_same_bits_for_any_number_of_threads() {
    let sweep = |threads: &str| {
        let over = "drive.shaker.frequency=10Hz:12Hz:0.5Hz";
        let arguments = ["sweep", SPEC, "--over", over, "--direction", "independent", "--fixed-duration", "--json", "--threads", threads];
        jounce(&[&arguments[..], &["--set", "run.duration=1 s", "--set", "run.average_over=0.5 s"]].concat()).1
    };
    let one = sweep("1");
    assert_eq!(one["points"].as_array().unwrap().len(), 5);
    for key in ["parameter", "direction", "mean_power_w", "voltage_rms_v", "settled"] {
        assert!(!one["points"][0][key].is_null(), "{key} is missing");
    }
    assert_eq!(one, sweep("3"));
}

#[test]
fn modes_and_frequency_responses_answer_with_every_key() {
    let (code, json, _) = jounce(&["modes", SPEC, "--fixed-table", "--json"]);
    assert_eq!((code, json["modes"].as_array().unwrap().len()), (0, 7));
    assert!((json["modes"][0]["frequency_hz"].as_f64().unwrap() - 8.66343).abs() < 1e-5);
    let arguments = ["frf", SPEC, "--from", "1Hz", "--to", "1000Hz", "--fixed-table", "--open-circuit", "--input", "beam.hammer", "--json"];
    let (code, json, _) = jounce(&arguments);
    assert_eq!(code, 0);
    let voltage = &json["responses"]["mfc.voltage"];
    assert_eq!(voltage["re"].as_array().unwrap().len(), json["frequency_hz"].as_array().unwrap().len());
    assert_eq!(voltage["unit"], "V/N");
}

#[test]
fn bad_input_ends_with_its_code_and_one_clear_sentence() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path().to_str().unwrap();
    for (arguments, code, words) in [
        (vec!["check", "missing.toml"], 4, "missing.toml"),
        (vec!["check", here], 4, here),
        (vec!["run", SPEC, "--set", "stop.tip.gpa=\"1 mm\""], 4, "gap"),
        (vec!["run", SPEC, "--set", "stop.tip.stiffness=-1"], 4, "stiffness"),
        (vec!["run", SPEC, "--set", "circuit.load.resistance=0 ohm"], 4, "resistance"),
        (vec!["run", SPEC, "--out", "/proc/nowhere"], 4, "/proc/nowhere"),
        (vec!["run"], 2, "SPEC"),
        (vec!["frf", SPEC, "--from", "3 mm"], 2, "--from"),
    ] {
        let (found, _, stderr) = jounce(&arguments);
        assert_eq!(found, code, "{arguments:?}: {stderr}");
        assert!(stderr.contains(words) && !stderr.contains("panicked"), "{arguments:?}: {stderr}");
    }
    let (code, json, _) = jounce(&["check", SPEC, "--json", "--set", "stop.tip.stiffness=\"-1 N/m^1.5\""]);
    assert!(
        code == 4 && json["valid"] == false && json["faults"][0]["line"].is_number() && json["faults"][0]["message"].is_string(),
        "{json}"
    );
}

const PLANT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../bench/plant.toml");

fn has(value: &Value, keys: &[&str]) {
    keys.iter().for_each(|key| assert!(!value[*key].is_null(), "{key} is missing in {value}"));
}

#[test]
fn branch_answers_with_every_key_by_both_methods() {
    for method in ["shooting", "harmonic-balance"] {
        let over = "drive.shaker.frequency=11Hz:13Hz";
        let (code, json, _) = jounce(&["branch", PLANT, "--over", over, "--method", method, "--seeds", "0", "--json"]);
        assert_eq!(code, 0);
        let branch = &json["branches"][0];
        has(branch, &["period_cycles", "points", "bifurcations"]);
        let keys = ["parameter", "mean_power_w", "voltage_rms_v", "stable", "floquet_max_abs", "contacts_per_period", "error_estimate"];
        has(&branch["points"][0], &keys);
        let all: Vec<&Value> = json["branches"].as_array().unwrap().iter().flat_map(|b| b["bifurcations"].as_array().unwrap()).collect();
        let fold = all.iter().find(|found| found["kind"] == "fold").unwrap();
        has(fold, &["kind", "parameter", "mean_power_w"]);
        assert!((fold["parameter"].as_f64().unwrap() - 12.3218).abs() < 1e-3, "{method}: {fold}");
    }
}

#[test]
fn jumps_answers_with_every_key() {
    let (over, against) = ("drive.shaker.frequency=11Hz:13Hz", "stop.tip.gap=0.9mm:1.1mm");
    let (code, json, _) = jounce(&["jumps", PLANT, "--over", over, "--against", against, "--seeds", "0", "--json"]);
    assert_eq!(code, 0);
    let folds = json["curves"].as_array().unwrap().iter().filter(|curve| curve["kind"] == "fold");
    let points: Vec<&Value> = folds.flat_map(|fold| fold["points"].as_array().unwrap()).collect();
    has(points[0], &["parameter", "parameter_2", "mean_power_w"]);
    let own = points.iter().filter(|point| (point["parameter_2"].as_f64().unwrap() - 1e-3).abs() < 1e-12);
    assert!(own.clone().any(|point| (point["parameter"].as_f64().unwrap() - 12.3218).abs() < 1e-3), "{json}");
}

#[test]
fn basins_answer_with_every_key_and_shares_that_add_up() {
    let at = "drive.shaker.frequency=\"14 Hz\"";
    let (code, json, _) = jounce(&["basins", PLANT, "--starts", "12", "--seed", "3", "--set", at, "--json"]);
    assert_eq!(code, 0);
    has(&json, &["attractors", "expected_power_w"]);
    let attractors = json["attractors"].as_array().unwrap();
    attractors
        .iter()
        .for_each(|a| has(a, &["id", "period_cycles", "chaotic", "mean_power_w", "fraction", "fraction_low", "fraction_high"]));
    let sum: f64 = attractors.iter().map(|a| a["fraction"].as_f64().unwrap()).sum();
    assert!((sum - 1.0).abs() < 1e-12, "{json}");
}

#[test]
fn orbits_of_a_rigid_stop_by_harmonic_balance_are_refused() {
    let rigid = ["--set", "stop.tip.law=rigid", "--set", "stop.tip.restitution=0.8"];
    let arguments = ["branch", PLANT, "--over", "drive.shaker.frequency=12Hz:13Hz", "--method", "harmonic-balance"];
    let (code, _, text) = jounce(&[&arguments[..], &rigid].concat());
    assert!(code == 4 && !text.is_empty(), "{code}: {text}");
}
