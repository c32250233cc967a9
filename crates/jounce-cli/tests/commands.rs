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

/// The plant between its stop and another behind it.
fn between_stops(folder: &tempfile::TempDir) -> String {
    let behind = "[stop.behind]\nat = \"harvester.tip\"\nframe = \"ground\"\nside = \"negative\"\nlaw = \"hertz\"\ngap = \"1.5 mm\"\nstiffness = \"2000 N/m^1.5\"\n";
    let path = folder.path().join("between.toml");
    std::fs::write(&path, format!("{}\n{behind}", std::fs::read_to_string(PLANT).unwrap())).unwrap();
    path.to_str().unwrap().to_owned()
}

#[test]
fn two_stops_are_marched_followed_and_told_apart() {
    let folder = tempfile::tempdir().unwrap();
    let spec = between_stops(&folder);
    let (code, json, text) = jounce(&["run", &spec, "--json", "--set", "run.duration=4 s", "--set", "run.average_over=2 s"]);
    assert_eq!(code, 0, "{text}");
    let stops = json["stops"].as_array().unwrap();
    stops.iter().for_each(|stop| has(stop, &["name", "contacts", "contact_duty", "max_penetration_m", "max_contact_force_n"]));
    assert_eq!((&stops[0]["name"], &stops[1]["name"]), (&Value::from("behind"), &Value::from("tip")));
    let count = |value: &Value| value["contacts"].as_u64().unwrap();
    assert!(count(&stops[0]) > 0 && count(&stops[1]) > 0 && count(&stops[0]) + count(&stops[1]) == count(&json), "{json}");
    assert!(json["energy_residual_relative"].as_f64().unwrap().abs() < 1e-6, "{json}");
    let branch = ["branch", &spec, "--over", "drive.shaker.frequency=11Hz:12Hz", "--seeds", "0", "--json"];
    let (code, json, text) = jounce(&branch);
    assert_eq!(code, 0, "{text}");
    let points = json["branches"][0]["points"].as_array().unwrap();
    assert!(points.iter().any(|point| point["contacts_per_period"].as_u64().unwrap() >= 2), "{json}");
    let (code, _, text) = jounce(&[&branch[..], &["--method", "harmonic-balance"]].concat());
    assert!(code == 4 && text.contains("shooting"), "{code}: {text}");
    let (code, json, text) = jounce(&["basins", &spec, "--starts", "6", "--seed", "3", "--json"]);
    assert!(code == 0 && !json["attractors"].as_array().unwrap().is_empty(), "{text}");
}

#[test]
fn orbits_of_a_rigid_stop_by_harmonic_balance_are_refused() {
    let rigid = ["--set", "stop.tip.law=rigid", "--set", "stop.tip.restitution=0.8"];
    let arguments = ["branch", PLANT, "--over", "drive.shaker.frequency=12Hz:13Hz", "--method", "harmonic-balance"];
    let (code, _, text) = jounce(&[&arguments[..], &rigid].concat());
    assert!(code == 4 && !text.is_empty(), "{code}: {text}");
}

#[test]
fn a_branch_tells_its_peak_and_its_bandwidth() {
    let folder = tempfile::tempdir().unwrap();
    let over = "drive.shaker.frequency=11.5Hz:12.5Hz";
    let arguments = ["branch", PLANT, "--over", over, "--seeds", "0", "--longest-period", "1", "--json", "--threads"];
    let out = folder.path().to_str().unwrap();
    let (code, one, _) = jounce(&[&arguments[..], &["1", "--out", out]].concat());
    assert_eq!(code, 0);
    let branch = &one["branches"][0];
    assert!((branch["peak"]["parameter"].as_f64().unwrap() - 12.3119).abs() < 1e-3, "{}", branch["peak"]);
    let width = &branch["half_power_bandwidth"];
    for key in ["width", "width_error", "intervals"] {
        assert!(!width[key].is_null(), "{key} is missing in {width}");
    }
    assert_eq!(width["intervals"][0]["to"]["at"], "stability");
    assert_eq!(one["half_power_bandwidth"], *width);
    assert!(folder.path().join("bandwidths.csv").exists());
    assert_eq!(one, jounce(&[&arguments[..], &["3"]].concat()).1);
}

#[test]
fn jumps_give_the_curve_of_peaks() {
    let keys = ["--over", "drive.shaker.frequency=11.9Hz:12.5Hz", "--against", "drive.shaker.amplitude=48N:50N"];
    let (code, json, _) = jounce(&[&["jumps", PLANT, "--seeds", "0", "--longest-period", "1", "--json"][..], &keys].concat());
    assert_eq!(code, 0);
    let curves = json["curves"].as_array().unwrap();
    let of = |kind: &str| curves.iter().filter(|curve| curve["kind"] == kind).count();
    assert!(of("peak") >= 1 && of("fold") >= 1, "{:?}", curves.iter().map(|curve| &curve["kind"]).collect::<Vec<_>>());
    let peak = curves.iter().find(|curve| curve["kind"] == "peak").unwrap();
    let at_50 = peak["points"].as_array().unwrap().iter().find(|point| point["parameter_2"] == 50.0).unwrap();
    assert!((at_50["parameter"].as_f64().unwrap() - 12.311_867).abs() < 1e-5 && at_50["stable"] == true, "{at_50}");
}

