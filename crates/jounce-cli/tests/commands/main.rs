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
mod model_warnings;
mod names;
mod new;
mod orbits;
mod outputs;
mod printed;
#[path = "../program/mod.rs"]
mod program;
mod rerun;
mod rerun_faults;
mod runs;
mod show;
mod studies;
mod study_page;
mod two_stops;
mod virtual_rig;
mod warnings;

use program::{jounce_in, outcome, program, with_json};
use serde_json::Value;

const SPEC: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/../../examples/impact-harvester-2019/harvester.toml"
);
const PLANT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../bench/plant.toml");

fn jounce(arguments: &[&str]) -> (i32, Value, String) {
    let cache = tempfile::tempdir().unwrap();
    let mut command = program();
    command.env("JOUNCE_CACHE", cache.path());
    with_json(outcome(command.args(arguments)))
}

fn assert_keys(value: &Value, keys: &[&str]) {
    keys.iter()
        .for_each(|key| assert!(!value[*key].is_null(), "{key} is missing in {value}"));
}
