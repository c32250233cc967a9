//! Hard cases of orbits: each ends soon, with a result or with one clear error.

use crate::{PLANT, jounce};
use serde_json::Value;

/// A branch over the frequency of the shaker, with a setting.
fn branch(range: &str, set: &str) -> (i32, Value, String) {
    let over = format!("drive.shaker.frequency={range}");
    let mut arguments = vec![
        "branch",
        PLANT,
        "--over",
        &over,
        "--seeds",
        "0",
        "--longest-period",
        "1",
        "--json",
    ];
    arguments.extend(["--set", set].iter().filter(|_| !set.is_empty()));
    jounce(&arguments)
}

/// Gaps that are closed and preloaded, contact never, a start exactly at the grazing, a stop like rock: results.
#[test]
fn stops_at_their_limits_give_results() {
    for (range, set) in [
        ("13Hz:13.2Hz", "stop.tip.gap=0 mm"),
        ("13Hz:13.2Hz", "stop.tip.gap=-0.2 mm"),
        ("13Hz:13.2Hz", "stop.tip.gap=500 mm"),
        ("13.3401238Hz:13.5Hz", ""),
        ("13.2Hz:13.5Hz", "stop.tip.stiffness=1e10 N/m^1.5"),
    ] {
        let (code, json, stderr) = branch(range, set);
        assert!(
            code == 0 && !json["branches"][0]["points"].as_array().unwrap().is_empty(),
            "{set}: {stderr}"
        );
        let contacts = json["branches"][0]["points"][0]["contacts_per_period"]
            .as_u64()
            .unwrap();
        if set.contains("gap") {
            assert_eq!(contacts > 0, !set.contains("500"), "{set}: {contacts}");
        }
    }
}

/// Beyond what a key allows, and a tolerance out of reach: refused with the limit.
#[test]
fn values_out_of_reach_are_refused_with_the_limit() {
    let (code, json, _) = branch("0Hz:10Hz", "");
    assert!(
        code == 2 && json["error"].as_str().unwrap().contains("1 uHz"),
        "{json}"
    );
    let fine_range = [
        "branch",
        PLANT,
        "--over",
        "drive.shaker.frequency=13Hz:13.2Hz",
        "--tolerance",
        "1e-17",
        "--json",
    ];
    let (code, json, _) = jounce(&fine_range);
    assert!(
        code == 2 && json["error"].as_str().unwrap().contains("1e-14"),
        "{json}"
    );
}

#[test]
fn a_branch_without_an_orbit_asks_for_more_seeds() {
    // No orbit that a march settles on.
    let (code, json, _) = branch("12Hz:12.1Hz", "stop.tip.stiffness=1e7 N/m^1.5");
    let error = json["error"].as_str().unwrap();
    assert!(
        code == 3
            && error.starts_with("no periodic orbit was found")
            && error.contains("try more --seeds"),
        "{error}"
    );
}

/// A drive that does not move attracts to nothing but rest.
#[test]
fn a_drive_of_zero_is_refused() {
    for command in [
        &["basins", PLANT][..],
        &[
            "diagram",
            PLANT,
            "--over",
            "drive.shaker.frequency=13Hz:14Hz:1Hz",
        ],
    ] {
        let (code, json, _) =
            jounce(&[command, &["--json", "--set", "drive.shaker.amplitude=0 N"]].concat());
        assert!(
            code == 4 && json["error"].as_str().unwrap().contains("amplitude"),
            "{json}"
        );
    }
}

/// A negative number is refused by the option that it was given to.
#[test]
fn negative_numbers_are_refused_by_name() {
    for (option, command) in [
        ("spread", &["basins", PLANT][..]),
        (
            "seeds",
            &[
                "branch",
                PLANT,
                "--over",
                "drive.shaker.frequency=12Hz:13Hz",
            ],
        ),
    ] {
        let (code, _, stderr) = jounce(&[command, &[&format!("--{option}"), "-1"]].concat());
        assert!(
            code == 2
                && stderr.contains(&format!("--{option}"))
                && !stderr.contains("unexpected argument"),
            "{code} {stderr}"
        );
    }
}

/// Keys without influence on periodic orbits, and drives with a common period at both ends of the range only, are refused at once.
#[test]
fn keys_without_orbits_are_refused_with_their_reason() {
    for key in ["run.tolerance=1e-9:1e-7", "run.average_over=1s:5s"] {
        let (code, json, _) = jounce(&["branch", PLANT, "--over", key, "--json"]);
        let error = json["error"].as_str().unwrap();
        assert!(
            code == 2
                && error.starts_with(key.split_once('=').unwrap().0)
                && error.contains("stop.NAME.gap"),
            "{error}"
        );
        let against = ["--over", "stop.tip.gap=1mm:2mm", "--against", key, "--json"];
        let (code, json, _) = jounce(&[&["bifurcations", PLANT][..], &against].concat());
        assert!(
            code == 2
                && json["error"]
                    .as_str()
                    .unwrap()
                    .contains("do not depend on it"),
            "{json}"
        );
    }
    let folder = tempfile::tempdir().unwrap();
    let spec = folder.path().join("two-drives.toml");
    let second = "\n[drive.second]\nat = \"harvester.table\"\nkind = \"force\"\namplitude = \"10 N\"\nfrequency = \"22 Hz\"\n";
    std::fs::write(&spec, std::fs::read_to_string(PLANT).unwrap() + second).unwrap();
    let over = ["--over", "drive.shaker.frequency=10Hz:13Hz", "--json"];
    let (code, json, _) = jounce(&[&["branch", spec.to_str().unwrap()][..], &over].concat());
    assert!(
        code == 4
            && json["error"]
                .as_str()
                .unwrap()
                .contains("drives with a common period"),
        "{json}"
    );
}

/// A branch that ends early is printed with its points. Without a complete branch the command fails.
#[test]
fn a_command_without_a_complete_branch_ends_with_3() {
    let over = "drive.shaker.frequency=4Hz:6Hz";
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
        "--largest-step",
        "0.004",
    ];
    let (code, json, stderr) = jounce(&arguments);
    let branch = &json["branches"][0];
    assert!(
        code == 3
            && stderr.contains("no branch is complete")
            && stderr.contains("give a shorter range"),
        "{code} {stderr}"
    );
    assert!(
        branch["termination"][0]["reason"] == "points"
            && branch["points"].as_array().unwrap().len() == 4000,
        "{}",
        branch["termination"]
    );
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
    for command in [
        &["branch", spec, "--over", over][..],
        &["basins", spec],
        &[
            "diagram",
            spec,
            "--over",
            "drive.shaker.frequency=10Hz:11Hz:1Hz",
        ],
    ] {
        let (code, json, _) = jounce(&[command, &["--json"]].concat());
        let error = json["error"].as_str().unwrap();
        assert!(
            code == 4 && error.contains("undamped mode at 10 Hz") && error.contains("damping"),
            "{error}"
        );
    }
}
