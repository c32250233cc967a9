//! Systems shared by several tests.

use jounce_model::plant::{Load, System};
use jounce_model::structure::{Modes, PatchModes, modes};
use jounce_spec::Spec;
use std::collections::BTreeMap;
use std::sync::Arc;

pub fn bench() -> System {
    let spec = Spec::from_toml(include_str!("../../../../bench/plant.toml")).unwrap();
    System::assemble(&spec, modes(&spec).unwrap()).unwrap()
}

/// Modes and patches of every kind: free, under-, critically and overdamped, coupled and uncoupled,
/// one patch open.
pub fn menagerie() -> System {
    let frequency_rad_s = vec![0.0, 3.0, 10.0, 10.0, 40.0, 300.0];
    let n = frequency_rad_s.len();
    let patch = |coupling: [f64; 6], capacitance_f: f64| PatchModes {
        coupling_n_per_v: coupling.to_vec(),
        capacitance_f,
        leakage_ohm: None,
        strain: Vec::new(),
    };
    System {
        modes: Arc::new(Modes {
            frequency_rad_s,
            damping_ratio: vec![0.0, 1.0, 0.02, 0.05, 2.5, 0.01],
            shape: BTreeMap::from([("tip".into(), vec![1.0, 0.5, -0.7, 0.3, 1.1, 2.0])]),
            patch: BTreeMap::from([
                (
                    "first".into(),
                    patch([0.0, 0.0, 2e-3, -1e-3, 0.0, 5e-3], 1e-7),
                ),
                (
                    "second".into(),
                    patch([0.0, 0.0, 0.0, 4e-4, 0.0, -3e-3], 3e-8),
                ),
            ]),
            participation_sqrt_kg: vec![0.0; n],
            base_sqrt_kg: BTreeMap::new(),
            discretisation_error: vec![0.0; n],
            ..Modes::default()
        }),
        loads: vec![Load::resistor("load", "first", 2e6)],
        bridges: Vec::new(),
        dashpots: Vec::new(),
        stops: Vec::new(),
        drives: Vec::new(),
        signals: Vec::new(),
    }
}
