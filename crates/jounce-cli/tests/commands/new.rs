//! `jounce new`: every starter is checked, run and drawn as written; an obstacle is one clear error.

use crate::jounce_in as jounce;
use serde_json::Value;
use std::path::Path;

fn kinds(folder: &Path) -> Vec<String> {
    let (code, stdout, _) = jounce(folder, &["new", "--json"]);
    let json: Value = serde_json::from_str(&stdout).unwrap();
    assert_eq!(code, 0);
    json["kinds"]
        .as_array()
        .unwrap()
        .iter()
        .map(|kind| kind["kind"].as_str().unwrap().to_owned())
        .collect()
}

#[test]
fn every_kind_is_listed_checked_integrated_and_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let (_, listing, _) = jounce(folder.path(), &["new"]);
    let kinds = kinds(folder.path());
    assert_eq!((kinds.len(), listing.lines().count()), (6, 6));
    for kind in &kinds {
        let file = format!("{kind}.toml");
        let (code, stdout, stderr) = jounce(folder.path(), &["new", kind, "--out", &file]);
        assert_eq!((code, stdout.trim()), (0, file.as_str()), "{stderr}");
        assert!(
            listing.lines().any(|line| line.starts_with(kind.as_str())),
            "{listing}"
        );
        let (code, _, stderr) = jounce(folder.path(), &["check", &file]);
        assert_eq!((code, stderr.as_str()), (0, ""), "{kind}");
        let picture = format!("{kind}.png");
        assert_eq!(
            jounce(folder.path(), &["show", &file, "--out", &picture]).0,
            0,
            "{kind}"
        );
        let (code, stdout, stderr) = jounce(
            folder.path(),
            &[
                "run",
                &file,
                "--json",
                "--set",
                "run.duration=2 s",
                "--set",
                "run.average_over=1 s",
            ],
        );
        let json: Value = serde_json::from_str(&stdout).unwrap();
        let strikes = json["contacts"].as_u64().unwrap() > 0;
        // Measured: at most 4e-12 of the largest energy.
        let closed = json["energy_residual_relative"].as_f64().unwrap().abs() < 1e-8;
        assert!(
            code == 0 && json["mean_power_w"].as_f64().unwrap() > 1e-6 && closed,
            "{kind}: {json} {stderr}"
        );
        assert_eq!(strikes, kind != "bimorph-with-rectifier", "{kind}: {json}");
    }
}

#[test]
fn the_random_template_runs_as_an_ensemble() {
    let folder = tempfile::tempdir().unwrap();
    jounce(
        folder.path(),
        &["new", "random-base", "--out", "random.toml"],
    );
    let run_arguments = [
        "ensemble",
        "random.toml",
        "--members",
        "2",
        "--json",
        "--set",
        "run.duration=2 s",
        "--set",
        "run.average_over=1 s",
    ];
    let (code, stdout, stderr) = jounce(folder.path(), &run_arguments);
    assert!(
        code == 0 && stdout.contains("mean_power_w"),
        "{stdout} {stderr}"
    );
}

#[test]
fn without_a_file_the_spec_goes_to_stdout() {
    let folder = tempfile::tempdir().unwrap();
    let (code, stdout, _) = jounce(folder.path(), &["new", "ball"]);
    assert!(
        code == 0 && stdout.starts_with("# ") && stdout.contains("\n[mass.ball]\n"),
        "{stdout}"
    );
    let json: Value =
        serde_json::from_str(&jounce(folder.path(), &["new", "ball", "--json"]).1).unwrap();
    assert_eq!(json["spec"].as_str().unwrap(), stdout);
    assert!(std::fs::read_dir(folder.path()).unwrap().next().is_none());
}

/// The comments of the starter propose this sweep: every point settles, and the directions differ.
#[test]
fn the_sweep_that_the_cantilever_proposes_settles_and_has_hysteresis() {
    let folder = tempfile::tempdir().unwrap();
    let file = ["new", "cantilever-with-stop", "--out", "FILE"];
    assert_eq!(jounce(folder.path(), &file).0, 0);
    let text = std::fs::read_to_string(folder.path().join("FILE")).unwrap();
    let proposed = text.lines().find(|line| line.contains("--direction both"));
    let proposed = proposed.unwrap().replace('"', "");
    // The value of --set has a space, and is the last argument.
    let (arguments, stiffness) = proposed.split_once("--set ").unwrap();
    let arguments = arguments
        .trim_start_matches("#   jounce ")
        .split_whitespace();
    let arguments: Vec<&str> = arguments.chain(["--set", stiffness, "--json"]).collect();
    let (code, stdout, stderr) = jounce(folder.path(), &arguments);
    assert_eq!((code, stderr.contains("settled")), (0, false), "{stderr}");
    let json: Value = serde_json::from_str(&stdout).unwrap();
    let power_w = |direction: &str| {
        let mut points = json["points"].as_array().unwrap().iter();
        let is_at = |point: &&Value| point["parameter"] == 31.0 && point["direction"] == direction;
        points.find(is_at).unwrap()["mean_power_w"]
            .as_f64()
            .unwrap()
    };
    assert!(power_w("up") > 50.0 * power_w("down"), "{stdout}");
}

#[test]
fn an_existing_file_is_reported_and_not_overwritten() {
    let folder = tempfile::tempdir().unwrap();
    let (code, _, stderr) = jounce(folder.path(), &["new", "two-beam"]);
    assert!(
        code == 2 && stderr.contains("did you mean \"two-beams\"") && stderr.lines().count() == 1,
        "{code}: {stderr}"
    );
    let user_file = folder.path().join("mine.toml");
    std::fs::write(&user_file, "mine").unwrap();
    let arguments = ["new", "ball", "--out", "mine.toml"];
    let (code, _, stderr) = jounce(folder.path(), &arguments);
    assert!(
        code == 4 && stderr.contains("mine.toml already exists") && stderr.contains("--force"),
        "{code}: {stderr}"
    );
    assert_eq!(std::fs::read_to_string(&user_file).unwrap(), "mine");
    assert_eq!(
        jounce(folder.path(), &[&arguments[..], &["--force"]].concat()).0,
        0
    );
    assert!(
        std::fs::read_to_string(&user_file)
            .unwrap()
            .contains("[mass.ball]")
    );
    let (code, stdout, stderr) = jounce(
        folder.path(),
        &["new", "ball", "--json", "--out", "mine.toml/below.toml"],
    );
    assert!(
        code == 4
            && stderr.contains("\"mine.toml\" is not a folder")
            && stderr.lines().count() == 1,
        "{code}: {stderr}"
    );
    assert_eq!(
        serde_json::from_str::<Value>(&stdout).unwrap()["exit_code"],
        4
    );
    assert_eq!(jounce(folder.path(), &["new", "--out", "a.toml"]).0, 2);
}