#[test]
fn a_diagram_has_its_points_and_its_attractors() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = ["diagram", PLANT, "--over", "drive.shaker.frequency=13.4Hz:13.6Hz:0.1Hz", "--json", "--no-branches"];
    let starts = [&arguments[..], &["--direction", "starts", "--starts", "6", "--out", folder.path().to_str().unwrap()]].concat();
    let (code, json, _) = jounce(&starts);
    assert_eq!((code, json["points"].as_array().unwrap().len()), (0, 18));
    for key in ["parameter", "direction", "start", "attractor", "motion", "period_cycles", "contacts_per_period", "mean_power_w", "section"]
    {
        assert!(!json["points"][0][key].is_null(), "{key} is missing");
    }
    assert!(json["attractors"].as_array().unwrap().iter().any(|attractor| attractor["id"] == "1a"));
    for name in ["diagram.csv", "attractors.csv", "diagram.svg", "diagram.png"] {
        assert!(folder.path().join(name).exists(), "{name}");
    }
    let stepped = jounce(&arguments).1;
    assert_eq!(stepped["points"].as_array().unwrap().len(), 6);
    assert!(stepped["attractors"].is_null());
}

#[test]
fn basins_start_from_a_plane() {
    let folder = tempfile::tempdir().unwrap();
    let grid = ["--grid", "displacement=-5mm:5mm:4x", "--grid", "velocity=-0.5m/s:0.5m/s:3x", "--out", folder.path().to_str().unwrap()];
    let (code, json, _) = jounce(&[&["basins", PLANT, "--json", "--set", "drive.shaker.frequency=14 Hz"][..], &grid].concat());
    assert_eq!((code, json["starts"].as_u64()), (0, Some(12)));
    assert!(folder.path().join("starts.csv").exists() && folder.path().join("basins.png").exists());
    for (wrong, told) in [("speed=1:2:3x", "no side"), ("velocity=1m:2m:3x", "no velocity"), ("displacement=1mm:2mm:1x", "2x or more")] {
        let (code, json, _) = jounce(&["basins", PLANT, "--json", "--grid", wrong]);
        assert!(code == 2 && json["error"].as_str().unwrap().contains(told), "{json}");
    }
}

/// Hard cases of orbits from the outside: each ends soon, with an answer or with one clear error.
#[test]
fn hard_cases_end_with_an_answer_or_a_clear_error() {
    let over = |range: &str| format!("drive.shaker.frequency={range}");
    let branch = |range: &str, set: &str| {
        let over = over(range);
        let mut arguments = vec!["branch", PLANT, "--over", &over, "--seeds", "0", "--longest-period", "1", "--json"];
        arguments.extend(["--set", set].iter().filter(|_| !set.is_empty()));
        jounce(&arguments)
    };
    // Gaps that are closed and preloaded, contact never, a start exactly at the grazing, a stop like rock: answers.
    for (range, set) in [
        ("13Hz:13.2Hz", "stop.tip.gap=0 mm"),
        ("13Hz:13.2Hz", "stop.tip.gap=-0.2 mm"),
        ("13Hz:13.2Hz", "stop.tip.gap=500 mm"),
        ("13.3401238Hz:13.5Hz", ""),
        ("13.2Hz:13.5Hz", "stop.tip.stiffness=1e10 N/m^1.5"),
    ] {
        let (code, json, told) = branch(range, set);
        assert!(code == 0 && !json["branches"][0]["points"].as_array().unwrap().is_empty(), "{set}: {told}");
        let contacts = json["branches"][0]["points"][0]["contacts_per_period"].as_u64().unwrap();
        if set.contains("gap") {
            assert_eq!(contacts > 0, !set.contains("500"), "{set}: {contacts}");
        }
    }
    // Beyond what a key allows, and a tolerance out of reach: refused with the limit.
    let (code, json, _) = branch("0Hz:10Hz", "");
    assert!(code == 4 && json["error"].as_str().unwrap().contains("1 uHz"), "{json}");
    let too_fine = ["branch", PLANT, "--over", "drive.shaker.frequency=13Hz:13.2Hz", "--tolerance", "1e-17", "--json"];
    let (code, json, _) = jounce(&too_fine);
    assert!(code == 2 && json["error"].as_str().unwrap().contains("1e-14"), "{json}");
    // A drive that does not move attracts to nothing but rest.
    for command in [&["basins", PLANT][..], &["diagram", PLANT, "--over", "drive.shaker.frequency=13Hz:14Hz:1Hz"]] {
        let (code, json, _) = jounce(&[command, &["--json", "--set", "drive.shaker.amplitude=0 N"]].concat());
        assert!(code == 4 && json["error"].as_str().unwrap().contains("amplitude"), "{json}");
    }
}

