//! The commands have the options of the questions.

use crate::{SPEC, jounce, outcome, program};
use serde_json::Value;

/// Every option of a question is an argument of its command, with its default.
#[test]
fn commands_have_the_options_of_the_questions() {
    for question in jounce::questions() {
        let mut command = program();
        command.args(question.command.split(' ')).arg("--help");
        let (_, help, _) = outcome(command.env("COLUMNS", "200"));
        for option in &question.options {
            let argument = format!("--{}", option.argument);
            let is_there = help.split_whitespace().any(|word| word == argument);
            assert!(
                is_there,
                "jounce {}: {argument} is missing",
                question.command
            );
        }
    }
}

/// Every option with a value is in the manifest of the tables, under its name in the library.
#[test]
fn tables_carry_the_options_of_their_question() {
    assert_options("frf", "frf", &["--points", "7"], &[("points", "7")]);
    let sweep = ["--over", "stop.tip.gap=1mm,2mm", "--direction", "down"];
    let expected = [
        ("over", "stop.tip.gap=1mm,2mm"),
        ("direction", "down"),
        ("set", "run.average_over=2 s"),
    ];
    let short = ["--set", "run.average_over=2 s"];
    assert_options(
        "sweep",
        "sweep",
        &[&sweep[..], &short[..]].concat(),
        &expected,
    );
    let grid = ["displacement=-5mm:5mm:2x", "velocity=-1m/s:1m/s:2x"];
    let arguments = ["--grid", grid[0], "--grid", grid[1], "--threads", "1"];
    let sides = r#"["displacement=-5mm:5mm:2x","velocity=-1m/s:1m/s:2x"]"#;
    assert_options("basins", "starts", &arguments, &[("grid", sides)]);
}

fn assert_options(command: &str, table: &str, arguments: &[&str], options: &[(&str, &str)]) {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().to_str().unwrap();
    let (code, _, text) = jounce(&[&[command, SPEC, "--out", out], arguments].concat());
    assert_eq!(code, 0, "{command}: {text}");
    let path = folder.path().join(format!("{table}.manifest.json"));
    let manifest: Value = serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap();
    let given = &manifest["manifest"]["options"];
    assert_eq!(given["command"], command);
    assert!(given["threads"].is_null(), "{given}");
    for (name, value) in options {
        assert_eq!(given[*name], *value, "{command}: {given}");
    }
}
