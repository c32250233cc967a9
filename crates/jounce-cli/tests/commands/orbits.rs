//! Branches and bifurcation curves.

use crate::{PLANT, assert_keys, jounce};
use serde_json::Value;

#[test]
fn branch_prints_every_key_by_both_methods() {
    for method in ["shooting", "harmonic-balance"] {
        let over = "drive.shaker.frequency=11Hz:13Hz";
        let (code, json, _) = jounce(&[
            "branch", PLANT, "--over", over, "--method", method, "--seeds", "0", "--json",
        ]);
        assert_eq!(code, 0);
        let branch = &json["branches"][0];
        assert_keys(branch, &["period_cycles", "points", "bifurcations"]);
        let keys = [
            "parameter",
            "mean_power_w",
            "voltage_rms_v",
            "stable",
            "stability_undecided",
            "floquet_max_abs",
            "contacts_per_period",
            "error_estimate",
        ];
        assert_keys(&branch["points"][0], &keys);
        let bifurcations: Vec<&Value> = json["branches"]
            .as_array()
            .unwrap()
            .iter()
            .flat_map(|b| b["bifurcations"].as_array().unwrap())
            .collect();
        let fold = bifurcations
            .iter()
            .find(|bifurcation| bifurcation["kind"] == "fold")
            .unwrap();
        assert_keys(fold, &["kind", "parameter", "mean_power_w"]);
        assert!(
            (fold["parameter"].as_f64().unwrap() - 12.3218).abs() < 1e-3,
            "{method}: {fold}"
        );
    }
}

/// A level is labelled with its own text, in JSON and in words; a wrong one and a wrong step are one clear error.
#[test]
fn branch_labels_levels_and_refuses_invalid_ones() {
    let call = [
        "branch",
        PLANT,
        "--over",
        "drive.shaker.frequency=12Hz:13Hz",
        "--seeds",
        "0",
    ];
    let level = "mean_power=1 mW";
    let (code, json, _) = jounce(&[&call[..], &["--json", "--level", level]].concat());
    assert_eq!(code, 0);
    let branches = json["branches"].as_array().unwrap();
    assert!(
        branches
            .iter()
            .all(|branch| branch["not_proved"].as_array().is_some_and(Vec::is_empty)),
        "{json}"
    );
    let bifurcations: Vec<&Value> = branches
        .iter()
        .flat_map(|branch| branch["bifurcations"].as_array().unwrap())
        .collect();
    let labels: Vec<&&Value> = bifurcations
        .iter()
        .filter(|bifurcation| bifurcation["kind"] == "level")
        .collect();
    let power = |bifurcation: &Value| bifurcation["mean_power_w"].as_f64().unwrap();
    assert!(
        !labels.is_empty()
            && labels
                .iter()
                .all(|bifurcation| bifurcation["level"] == level
                    && (power(bifurcation) / 1e-3 - 1.0).abs() < 1e-6),
        "{json}"
    );
    for invalid_options in [
        ["--level", "power=50 uW"],
        ["--level", "mean_power=50 V"],
        ["--level", "strain.mfc=1 mm"],
        ["--largest-step", "2"],
    ] {
        let (code, _, text) = jounce(&[&call[..], &invalid_options].concat());
        assert!(
            code == 2 && text.contains(invalid_options[0]) && text.trim().lines().count() == 1,
            "{invalid_options:?}: {code} {text}"
        );
    }
    let (_, _, text) = jounce(&[&call[..], &["--level", "power=50 uW"]].concat());
    assert!(
        text.contains("mean_power") && text.contains("contact_force.tip"),
        "{text}"
    );
}

/// A drive that comes down to nothing: the branch begins there at rest, without a word of failure.
#[test]
fn a_branch_reaches_zero_drive() {
    for method in ["shooting", "harmonic-balance"] {
        let over = "drive.shaker.amplitude=0N:20N";
        let spec = [
            "--set",
            "stop.tip.gap=100 mm",
            "--seeds",
            "0",
            "--longest-period",
            "1",
            "--json",
            "--method",
            method,
        ];
        let (code, json, text) = jounce(&[&["branch", PLANT, "--over", over][..], &spec].concat());
        assert!(code == 0 && text.is_empty(), "{method}: {code} {text}");
        let branch = &json["branches"][0];
        let points = branch["points"].as_array().unwrap();
        let value = |point: &Value, key: &str| point[key].as_f64().unwrap();
        let compare_drive =
            |a: &Value, b: &Value| value(a, "parameter").total_cmp(&value(b, "parameter"));
        let (resting, driven): (Vec<&Value>, Vec<&Value>) = points
            .iter()
            .partition(|point| value(point, "parameter") == 0.0);
        assert!(
            resting.len() == 1 && value(resting[0], "mean_power_w") == 0.0 && points.len() < 150,
            "{method}: {resting:?}, {}",
            points.len()
        );
        let smallest = driven
            .iter()
            .copied()
            .min_by(|a, b| compare_drive(a, b))
            .unwrap();
        let largest = driven
            .iter()
            .copied()
            .max_by(|a, b| compare_drive(a, b))
            .unwrap();
        assert!(value(smallest, "parameter") < 0.05, "{method}: {smallest}");
        // Without contact power goes with the square of the drive.
        let rate = |point: &Value| value(point, "mean_power_w") / value(point, "parameter").powi(2);
        assert!(
            (rate(smallest) / rate(largest) - 1.0).abs() < 1e-6,
            "{method}: {smallest} {largest}"
        );
        assert_eq!(branch["termination"][0]["reason"], "range");
    }
}

