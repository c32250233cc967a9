//! `jounce explore --link`: links that are refused, and one that is served without any file.

use crate::{SPEC, jounce};
use jounce_explorer::Link;
use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};

#[test]
fn wrong_links_are_refused_with_the_way_out() {
    let address = "http://127.0.0.1:4321/0123/#set=stop.tip.gap%3D0.9+mm";
    for (arguments, expected) in [
        (&["--link", "harvester.toml"][..], "copy it with Copy link"),
        (&["--link", "jounce:?spec=%21"], "`spec` is damaged"),
        (&["--link", address], "jounce explore SPEC --link LINK"),
        (&["--link", "jounce:?set=a"], "\"a\" is not KEY=VALUE"),
        (&["--link", "jounce:?", "--set", "a=1"], "<SPEC>"),
        (&[], "<SPEC>"),
    ] {
        let (code, _, text) = jounce(&[&["explore", "--no-browser"], arguments].concat());
        assert_eq!(code, 2, "{arguments:?}: {text}");
        assert!(text.contains(expected), "{arguments:?}: {text}");
    }
}

/// Serves until the address is printed; returns it and stderr.
fn serve(arguments: &[&str]) -> (String, String) {
    let folder = tempfile::tempdir().unwrap();
    let mut child = Command::new(env!("CARGO_BIN_EXE_jounce"))
        .args(["explore", "--no-browser", "--json"])
        .args(arguments)
        .current_dir(folder.path())
        .env("XDG_STATE_HOME", folder.path())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut line = String::new();
    let stdout = child.stdout.take().unwrap();
    BufReader::new(stdout).read_line(&mut line).unwrap();
    child.kill().unwrap();
    let output = child.wait_with_output().unwrap();
    (line, String::from_utf8(output.stderr).unwrap())
}

#[test]
fn a_link_is_served_without_a_file_and_with_one() {
    let text = std::fs::read_to_string(SPEC).unwrap();
    let mut link = Link {
        set: vec![("stop.tip.gap".to_owned(), "0.9 mm".to_owned())],
        view: None,
        page: Vec::new(),
        spec: Some(text.clone()),
    };
    let (line, errors) = serve(&["--link", &link.to_string()]);
    assert!(
        line.contains("http://127.0.0.1:") && errors.is_empty(),
        "{line} {errors}"
    );
    let (line, errors) = serve(&[SPEC, "--link", &link.to_string()]);
    assert!(
        line.contains("http://127.0.0.1:") && errors.is_empty(),
        "{line} {errors}"
    );
    link.spec = Some(text.replace("1 mm", "2 mm"));
    let (line, errors) = serve(&[SPEC, "--link", &link.to_string()]);
    assert!(line.contains("http://127.0.0.1:"), "{line}");
    assert!(
        errors.contains("differs from the spec in the link"),
        "{errors}"
    );
}
