//! Leakage across patches: a resistance parallel to the load, behind a rectifier, and in series.

use crate::plants::{from_rest, kernel, relative};
use jounce_analysis::run::StartState;
use jounce_dynamics::Integrator;
use jounce_model::contact::{Hertz, Law};
use jounce_model::plant::{
    Bridge, BridgeState, Connection, Drive, Load, RectifierScheme, Stop, Storage, System,
};
use jounce_model::structure::{Modes, PatchModes};
use jounce_spec::Wiring;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

const COUPLING: [f64; 2] = [0.6, 0.4];
const CAPACITANCE_F: [f64; 2] = [1.0, 0.7];
const DROP_V: f64 = 0.1;
const DIODE_OHM: f64 = 0.05;
const STORAGE_F: f64 = 4.0;
const LOAD_OHM: f64 = 2.0;

/// Mass and stiffness 1, a force of amplitude 1, a stop, and leaking patches.
fn cell(leaks: &[Option<f64>]) -> System {
    let patch = |k: usize| PatchModes {
        coupling_n_per_v: vec![COUPLING[k]],
        capacitance_f: CAPACITANCE_F[k],
        leakage_ohm: leaks[k],
        strain: Vec::new(),
    };
    let modes = Modes {
        frequency_rad_s: vec![1.0],
        damping_ratio: vec![0.03],
        shape: BTreeMap::from([("mass".into(), vec![1.0])]),
        patch: (0..leaks.len())
            .map(|k| (format!("p{k}"), patch(k)))
            .collect(),
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
        stops: vec![stop],
        drives: vec![drive],
        ..System::default()
    }
}

fn connections(count: usize) -> Vec<Connection> {
    (0..count)
        .map(|k| Connection {
            patch: format!("p{k}"),
            sign: 1.0,
        })
        .collect()
}

fn rectified(leaks: &[Option<f64>], storage: Storage) -> System {
    let bridge = Bridge {
        name: "circuit".into(),
        connections: connections(leaks.len()),
        wiring: if leaks.len() > 1 {
            Wiring::Series
        } else {
            Wiring::Parallel
        },
        scheme: RectifierScheme::Standard,
        storage,
        drop_v: DROP_V,
        diode_ohm: DIODE_OHM,
        leakage_ohm: None,
        state: BridgeState::default(),
    };
    System {
        bridges: vec![bridge],
        ..cell(leaks)
    }
}

/// A leak parallel to a resistor shares its power in proportion to the conductances. The motion,
/// also against a stop, is that with one equivalent resistor. Measured: powers and residual
/// 3.3e-14.
#[test]
fn a_leak_is_a_resistor_parallel_to_the_load() {
    let run_with = |resistance_ohm: f64, leak: Option<f64>| {
        let mut system = cell(&[leak]);
        system
            .loads
            .push(Load::resistor("load", "p0", resistance_ohm));
        kernel(system)
    };
    let (both, one) = (run_with(3.0, Some(5.0)), run_with(15.0 / 8.0, None));
    let [leaking, plain] = [&both, &one].map(|kernel| from_rest(kernel, 60.0, 1e-11));
    let errors = [
        relative(leaking.mean_power_w, plain.mean_power_w * 5.0 / 8.0),
        relative(
            leaking.leaks[0].mean_power_w,
            plain.mean_power_w * 3.0 / 8.0,
        ),
        leaking.energies.residual_relative().abs(),
    ];
    eprintln!("{errors:?}, {} contacts", leaking.contacts);
    assert!(
        errors.iter().all(|error| *error < 1e-9)
            && leaking.contacts == plain.contacts
            && plain.leaks.is_empty()
    );
}

