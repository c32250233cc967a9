//! `jounce new`: every starter is checked, marched and drawn as written; what stands in its way is one clear error.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use assert_cmd::Command;
use serde_json::Value;
use std::path::Path;

/// Exit code, stdout and stderr.
fn jounce(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let output = Command::cargo_bin("jounce")
        .unwrap()
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (
        output.status.code().unwrap(),
        text(output.stdout),
        text(output.stderr),
    )
}

fn kinds(folder: &Path) -> Vec<String> {
    let (code, out, _) = jounce(folder, &["new", "--json"]);
    let json: Value = serde_json::from_str(&out).unwrap();
    assert_eq!(code, 0);
    json["kinds"]
        .as_array()
        .unwrap()
        .iter()
        .map(|kind| kind["kind"].as_str().unwrap().to_owned())
        .collect()
}

#[test]
fn every_kind_is_listed_checked_marched_and_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let (_, listing, _) = jounce(folder.path(), &["new"]);
    let kinds = kinds(folder.path());
    assert_eq!((kinds.len(), listing.lines().count()), (5, 5));
    for kind in &kinds {
        let file = format!("{kind}.toml");
        let (code, out, told) = jounce(folder.path(), &["new", kind, "--out", &file]);
        assert_eq!((code, out.trim()), (0, file.as_str()), "{told}");
        assert!(
            listing.lines().any(|line| line.starts_with(kind.as_str())),
            "{listing}"
        );
        let (code, _, told) = jounce(folder.path(), &["check", &file]);
        assert_eq!((code, told.as_str()), (0, ""), "{kind}");
        let drawn = format!("{kind}.png");
        assert_eq!(
            jounce(folder.path(), &["show", &file, "--out", &drawn]).0,
            0,
            "{kind}"
        );
        let (code, out, told) = jounce(
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
        let json: Value = serde_json::from_str(&out).unwrap();
        let strikes = json["contacts"].as_u64().unwrap() > 0;
        // Measured: at most 4e-12 of the largest energy.
        let closed = json["energy_residual_relative"].as_f64().unwrap().abs() < 1e-8;
        assert!(
            code == 0 && json["mean_power_w"].as_f64().unwrap() > 1e-6 && closed,
            "{kind}: {json} {told}"
        );
        assert_eq!(strikes, kind != "bimorph-with-rectifier", "{kind}: {json}");
    }
}

#[test]
fn the_random_one_is_marched_as_an_ensemble() {
    let folder = tempfile::tempdir().unwrap();
    jounce(
        folder.path(),
        &["new", "random-base", "--out", "random.toml"],
    );
    let short = [
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
    let (code, out, told) = jounce(folder.path(), &short);
    assert!(code == 0 && out.contains("mean_power_w"), "{out} {told}");
}

#[test]
fn without_a_file_the_spec_goes_to_stdout() {
    let folder = tempfile::tempdir().unwrap();
    let (code, out, _) = jounce(folder.path(), &["new", "ball"]);
    assert!(
        code == 0 && out.starts_with("# ") && out.contains("\n[mass.ball]\n"),
        "{out}"
    );
    let json: Value =
        serde_json::from_str(&jounce(folder.path(), &["new", "ball", "--json"]).1).unwrap();
    assert_eq!(json["spec"].as_str().unwrap(), out);
    assert!(std::fs::read_dir(folder.path()).unwrap().next().is_none());
}

#[test]
fn what_stands_in_the_way_is_told_and_left_alone() {
    let folder = tempfile::tempdir().unwrap();
    let (code, _, told) = jounce(folder.path(), &["new", "two-beam"]);
    assert!(
        code == 2 && told.contains("did you mean \"two-beams\"") && told.lines().count() == 1,
        "{code}: {told}"
    );
    let mine = folder.path().join("mine.toml");
    std::fs::write(&mine, "mine").unwrap();
    let again = ["new", "ball", "--out", "mine.toml"];
    let (code, _, told) = jounce(folder.path(), &again);
    assert!(
        code == 4 && told.contains("mine.toml already exists") && told.contains("--force"),
        "{code}: {told}"
    );
    assert_eq!(std::fs::read_to_string(&mine).unwrap(), "mine");
    assert_eq!(
        jounce(folder.path(), &[&again[..], &["--force"]].concat()).0,
        0
    );
    assert!(
        std::fs::read_to_string(&mine)
            .unwrap()
            .contains("[mass.ball]")
    );
    let (code, out, told) = jounce(
        folder.path(),
        &["new", "ball", "--json", "--out", "no/such/folder.toml"],
    );
    assert!(
        code == 4 && told.contains("is not a folder; create it first") && told.lines().count() == 1,
        "{code}: {told}"
    );
    assert_eq!(serde_json::from_str::<Value>(&out).unwrap()["exit_code"], 4);
    assert_eq!(jounce(folder.path(), &["new", "--out", "a.toml"]).0, 2);
}
