//! Calls of the program, for the tests of `commands` and `recordings`.

use assert_cmd::Command;
use serde_json::Value;
use std::path::Path;

/// Returns the program without arguments.
pub fn program() -> Command {
    Command::cargo_bin("jounce").unwrap()
}

/// Runs the program in a folder; returns exit code, stdout and stderr.
pub fn jounce_in(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    outcome(program().current_dir(folder).args(arguments))
}

/// Returns exit code, stdout and stderr.
pub fn outcome(command: &mut Command) -> (i32, String, String) {
    let output = command.output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (
        output.status.code().unwrap(),
        text(output.stdout),
        text(output.stderr),
    )
}

/// Reads stdout as JSON; null for another text.
pub fn with_json((code, stdout, stderr): (i32, String, String)) -> (i32, Value, String) {
    let json = serde_json::from_str(&stdout).unwrap_or(Value::Null);
    (code, json, stderr)
}
