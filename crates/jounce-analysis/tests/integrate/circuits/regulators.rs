//! Regulators: cold start, duty cycle, outages, balances.

use super::cell::lossy_with_stop;
use crate::plants::kernel;
use jounce_analysis::run::{RunPlan, RunResult, StartState, charges, simulate};
use jounce_dynamics::{Integrator, Kernel};
use jounce_model::drive::Wave;
use jounce_model::plant::{DevicePhase, RectifierScheme, Regulator, Signal, Storage, System};
use std::sync::Arc;

const STORAGE_F: f64 = 2.0;
const DROP_V: f64 = 0.2;
const DIODE_OHM: f64 = 0.02;

fn phase(output_a: f64, length_s: f64) -> DevicePhase {
    DevicePhase { output_a, length_s }
}

/// Starts at 0.15 V and stops at 0.1 V; measures, sends and sleeps with a period of 7 s.
fn regulator() -> Regulator {
    Regulator {
        start_v: 0.15,
        stop_v: 0.1,
        output_v: 0.08,
        efficiency: 0.8,
        idle_a: 1e-3,
        quiescent_a: 2e-3,
        phases: [phase(0.2, 1.0), phase(1.3, 0.5), phase(0.002, 5.5)],
    }
}

/// Adds the signal of the current that the first bridge draws.
fn drawn(mut system: System) -> System {
    system.signals.push(Signal {
        name: "regulator".into(),
        shape: vec![0.0; system.modes.len()],
        wave: Wave::Constant(0.0),
        base: None,
        drawn_from: Some(0),
    });
    system
}

fn harvester(scheme: RectifierScheme, regulator: Regulator) -> System {
    let storage = Storage::Regulated {
        capacitance_f: STORAGE_F,
        regulator,
    };
    drawn(lossy_with_stop(scheme, storage))
}

fn started(kernel: &Kernel, storage_v: f64) -> Integrator<'_> {
    let mut start = StartState::rest(&kernel.plant);
    let node = kernel.plant.electrical.bridges[0].storage.unwrap();
    start.voltage_v[node] = storage_v;
    let y = kernel.plant.from_physical(&start.physical(), 0.0);
    Integrator::new(kernel, &y, 0.0, 1e-10).unwrap()
}

fn storage_v(kernel: &Kernel, integrator: &Integrator) -> f64 {
    let node = kernel.plant.electrical.bridges[0].storage.unwrap();
    integrator.physical()[2 * kernel.plant.system.modes.len() + node]
}

/// A slow and heavy mass is a source of constant current `i`: it charges the patch until the diodes
/// conduct, then both capacitors,
///
/// ```text
/// C_p V_p' = i - (V_p - V_s - E) / r,      C_s V_s' = (V_p - V_s - E) / r - G V_s
/// ```
///
/// whose solution is a sum of two exponentials and a constant. The device starts where `V_s` reaches
/// the start voltage.
#[test]
fn a_cold_start_is_that_of_two_exponentials() {
    let (theta, speed, leakage_ohm, diode_ohm) = (1e-8, 1e5, 40.0, 1.0);
    let current_a = theta * speed;
    let regulator = Regulator {
        start_v: 5e-3,
        stop_v: 3e-3,
        output_v: 2e-3,
        idle_a: 1e-5,
        ..regulator()
    };
    let mut system = harvester(RectifierScheme::Standard, regulator);
    system.stops.clear();
    system.drives.clear();
    (system.bridges[0].drop_v, system.bridges[0].diode_ohm) = (1e-3, diode_ohm);
    let modes = Arc::make_mut(&mut system.modes);
    (modes.frequency_rad_s[0], modes.damping_ratio[0]) = (1e-7, 1e-9);
    modes.patch.get_mut("patch").unwrap().coupling_n_per_v[0] = theta;
    let kernel = kernel(system);
    let mut start = StartState::rest(&kernel.plant);
    start.velocity[0] = -speed;
    let y = kernel.plant.from_physical(&start.physical(), 0.0);
    let mut integrator = Integrator::new(&kernel, &y, 0.0, 1e-10).unwrap();
    integrator.advance_to(60.0).unwrap();
    let cold_start_s = integrator.device_statistics()[0]
        .unwrap()
        .cold_start_s
        .unwrap();

    // x' = M x + b with x = (V_p - E, V_s)
    let (patch_f, rate) = (1.0, 1.0 / diode_ohm);
    let conductance = regulator.conductance_per_ohm() + 1.0 / leakage_ohm;
    let m = [
        [-rate / patch_f, rate / patch_f],
        [rate / STORAGE_F, -(rate + conductance) / STORAGE_F],
    ];
    let (trace, determinant) = (m[0][0] + m[1][1], m[0][0] * m[1][1] - m[0][1] * m[1][0]);
    let fast = 0.5 * (trace - (trace * trace - 4.0 * determinant).sqrt());
    let slow = determinant / fast;
    // At rest: i = (V_p - E - V_s) / r = G V_s.
    let rest_v = [
        current_a / conductance + current_a / rate,
        current_a / conductance,
    ];
    // V_s = rest + a e^(slow t) + b e^(fast t), with V_s(0) = 0 and V_s'(0) = 0.
    let b = -rest_v[1] * slow / (slow - fast);
    let a = -rest_v[1] - b;
    let wanted = |t: f64| rest_v[1] + a * (slow * t).exp() + b * (fast * t).exp();
    let slope = |t: f64| a * slow * (slow * t).exp() + b * fast * (fast * t).exp();
    let mut t = 30.0;
    for _ in 0..50 {
        t -= (wanted(t) - regulator.start_v) / slope(t);
    }
    let wanted_s = patch_f * 1e-3 / current_a + t;
    eprintln!("cold start {cold_start_s} s, closed form {wanted_s} s");
    assert!((cold_start_s / wanted_s - 1.0).abs() < 1e-9);
}

