//! A recording as the drive of a spec: the powers of `run`, `sweep` and `study` are that of `rig --base`.

use super::jounce;
use serde_json::Value;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

const SPEC: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../examples/impact-harvester-2019/harvester.toml"
);

/// Steps of a walker as a logger writes them: stamps in whole milliseconds, three axes in g, one of them dead, gravity on the last, a lost sample.
fn write_steps(folder: &Path) -> PathBuf {
    let mut text = "time (ms),ax (g),ay (g),az (g)\n".to_owned();
    for k in (0..2000).filter(|k| *k != 777) {
        let phase = std::f64::consts::TAU * 1.87e-2 * f64::from(k);
        let push =
            0.12 * phase.sin() + 0.09 * (3.0 * phase + 0.4).sin() + 0.05 * (6.0 * phase).cos();
        writeln!(text, "{},0.0,{:.5},{:.5}", 10 * k, 0.02 * push, 1.0 + push).unwrap();
    }
    let path = folder.join("steps.csv");
    std::fs::write(&path, text).unwrap();
    path
}

/// The spec with its drive replaced by one line, for as long as the recording lasts.
fn write_driven_spec(folder: &Path, file: &str, keys: &str, duration_s: f64) -> PathBuf {
    let spec = std::fs::read_to_string(SPEC).unwrap();
    let shaker = "[drive.shaker]\nat = \"table\"\nkind = \"force\"\namplitude = \"200 N\"\nfrequency = \"13 Hz\"\n";
    let floor = format!(
        "[drive]\nfloor = {{ kind = \"base-acceleration\", signal = \"recording\", file = \"{file}\"{keys} }}\n"
    );
    let times = "duration = \"20 s\"\naverage_over = \"10 s\"";
    assert!(spec.contains(shaker) && spec.contains(times));
    let lasting = format!("duration = \"{duration_s} s\"\naverage_over = \"{duration_s} s\"");
    let path = folder.join("driven.toml");
    std::fs::write(&path, spec.replace(shaker, &floor).replace(times, &lasting)).unwrap();
    path
}

/// What a command prints; it must not fail.
fn json_output(folder: &Path, arguments: &[&str]) -> Value {
    let (code, json, stderr) = jounce(folder, arguments);
    assert_eq!(code, 0, "{arguments:?}: {stderr}");
    json
}

fn number(value: &Value) -> f64 {
    value
        .as_f64()
        .unwrap_or_else(|| panic!("{value} is no number"))
}

/// Mean power of the load that `rig --base` and `power` give, for a gap.
fn power_by_rig(folder: &Path, recording: &str, options: &[&str], gap: &str) -> f64 {
    let set = format!("stop.tip.gap={gap}");
    let rig = [
        "rig",
        SPEC,
        "--base",
        recording,
        "--rate",
        "2048Hz",
        "--to",
        "rig.parquet",
        "--set",
        &set,
    ];
    json_output(folder, &[&rig[..], options].concat());
    let power_json = json_output(
        folder,
        &["power", "rig.parquet", "--resistance", "1Mohm", "--json"],
    );
    number(&power_json["records"][0]["mean_power_w"])
}

/// Kinds of the issues that `check` lists.
fn issue_kinds(check: &Value) -> Vec<&str> {
    check["issues"]
        .as_array()
        .unwrap()
        .iter()
        .filter_map(|issue| issue["issue"]["kind"].as_str())
        .collect()
}

#[test]
fn a_recorded_drive_gives_the_powers_of_the_rig() {
    let folder = tempfile::tempdir().unwrap();
    write_steps(folder.path());
    write_driven_spec(folder.path(), "steps.csv", ", channel = \"az\"", 19.99);
    let json = |arguments: &[&str]| json_output(folder.path(), arguments);
    let expected: Vec<f64> = ["0.5 mm", "2 mm"]
        .map(|gap| power_by_rig(folder.path(), "steps.csv", &["--base-channel", "az"], gap))
        .to_vec();
    let run = json(&[
        "run",
        "driven.toml",
        "--set",
        "stop.tip.gap=0.5 mm",
        "--json",
    ]);
    let ratio = number(&run["mean_power_w"]) / expected[0];
    eprintln!("run over rig {ratio:.6}");
    assert!((ratio - 1.0).abs() < 1e-3, "{ratio}");
    let sweep = json(&[
        "sweep",
        "driven.toml",
        "--over",
        "stop.tip.gap=0.5mm,2mm",
        "--direction",
        "independent",
        "--json",
    ]);
    for (point, expected) in sweep["points"].as_array().unwrap().iter().zip(&expected) {
        let ratio = number(&point["mean_power_w"]) / expected;
        assert!((ratio - 1.0).abs() < 1e-3, "{point}: {ratio}");
    }
    let study = "spec = \"driven.toml\"\n\n[vary]\n\"stop.tip.gap\" = \"0.5mm,2mm\"\n\n[quantity]\ncommand = \"run\"\n";
    std::fs::write(folder.path().join("gaps.toml"), study).unwrap();
    json_output(
        folder.path(),
        &["study", "run", "gaps.toml", "--out", "gaps"],
    );
    let (table, _) = jounce::Table::read(&folder.path().join("gaps/study.parquet")).unwrap();
    for (power_w, expected) in table.floats("mean_power_w").unwrap().iter().zip(&expected) {
        assert!(
            (power_w / expected - 1.0).abs() < 1e-3,
            "{power_w} {expected}"
        );
    }
    let check = json(&["check", "driven.toml", "--json"]);
    let kinds = issue_kinds(&check);
    assert!(
        kinds.contains(&"bridged") && kinds.contains(&"mean-removed"),
        "{check}"
    );
    assert!(
        run["warnings"].to_string().contains("its mean of"),
        "{}",
        run["warnings"]
    );
}
