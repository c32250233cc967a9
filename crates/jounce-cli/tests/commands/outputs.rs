//! Where results are written: missing folders are created, and an output that cannot be written is an
//! error after which the same command continues.

use crate::{SPEC, jounce, jounce_in, outcome, program};
use std::path::Path;

const SHORT: [&str; 3] = [
    "--set=run.duration=1s",
    "--set=run.average_over=0.5s",
    "--set=reduction.modes=3",
];

fn assert_succeeds(folder: &Path, arguments: &[&str]) {
    let (code, _, stderr) = jounce_in(folder, arguments);
    assert_eq!(code, 0, "{arguments:?}: {stderr}");
}

#[test]
fn every_output_creates_its_folder() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let rig = "--hammer=beam.tip --at=beam.tip --hold=table --hits=2 --block=4s --contact=8ms --rate=512Hz --to=b/hits.csv";
    let state = ["run", SPEC, "--save-state=a/b/state.json"];
    assert_succeeds(at, &[&state[..], &SHORT].concat());
    assert_succeeds(at, &["new", "ball", "--out=new/ball.toml"]);
    let rig: Vec<&str> = ["rig", SPEC].into_iter().chain(rig.split(' ')).collect();
    assert_succeeds(at, &rig);
    assert_succeeds(at, &["read", "b/hits.csv", "--to=c/d/hits.uff"]);
    let matrices = ["export", SPEC, "--matrices=e/f", "--spice=g/h.cir"];
    assert_succeeds(at, &matrices);
    for file in [
        "a/b/state.json",
        "new/ball.toml",
        "c/d/hits.uff",
        "e/f/mass.mtx",
        "g/h.cir",
    ] {
        assert!(at.join(file).is_file(), "{file}");
    }
}

/// Results can be computed again, so that each command replaces the file of an earlier one, as its help
/// says; a spec is written by hand, so that `new` does not.
#[test]
fn results_replace_files_and_specs_do_not() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let hits = "--hammer=beam.tip --at=beam.tip --hold=table --hits=2 --block=4s --contact=8ms --rate=512Hz";
    let rig: Vec<&str> = ["rig", SPEC].into_iter().chain(hits.split(' ')).collect();
    for (arguments, option, file) in [
        (vec!["show", SPEC], "--out", "old.svg"),
        (rig, "--to", "old.csv"),
        (vec!["export", SPEC], "--spice", "old.cir"),
    ] {
        std::fs::write(at.join(file), "old").unwrap();
        assert_succeeds(at, &[&arguments[..], &[option, file]].concat());
        let text = std::fs::read_to_string(at.join(file)).unwrap();
        assert_ne!(text, "old", "{arguments:?}");
    }
    for command in [&["show"][..], &["rig"], &["run"], &["study", "page"]] {
        let (_, help, _) = jounce_in(at, &[command, &["--help"]].concat());
        assert!(help.contains("replaced"), "{command:?}: {help}");
    }
    std::fs::write(at.join("old.toml"), "old").unwrap();
    let (code, _, stderr) = jounce_in(at, &["new", "ball", "--out=old.toml"]);
    assert!(code == 4 && stderr.contains("already exists"), "{stderr}");
}

/// A finished run of a diagram is computed once, also where its table cannot be written at first.
#[test]
fn a_diagram_that_cannot_be_written_continues() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    std::fs::create_dir_all(at("out/diagram.csv")).unwrap();
    let diagram = || {
        let mut command = program();
        command.args(["diagram", SPEC, "--no-branches", "--out=out"]);
        command.args(["--over=drive.shaker.frequency=12Hz:13Hz:2x"]);
        command.args(SHORT).current_dir(folder.path());
        outcome(command.env("JOUNCE_CACHE", at("cache")))
    };
    let (code, _, stderr) = diagram();
    assert!(
        code == 4 && stderr.contains("it is a folder"),
        "{code}: {stderr}"
    );
    std::fs::remove_dir(at("out/diagram.csv")).unwrap();
    let (code, _, stderr) = diagram();
    assert!(
        code == 0 && stderr.contains("continuing after 4 finished runs"),
        "{code}: {stderr}"
    );
    assert!(at("out/diagram.csv").is_file());
    assert_eq!(std::fs::read_dir(at("cache")).unwrap().count(), 0);
}

#[cfg(target_os = "linux")]
mod full_disk {
    use super::{SHORT, SPEC};
    use std::fs::{File, OpenOptions};
    use std::path::Path;
    use std::process::{Command, Stdio};

    fn full() -> File {
        OpenOptions::new().write(true).open("/dev/full").unwrap()
    }

    fn sweep(cache: &Path) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_jounce"));
        command.args(["sweep", SPEC, "--over=drive.shaker.frequency=12Hz:13Hz:2x"]);
        command.args(SHORT).arg("--fixed-duration");
        command.env("JOUNCE_CACHE", cache);
        command
    }

    #[test]
    fn a_result_that_cannot_be_printed_is_an_error_and_keeps_its_points() {
        let cache = tempfile::tempdir().unwrap();
        let output = sweep(cache.path()).stdout(full()).output().unwrap();
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(4), "{stderr}");
        let reason = "cannot write the result to stdout: no space left on device";
        assert!(stderr.contains(reason), "{stderr}");
        let again = sweep(cache.path()).output().unwrap();
        let stderr = String::from_utf8(again.stderr).unwrap();
        assert!(stderr.contains("continuing after 2 finished"), "{stderr}");
        let mut script = Command::new(env!("CARGO_BIN_EXE_jounce"));
        let script = script.args(["completions", "bash"]).stdout(full());
        assert_eq!(script.output().unwrap().status.code(), Some(4));
    }

    #[test]
    fn messages_that_cannot_be_printed_do_not_end_the_work() {
        let cache = tempfile::tempdir().unwrap();
        let warned = sweep(cache.path()).stderr(full()).output().unwrap();
        assert_eq!(warned.status.code(), Some(0));
        assert!(!warned.stdout.is_empty());
        let mut wrong = sweep(cache.path());
        let wrong = wrong.arg("--set=no.key=1").stderr(full());
        assert_eq!(
            wrong.stdout(Stdio::null()).status().unwrap().code(),
            Some(4)
        );
    }
}

/// The folder or file of the results is tested before the computation, and no folder is created.
#[test]
fn an_output_that_cannot_be_written_is_found_before_the_computation() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    std::fs::write(path("file"), "").unwrap();
    let (file, inside) = (path("file"), path("file/out"));
    let here = folder.path().to_string_lossy().into_owned();
    for (command, option, value, reason) in [
        ("run", "--out", &file, "is not a folder"),
        ("modes", "--out", &inside, "is not a folder"),
        ("run", "--save-state", &here, "it is a folder"),
        ("show", "--out", &inside, "is not a folder"),
        ("rig", "--to", &here, "it is a folder"),
        ("export", "--spice", &here, "it is a folder"),
    ] {
        let (code, stdout, stderr) = jounce(&[command, SPEC, option, value]);
        let is_known = stderr.contains("cannot write") && stderr.contains(reason);
        assert!(
            code == 4 && is_known && stdout.is_null() && !stderr.contains("os error"),
            "{command} {option}: {code} {stderr}"
        );
    }
    let (_, _, stderr) = jounce(&["check", "no.toml"]);
    assert!(stderr.contains("no.toml does not exist"), "{stderr}");
    let new = path("new");
    assert_eq!(jounce(&["run", "no.toml", "--out", &new]).0, 4);
    assert!(!folder.path().join("new").exists());
}