/// Without motion the storage discharges through bands and phases, each with a closed form:
/// `V' = -(G V + I) / C`.
#[test]
fn a_discharge_is_that_of_its_bands_and_phases() {
    let regulator = regulator();
    let mut system = harvester(RectifierScheme::Standard, regulator);
    system.drives.clear();
    system.stops.clear();
    let kernel = kernel(system);
    let mut integrator = started(&kernel, 0.16);
    integrator.advance_to(100.0).unwrap();
    let statistics = integrator.device_statistics()[0].unwrap();

    let g = regulator.conductance_per_ohm() + 1.0 / 40.0;
    let (mut t, mut v, mut index, mut index_of_phase) = (0.0, 0.16, regulator.band_index(0.16), 0);
    let (mut until_s, mut tasks) = (1.0, 0);
    loop {
        let band = regulator.band(index_of_phase, index);
        let rest_v = -band.held_a / g;
        let to_limit_s = STORAGE_F / g * ((v - rest_v) / (band.low_v - rest_v)).ln();
        if t + to_limit_s < until_s {
            (t, v) = (t + to_limit_s, band.low_v);
            if index == 0 {
                break;
            }
            index -= 1;
        } else {
            v = rest_v + (v - rest_v) * (-(until_s - t) * g / STORAGE_F).exp();
            t = until_s;
            index_of_phase = (index_of_phase + 1) % 3;
            tasks += u64::from(index_of_phase == 2);
            until_s = t + regulator.phases[index_of_phase].length_s;
        }
    }
    eprintln!("{statistics:?}, stop at {t} s");
    assert!(statistics.cold_start_s == Some(0.0) && statistics.starts == 1);
    assert!((statistics.on_s / t - 1.0).abs() < 1e-9);
    assert!((statistics.longest_outage_s / (100.0 - t) - 1.0).abs() < 1e-9);
    assert_eq!(statistics.completed_tasks, tasks);
    let interrupted = u64::from(index_of_phase != 2);
    assert_eq!(statistics.interrupted_tasks, interrupted);
    let now_v = 0.1 * (-(100.0 - t) * g / STORAGE_F).exp();
    assert!((storage_v(&kernel, &integrator) / now_v - 1.0).abs() < 1e-9);
}

/// RK4 with the exact law of the regulator, whose current follows the momentary voltage; diodes and
/// thresholds by small steps. Returns the storage voltage, the first start, the time on, the number
/// of starts and of completed tasks.
fn integrated(regulator: &Regulator, end_s: f64) -> (f64, f64, f64, u64, u64) {
    let step_s = 1e-4;
    let rates = |t: f64, x: &[f64; 4], output_a: Option<f64>| -> [f64; 4] {
        let [q, v, patch_v, storage_v] = *x;
        let current =
            ((patch_v.abs() - storage_v - DROP_V) / DIODE_OHM).max(0.0) * patch_v.signum();
        let contact = 50.0 * (q - 0.8).max(0.0).powf(1.5);
        let drawn = match output_a {
            None => regulator.conductance_per_ohm() * storage_v,
            Some(output_a) => {
                regulator.output_v * output_a / (regulator.efficiency * storage_v)
                    + regulator.quiescent_a
            }
        };
        let leaks = drawn + storage_v / 40.0;
        [
            v,
            (0.9 * t + 0.4).sin() - 2.0 * 0.02 * v - q + 0.5 * patch_v - contact,
            -(0.5 * v + current),
            (current.abs() - leaks) / STORAGE_F,
        ]
    };
    let (mut x, mut t) = ([0.0; 4], 0.0);
    let (mut phase, mut until_s) = (None, f64::INFINITY);
    let (mut first_s, mut on_s, mut starts, mut tasks) = (f64::NAN, 0.0, 0, 0);
    while t < end_s {
        let output_a = phase.map(|phase: usize| regulator.phases[phase].output_a);
        let add = |k: &[f64; 4], f: f64| -> [f64; 4] { std::array::from_fn(|i| x[i] + f * k[i]) };
        let a = rates(t, &x, output_a);
        let b = rates(t + 0.5 * step_s, &add(&a, 0.5 * step_s), output_a);
        let c = rates(t + 0.5 * step_s, &add(&b, 0.5 * step_s), output_a);
        let d = rates(t + step_s, &add(&c, step_s), output_a);
        for i in 0..4 {
            x[i] += step_s / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]);
        }
        t += step_s;
        if let Some(current) = phase {
            on_s += step_s;
            if x[3] < regulator.stop_v {
                (phase, until_s) = (None, f64::INFINITY);
            } else if t >= until_s {
                let next = (current + 1) % 3;
                tasks += u64::from(next == 2);
                until_s += regulator.phases[next].length_s;
                phase = Some(next);
            }
        } else if x[3] > regulator.start_v {
            first_s = if starts == 0 { t } else { first_s };
            starts += 1;
            (phase, until_s) = (Some(0), t + regulator.phases[0].length_s);
        }
    }
    (x[3], first_s, on_s, starts, tasks)
}