/// One mode without damping, driven at its own frequency.
#[test]
fn resonance_without_damping_is_refused_with_the_frequency() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("undamped.toml");
    let text = r#"
[modal.o]
frequency_hz = [10.0]
damping_ratio = [0.0]
[modal.o.point]
tip = [1.0]
[stop.tip]
at = "o.tip"
frame = "ground"
law = "hertz"
gap = "1 mm"
stiffness = "1000 N/m^1.5"
[drive.shaker]
at = "o.tip"
kind = "force"
amplitude = "1 N"
frequency = "10 Hz"
[run]
start = "rest"
duration = "2 s"
average_over = "1 s"
"#;
    std::fs::write(&path, text).unwrap();
    let spec = path.to_str().unwrap();
    let over = "drive.shaker.frequency=10Hz:11Hz";
    for command in
        [&["branch", spec, "--over", over][..], &["basins", spec], &["diagram", spec, "--over", "drive.shaker.frequency=10Hz:11Hz:1Hz"]]
    {
        let (code, json, _) = jounce(&[command, &["--json"]].concat());
        let error = json["error"].as_str().unwrap();
        assert!(code == 4 && error.contains("undamped mode at 10 Hz") && error.contains("damping"), "{error}");
    }
}

/// Killed at five moments and taken up again, a study has the bytes of one that ran through.
#[cfg(unix)]
#[test]
fn a_study_that_is_killed_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let text = format!(
        "spec = {SPEC:?}\npoints_per_part = 3\n[set]\n\"run.duration\" = \"1 s\"\n\"run.average_over\" = \"0.5 s\"\n\
         [vary]\n\"stop.tip.gap\" = \"0.5mm:1.5mm:30x\"\n\"drive.shaker.frequency\" = \"10Hz:14Hz:10x\"\n"
    );
    let file = folder.path().join("study.toml");
    std::fs::write(&file, text).unwrap();
    let out = |name: &str| folder.path().join(name);
    let arguments = |name: &str| ["study".into(), "run".into(), file.clone(), "--out".into(), out(name)];
    Command::cargo_bin("jounce").unwrap().args(arguments("whole")).assert().success();
    for wait_ms in [40, 90, 150, 70, 200] {
        let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_jounce")).args(arguments("killed")).spawn().unwrap();
        std::thread::sleep(std::time::Duration::from_millis(wait_ms));
        child.kill().unwrap();
        child.wait().unwrap();
    }
    let (code, json, errors) = jounce(&["study", "run", file.to_str().unwrap(), "--out", out("killed").to_str().unwrap(), "--json"]);
    assert_eq!((code, &json["finished"], &json["merged"]), (0, &serde_json::json!(100), &serde_json::json!(true)), "{errors}");
    let read = |name: &str| std::fs::read(out(name).join("study.parquet")).unwrap();
    assert!(read("whole") == read("killed"));
    let (code, json, _) = jounce(&["study", "status", folder.path().to_str().unwrap(), "--json"]);
    assert!(code == 4 && json["error"].as_str().unwrap().contains("holds no study"), "{json}");
}

#[test]
fn noise_and_ensembles_answer_with_every_key() {
    const SHAKER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/random-base/shaker.toml");
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().to_str().unwrap();
    let (code, json, stderr) = jounce(&["noise", SHAKER, "--json", "--out", out]);
    assert_eq!(code, 0, "{stderr}");
    has(&json, &["mean_power_w", "loads", "patches", "points", "stops", "left_out"]);
    has(&json["loads"][0], &["spectral_power_w", "difference_relative", "noise_bandwidth_hz", "statistical_bandwidth_hz"]);
    has(&json["stops"][0], &["reached_hz", "share_beyond", "displacement_rms_m"]);
    assert!(["noise.csv", "noise.parquet", "noise.svg", "noise.png"].iter().all(|name| folder.path().join(name).exists()));
    let short = ["--set", "run.duration=0.6 s", "--set", "run.average_over=0.5 s"];
    let members = ["ensemble", SHAKER, "--members", "2", "--spectrum", "--json", "--out", out];
    let (code, json, stderr) = jounce(&[&members[..], &short].concat());
    assert_eq!(code, 0, "{stderr}");
    has(&json["stops"][0], &["contact_rate_hz", "mean_strike_m_s", "max_dwell_s", "contact_duty"]);
    has(&json["bandwidths_hz"]["mfc"], &["mean", "interval"]);
    assert!(["ensemble-spectrum.csv", "ensemble-spectrum.svg"].iter().all(|name| folder.path().join(name).exists()));
    for (arguments, words) in [
        (vec!["noise", SPEC], "no drive has signal"),
        (vec!["ensemble", SHAKER, "--members", "1", "--spectrum"], "two --members"),
        (vec!["noise", SHAKER, "--from", "40Hz"], "--from below --to"),
    ] {
        let (code, _, stderr) = jounce(&arguments);
        assert!(code != 0 && stderr.contains(words), "{arguments:?}: {stderr}");
    }
}
