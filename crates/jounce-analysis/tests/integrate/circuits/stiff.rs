//! Circuits far faster than every mode: they are quasi-static, and add no cost.

use crate::plants::{integrate, kernel, physical};
use crate::runge_kutta::runge_kutta;
use jounce_model::contact::{Hertz, Law};
use jounce_model::plant::{Drive, Load, Plant, PlantError, Stop, System};
use jounce_model::structure::{Modes, PatchModes};
use std::collections::BTreeMap;
use std::f64::consts::TAU;

const COUPLING: f64 = 0.6;

/// Mass, stiffness and capacitance 1, a force of amplitude 1, a stop.
fn cell(resistance_ohm: f64) -> System {
    let patch = PatchModes {
        coupling_n_per_v: vec![COUPLING],
        capacitance_f: 1.0,
        leakage_ohm: None,
        strain: Vec::new(),
    };
    let modes = Modes {
        frequency_rad_s: vec![1.0],
        damping_ratio: vec![0.03],
        shape: BTreeMap::from([("mass".into(), vec![1.0])]),
        patch: BTreeMap::from([("patch".into(), patch)]),
        participation_sqrt_kg: vec![1.0],
        base_sqrt_kg: BTreeMap::new(),
        discretisation_error: vec![0.0],
        ..Modes::default()
    };
    let law = Law::Hertz(Hertz {
        stiffness: 20.0,
        exponent: 1.5,
    });
    let stop = Stop {
        name: "stop".into(),
        shape: vec![1.0],
        gap_m: 0.5,
        law,
        bases: Vec::new(),
    };
    let drive = Drive {
        name: "force".into(),
        shape: vec![1.0],
        amplitude_n: 1.0,
        frequency_hz: 1.1 / TAU,
        phase_rad: 0.4,
        base: None,
    };
    System {
        modes: modes.into(),
        loads: vec![Load::resistor("load", "patch", resistance_ohm)],
        stops: vec![stop],
        drives: vec![drive],
        ..System::default()
    }
}

/// RK4 of the motion with a quasi-static circuit, `V = -R theta q'`: a dashpot `R theta^2`. The
/// energy in the load is its last state, less the energy in the capacitance to first order,
/// `R^2 C theta^2 q'^2`.
fn quasi_static_circuit(resistance_ohm: f64, end: f64) -> [f64; 3] {
    let dashpot = 0.06 + resistance_ohm * COUPLING * COUPLING;
    let rates = |t: f64, [q, v, _]: [f64; 3]| -> [f64; 3] {
        let contact = 20.0 * (q - 0.5).max(0.0).powf(1.5);
        [
            v,
            (1.1 * t + 0.4).sin() - dashpot * v - q - contact,
            resistance_ohm * (COUPLING * v).powi(2),
        ]
    };
    let mut x = runge_kutta(rates, [0.0; 3], end, 400_000);
    x[2] -= (resistance_ohm * COUPLING * x[1]).powi(2);
    x
}

/// Against the limit, whose error is `R^2 C theta^2`. The number of steps equals that of a circuit
/// as slow as the mass.
#[test]
fn a_circuit_of_small_resistance_follows_at_once_and_costs_nothing() {
    let slow_work = integrate(&kernel(cell(1.0)), &[0.0; 3], 0.0, 20.0, 1e-10).work();
    for resistance_ohm in [1e-3, 1e-4, 1e-5, 1e-6, 1e-7] {
        let kernel = kernel(cell(resistance_ohm));
        let integrator = integrate(&kernel, &[0.0; 3], 0.0, 20.0, 1e-10);
        let (state, limit, work) = (
            physical(&integrator, &kernel),
            quasi_static_circuit(resistance_ohm, 20.0),
            integrator.work(),
        );
        let error = (state[0] - limit[0]).abs().max((state[1] - limit[1]).abs());
        let (energy, residual) = (
            (integrator.energies().loads_j[0] / limit[2] - 1.0).abs(),
            integrator.energies().residual_relative(),
        );
        eprintln!(
            "{resistance_ohm:e} ohm: motion {error:.1e}, energy in the load {energy:.1e}, residual {residual:.1e}, {work:?}"
        );
        let allowed = 1e-8 + 10.0 * resistance_ohm * resistance_ohm;
        assert!(
            integrator.statistics().contacts > 1
                && error < allowed
                && energy < 1e-7 + 100.0 * resistance_ohm * resistance_ohm
                && residual.abs() < 1e-8
        );
        assert!(
            work.contact_steps + work.contact_rejections
                < 2 * (slow_work.contact_steps + slow_work.contact_rejections)
        );
    }
}

/// Beyond the accuracy of eigenvectors, the error names the key and its bound, and no integration
/// panics.
#[test]
fn a_circuit_too_fast_to_be_computed_is_named_with_its_bound() {
    for resistance_ohm in [1e-9, 1e-12, 1e-300] {
        let error = Plant::new(cell(resistance_ohm)).unwrap_err();
        eprintln!("{error}");
        let PlantError::TooFast {
            circuit,
            key,
            least,
            ..
        } = error
        else {
            panic!("{error}")
        };
        assert!(circuit == "load" && key == "resistance" && (least / 1e-8 - 1.0).abs() < 1e-12);
        assert!(Plant::new(cell(1.01 * least)).is_ok());
    }
    let mut system = cell(1.0);
    system.loads[0].inductor = Some((1e-300, jounce_spec::Wiring::Parallel));
    assert!(matches!(
        Plant::new(system),
        Err(PlantError::TooFast {
            key: "inductance",
            ..
        })
    ));
}