#[test]
fn orbits_of_a_rigid_stop_by_harmonic_balance_are_refused() {
    let rigid = [
        "--set",
        "stop.tip.law=rigid",
        "--set",
        "stop.tip.restitution=0.8",
    ];
    let arguments = [
        "branch",
        PLANT,
        "--over",
        "drive.shaker.frequency=12Hz:13Hz",
        "--method",
        "harmonic-balance",
    ];
    let (code, _, text) = jounce(&[&arguments[..], &rigid].concat());
    assert!(code == 4 && !text.is_empty(), "{code}: {text}");
}

/// What would be ignored is refused by its name, with what to do.
#[test]
fn options_that_would_be_ignored_are_refused() {
    let branch = [
        "branch",
        PLANT,
        "--over",
        "drive.shaker.frequency=12Hz:13Hz",
        "--json",
    ];
    let diagram = [
        "diagram",
        PLANT,
        "--over",
        "drive.shaker.frequency=12Hz:13Hz:1Hz",
        "--json",
    ];
    let cases: [(&[&str], [&str; 2], &str); 4] = [
        (
            &branch,
            ["--harmonics", "64"],
            "harmonic-balance as --method",
        ),
        (&diagram, ["--starts", "6"], "starts as --direction"),
        (&diagram, ["--seed", "1"], "starts as --direction"),
        (&diagram, ["--spread", "5"], "starts as --direction"),
    ];
    for (command, option, remedy) in cases {
        let (code, json, _) = jounce(&[command, &option].concat());
        let error = json["error"].as_str().unwrap();
        assert!(
            code == 2 && error.starts_with(option[0]) && error.contains(remedy),
            "{error}"
        );
    }
}

#[test]
fn a_branch_notes_that_seeds_may_miss_solutions() {
    let over = "drive.shaker.frequency=14Hz:14.2Hz";
    let (code, json, _) = jounce(&[
        "branch",
        PLANT,
        "--over",
        over,
        "--seeds",
        "0",
        "--longest-period",
        "1",
        "--json",
    ]);
    let note = json["note"].as_str().unwrap();
    assert!(
        code == 0
            && ["more `seeds`", "`longest_period`"]
                .iter()
                .all(|option| note.contains(option)),
        "{note}"
    );
}

#[test]
fn a_branch_prints_its_peak_and_its_bandwidth() {
    let folder = tempfile::tempdir().unwrap();
    let over = "drive.shaker.frequency=11.5Hz:12.5Hz";
    let arguments = [
        "branch",
        PLANT,
        "--over",
        over,
        "--seeds",
        "0",
        "--longest-period",
        "1",
        "--json",
        "--threads",
    ];
    let out = folder.path().to_str().unwrap();
    let (code, json, _) = jounce(&[&arguments[..], &["1", "--out", out]].concat());
    assert_eq!(code, 0);
    let branch = &json["branches"][0];
    assert!(
        (branch["peak"]["parameter"].as_f64().unwrap() - 12.3119).abs() < 1e-3,
        "{}",
        branch["peak"]
    );
    let width = &branch["half_power_bandwidth"];
    for key in ["width", "width_error", "intervals"] {
        assert!(!width[key].is_null(), "{key} is missing in {width}");
    }
    assert_eq!(width["intervals"][0]["to"]["at"], "stability");
    assert_eq!(json["half_power_bandwidth"], *width);
    assert!(folder.path().join("bandwidths.csv").exists());
    assert_eq!(json, jounce(&[&arguments[..], &["3"]].concat()).1);
}

/// Two equal layers in series become unequal with a key of one of them. The derivative of the power
/// is the difference quotient of linear runs; branch and sweep pass the equality.
#[test]
fn a_key_of_one_of_two_equal_layers_in_series_changes() {
    let spec = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../examples/bimorph-erturk-2009/harvester.toml"
    );
    // The averaging window of a run holds whole periods of 50 Hz.
    let at = ["--json", "--set", "drive.base.frequency=50Hz"];
    let (code, result, stderr) = jounce(&[&["sensitivity", spec][..], &at].concat());
    assert_eq!(code, 0, "{stderr}");
    let keys = result["keys"].as_array().unwrap();
    let row = |name: &str| keys.iter().find(|row| row["key"] == name);
    for name in ["length", "thickness"] {
        let key = format!("patch.top.{name}");
        assert!(row(&key).is_some(), "{key}: {result}");
    }
    let power = |thickness: &str| {
        let thickness = format!("patch.top.thickness={thickness}");
        let changed = ["--set", &thickness, "--set", "run.start=linear"];
        let (_, run, _) = jounce(&[&["run", spec][..], &at, &changed].concat());
        run["mean_power_w"].as_f64().unwrap()
    };
    let quotient = (power("0.2601 mm") - power("0.2599 mm")) / 0.2e-6;
    let thickness = row("patch.top.thickness").unwrap();
    let derivative = thickness["derivatives"][0]["derivative"].as_f64().unwrap();
    assert!(
        (derivative / quotient - 1.0).abs() < 1e-4,
        "{derivative} {quotient}"
    );
    for (command, over, list) in [
        ("branch", "patch.top.thickness=0.25mm:0.27mm", "branches"),
        ("sweep", "patch.top.thickness=0.25mm:0.27mm:3x", "points"),
    ] {
        let (code, result, stderr) = jounce(&[command, spec, "--json", "--over", over]);
        let is_empty = result[list].as_array().is_none_or(Vec::is_empty);
        assert!(code == 0 && !is_empty, "{command}: {stderr} {result}");
    }
}