/// A harvester that cannot supply its device all the time. The bands change the energy of a phase
/// by less than half of their width of 1 %.
#[test]
fn outages_agree_with_a_plain_integrator() {
    let regulator = regulator();
    let kernel = kernel(harvester(RectifierScheme::Standard, regulator));
    let mut integrator = started(&kernel, 0.0);
    integrator.advance_to(200.0).unwrap();
    let ours = integrator.device_statistics()[0].unwrap();
    let (voltage_v, first_s, on_s, starts, tasks) = integrated(&regulator, 200.0);
    eprintln!(
        "{ours:?}, {} V; plain: {first_s} s, {on_s} s on, {starts} starts, {tasks} tasks, {voltage_v} V",
        storage_v(&kernel, &integrator)
    );
    assert!(ours.starts > 3 && ours.completed_tasks >= 3);
    assert!((ours.cold_start_s.unwrap() / first_s - 1.0).abs() < 1e-4);
    assert!((ours.on_s / on_s - 1.0).abs() < 5e-3);
    assert_eq!((ours.starts, ours.completed_tasks), (starts, tasks));
    assert!((storage_v(&kernel, &integrator) / voltage_v - 1.0).abs() < 1e-2);
}

fn run(kernel: &Kernel, plan: &RunPlan) -> RunResult {
    simulate(kernel, &StartState::rest(&kernel.plant), plan).unwrap()
}

/// Charge and energy of every scheme, with and without a leaking patch, over a window with starts
/// and stops. The energy of the device is its power times its times.
#[test]
fn charge_and_energy_of_a_regulator_are_balanced() {
    let plan = RunPlan {
        duration_s: 150.0,
        average_over_s: 120.0,
        tolerance: 1e-10,
        record_s: 120.0,
    };
    for (scheme, leakage_ohm) in [
        (RectifierScheme::Standard, None),
        (RectifierScheme::Standard, Some(8.0)),
        (RectifierScheme::ParallelSshi { inversion: 0.6 }, None),
        (RectifierScheme::SeriesSshi { inversion: 0.6 }, None),
        (RectifierScheme::Extraction { efficiency: 0.9 }, None),
    ] {
        let mut system = harvester(scheme, regulator());
        Arc::make_mut(&mut system.modes)
            .patch
            .get_mut("patch")
            .unwrap()
            .leakage_ohm = leakage_ohm;
        let kernel = kernel(system);
        let result = run(&kernel, &plan);
        let (device, circuit) = (&result.devices[0], &result.rectified[0]);
        let energies = &result.energies.rectified[0];
        let charges = charges(&kernel, &result, &plan);
        eprintln!(
            "{scheme:?} {leakage_ohm:?}: residual {:.1e}, charge {:?}, {device:?}",
            result.energies.residual_relative(),
            charges.first().map(|charge| charge.residual_relative),
        );
        assert!(result.energies.residual_relative().abs() < 1e-9);
        assert!(
            charges
                .iter()
                .all(|charge| charge.residual_relative.abs() < 1e-9)
        );
        assert!(device.on_fraction > 0.1, "{device:?}");
        assert!(energies.regulator_j > 0.0 && energies.idle_j > 0.0);
        let inflow_w = device.available_w + circuit.leakage_w + circuit.diode_loss_w;
        assert!(inflow_w > circuit.mean_power_w && circuit.mean_power_w > 0.0);
        assert!((device.margin_w - (device.available_w - device.needed_w)).abs() < 1e-15);
    }
}
