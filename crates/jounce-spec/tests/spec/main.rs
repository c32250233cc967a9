//! The spec reader: examples, faults, overrides, sweeps, schema, round trip, fuzzing.
#![allow(clippy::unwrap_used, reason = "tests")]

mod contact_bodies;
mod corpus;
mod drives;
mod examples;
mod force_tables;
mod fuzz;
mod overlap;
mod overrides;
mod plates;
mod pores;
mod random;
mod recordings;
mod regulators;
mod round_trip;
mod schema;
mod starters;
mod strain_limits;
mod sweeps;
mod velocities;

use std::path::{Path, PathBuf};

/// The root of the repository.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The spec of the paper.
fn paper() -> String {
    std::fs::read_to_string(root().join("examples/impact-harvester-2019/harvester.toml")).unwrap()
}

/// A structure specified by two modes.
const MODAL: &str = r#"
[modal.harvester]
frequency_hz = [0.99893740470155179, 8.6690552090301676]
damping_ratio = [0.050000000000000003, 0.0019400000000000001]

[modal.harvester.point]
table = [0.28836423723126786, 0.010460611757434613]
tip = [0.29413599852937317, -12.139139756805843]

[modal.harvester.patch.mfc]
coupling_n_per_v = [-1.098177670673766e-06, 0.0022147153917224734]
capacitance = "177 nF"

[stop.tip]
at = "harvester.tip"
frame = "harvester.table"
law = "hertz"
gap = "1 mm"
stiffness = "1000 N/m^1.5"

[circuit.load]
patch = "harvester.mfc"
resistance = "1 Mohm"

[drive.shaker]
at = "harvester.table"
amplitude = "50 N"
frequency = "11 Hz"
"#;
