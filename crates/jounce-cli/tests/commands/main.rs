//! The program from the outside: keys of its JSON results, exit codes, and sweeps that stay the same whatever the threads.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod attractors;
mod bifurcations;
mod cite;
mod given;
mod gravity;
mod hard_cases;
mod link;
mod messages;
mod names;
mod new;
mod orbits;
mod rerun;
mod runs;
mod studies;
mod study_page;
mod two_stops;
mod virtual_rig;
mod warnings;

use assert_cmd::Command;
use serde_json::Value;
use std::path::Path;

const SPEC: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../examples/impact-harvester-2019/harvester.toml"
);
const PLANT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../bench/plant.toml");

fn jounce(arguments: &[&str]) -> (i32, Value, String) {
    let cache = tempfile::tempdir().unwrap();
    let mut command = Command::cargo_bin("jounce").unwrap();
    command.env("JOUNCE_CACHE", cache.path());
    with_json(outcome(command.args(arguments)))
}

fn jounce_in(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let mut command = Command::cargo_bin("jounce").unwrap();
    outcome(command.current_dir(folder).args(arguments))
}

/// Returns exit code, stdout and stderr.
fn outcome(command: &mut Command) -> (i32, String, String) {
    let output = command.output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (
        output.status.code().unwrap(),
        text(output.stdout),
        text(output.stderr),
    )
}

/// Reads stdout as JSON; null for another text.
fn with_json((code, stdout, stderr): (i32, String, String)) -> (i32, Value, String) {
    let json = serde_json::from_str(&stdout).unwrap_or(Value::Null);
    (code, json, stderr)
}

fn assert_keys(value: &Value, keys: &[&str]) {
    keys.iter()
        .for_each(|key| assert!(!value[*key].is_null(), "{key} is missing in {value}"));
}
