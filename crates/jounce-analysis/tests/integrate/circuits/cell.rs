//! Cells of one mode behind a rectifier, with mass, stiffness, capacitance and force 1.

use jounce_model::contact::{Hertz, Law};
use jounce_model::plant::{
    Bridge, BridgeState, Connection, Drive, RectifierScheme, Stop, Storage, System,
};
use jounce_model::structure::{Modes, PatchModes};
use jounce_spec::Wiring;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

/// Mass, stiffness and capacitance 1; force of amplitude 1.
pub fn cell(
    coupling: f64,
    damping_ratio: f64,
    angular_frequency: f64,
    scheme: RectifierScheme,
    storage: Storage,
) -> System {
    let patch = PatchModes {
        coupling_n_per_v: vec![coupling],
        capacitance_f: 1.0,
        leakage_ohm: None,
        strain: Vec::new(),
    };
    let modes = Modes {
        frequency_rad_s: vec![1.0],
        damping_ratio: vec![damping_ratio],
        shape: BTreeMap::from([("mass".into(), vec![1.0])]),
        patch: BTreeMap::from([("patch".into(), patch)]),
        participation_sqrt_kg: vec![1.0],
        base_sqrt_kg: BTreeMap::new(),
        discretisation_error: vec![0.0],
        ..Modes::default()
    };
    let bridge = Bridge {
        name: "circuit".into(),
        connections: vec![Connection {
            patch: "patch".into(),
            sign: 1.0,
        }],
        wiring: Wiring::Parallel,
        scheme,
        storage,
        drop_v: 0.0,
        diode_ohm: 1e-6,
        leakage_ohm: None,
        state: BridgeState::default(),
    };
    let frequency_hz = angular_frequency / TAU;
    let drive = Drive {
        name: "force".into(),
        shape: vec![1.0],
        amplitude_n: 1.0,
        frequency_hz,
        phase_rad: 0.4,
        base: None,
    };
    System {
        modes: modes.into(),
        bridges: vec![bridge],
        drives: vec![drive],
        ..System::default()
    }
}

/// A cell with diodes that have a drop and a resistance, a leaking storage, and a mass that strikes
/// a stop.
pub fn lossy_with_stop(scheme: RectifierScheme, storage: Storage) -> System {
    let mut system = cell(0.5, 0.02, 0.9, scheme, storage);
    (
        system.bridges[0].drop_v,
        system.bridges[0].leakage_ohm,
        system.bridges[0].diode_ohm,
    ) = (0.2, Some(40.0), 0.02);
    system.stops.push(Stop {
        name: "stop".into(),
        shape: vec![1.0],
        gap_m: 0.8,
        law: Law::Hertz(Hertz {
            stiffness: 50.0,
            exponent: 1.5,
        }),
        bases: Vec::new(),
    });
    system
}