/// RK4 on the voltage of every patch, with the diodes as kinks of their current, at 2e4 steps per
/// unit of time.
fn integrated(leaks: &[Option<f64>], battery: Option<f64>, end_s: f64) -> Vec<f64> {
    let count = leaks.len();
    let rates = |t: f64, x: &[f64]| -> Vec<f64> {
        let (q, v, store) = (x[0], x[1], x[2 + count]);
        let across: f64 = x[2..2 + count].iter().sum();
        let storage_voltage = battery.unwrap_or(store);
        let current =
            ((across.abs() - storage_voltage - DROP_V) / DIODE_OHM).max(0.0) * across.signum();
        let coupling_force: f64 = (0..count).map(|k| COUPLING[k] * x[2 + k]).sum();
        let contact = 20.0 * (q - 0.5).max(0.0).powf(1.5);
        let mut rate = vec![
            v,
            (1.1 * t + 0.4).sin() - 0.06 * v - q + coupling_force - contact,
        ];
        let leak = |k: usize| leaks[k].map_or(0.0, |ohm| x[2 + k] / ohm);
        rate.extend((0..count).map(|k| -(COUPLING[k] * v + current + leak(k)) / CAPACITANCE_F[k]));
        rate.push((current.abs() - store / LOAD_OHM) / STORAGE_F);
        rate
    };
    let (mut x, steps) = (vec![0.0; 3 + count], (2e4 * end_s) as u32);
    let h = end_s / f64::from(steps);
    for k in 0..steps {
        let t = f64::from(k) * h;
        let add =
            |k: &[f64], f: f64| -> Vec<f64> { x.iter().zip(k).map(|(x, k)| x + f * k).collect() };
        let a = rates(t, &x);
        let b = rates(t + 0.5 * h, &add(&a, 0.5 * h));
        let c = rates(t + 0.5 * h, &add(&b, 0.5 * h));
        let d = rates(t + h, &add(&c, h));
        for i in 0..x.len() {
            x[i] += h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]);
        }
    }
    x
}

/// One leaking patch, two unequal leaking ones in series, and two with one leak, behind a bridge
/// with a drop, into a capacitor with a load and into a battery. The energy balances, and the
/// charge through the diodes equals that of the storage.
#[test]
fn leaking_patches_behind_a_bridge_agree_with_a_plain_integrator() {
    for leaks in [
        &[Some(8.0)][..],
        &[Some(8.0), Some(20.0)],
        &[None, Some(6.0)],
    ] {
        for battery in [None, Some(0.3)] {
            let storage = match battery {
                Some(voltage_v) => Storage::Battery { voltage_v },
                None => Storage::Capacitor {
                    capacitance_f: STORAGE_F,
                    load_ohm: LOAD_OHM,
                },
            };
            let kernel = kernel(rectified(leaks, storage));
            let start = kernel
                .plant
                .from_physical(&StartState::rest(&kernel.plant).physical(), 0.0);
            let mut integrator = Integrator::new(&kernel, &start, 0.0, 1e-10).unwrap();
            integrator.advance_to(20.0).unwrap();
            let (x, theirs) = (integrator.physical(), integrated(leaks, battery, 20.0));
            let mut ours = x[..2].to_vec();
            ours.extend(kernel.plant.patch_voltages_v(&x));
            let mut error = ours
                .iter()
                .zip(&theirs)
                .map(|(ours, theirs)| (ours - theirs).abs())
                .fold(0.0, f64::max);
            let (energies, rectified) = (integrator.energies(), integrator.energies().rectified[0]);
            if let Some(node) = kernel.plant.electrical.bridges[0].storage {
                error = error.max((x[2 + node] - theirs[2 + leaks.len()]).abs());
            }
            let (charge, dissipated) = match battery {
                Some(voltage) => (rectified.battery_j / voltage, 0.0),
                None => (rectified.charge_c, rectified.load_j),
            };
            eprintln!(
                "{leaks:?} {battery:?}: state {error:.1e}, residual {:.1e}, {energies:?}",
                energies.residual_relative()
            );
            assert!(
                error < 1e-6 && energies.residual_relative().abs() < 1e-9,
                "{error:e}"
            );
            assert!(
                relative(charge, rectified.charge_c) < 1e-12
                    && dissipated >= 0.0
                    && rectified.charge_c > 0.5
            );
            assert!(
                energies.leaks_j.len() == leaks.iter().flatten().count()
                    && energies.leaks_j.iter().all(|leak| *leak > 1e-2)
            );
        }
    }
}
