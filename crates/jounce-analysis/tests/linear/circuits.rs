//! Wiring and inductors against explicit circuit equations, and the conserved charge of open
//! patches.

use jounce_linalg::c64;
use jounce_model::linear::{FrfInput, FrfOutput, frf};
use jounce_model::plant::{Connection, Load, Meters, Plant, System};
use jounce_model::structure::{Modes, PatchModes};
use jounce_spec::Wiring;
use std::collections::BTreeMap;
use std::f64::consts::TAU;

const NAMES: [&str; 3] = ["a", "b", "c"];

/// Three modes and three unequal patches.
fn modes() -> Modes {
    let patch = |coupling: [f64; 3], capacitance_f: f64| PatchModes {
        coupling_n_per_v: coupling.to_vec(),
        capacitance_f,
        leakage_ohm: None,
        strain: Vec::new(),
    };
    Modes {
        frequency_rad_s: vec![60.0, 300.0, 900.0],
        damping_ratio: vec![0.01, 0.02, 0.005],
        shape: BTreeMap::from([("tip".into(), vec![1.0, -2.0, 1.5])]),
        patch: BTreeMap::from([
            ("a".into(), patch([2e-3, 5e-3, -4e-3], 1e-7)),
            ("b".into(), patch([-1e-3, 6e-3, 9e-3], 3e-8)),
            ("c".into(), patch([3e-3, -1e-3, 2e-3], 6e-8)),
        ]),
        participation_sqrt_kg: vec![0.3, 0.1, -0.05],
        base_sqrt_kg: BTreeMap::new(),
        discretisation_error: vec![0.0; 3],
        ..Modes::default()
    }
}

fn load(patches: &[(&str, f64)], wiring: Wiring, inductor: Option<(f64, Wiring)>) -> Load {
    let connections = patches
        .iter()
        .map(|(patch, sign)| Connection {
            patch: (*patch).to_owned(),
            sign: *sign,
        })
        .collect();
    Load {
        name: "load".into(),
        connections,
        wiring,
        resistance_ohm: 5e4,
        inductor,
    }
}

fn plant(load: &Load) -> Plant {
    Plant::new(System {
        modes: modes().into(),
        loads: vec![load.clone()],
        stops: Vec::new(),
        bridges: Vec::new(),
        dashpots: Vec::new(),
        signals: Vec::new(),
        drives: Vec::new(),
    })
    .unwrap()
}

/// Equation of patch `p`, whose current is `current i`.
///
/// The current out of patch `p` is `i_p = source_p - sum_r Y_pr V_r`, with `Y` its capacitance and
/// the dynamic admittance of the modes. The source is the motion of the base.
fn current_balance(p: usize, current: c64, w: f64) -> Vec<c64> {
    let (modes, s) = (modes(), c64::new(0.0, w));
    let theta = |patch: usize, mode: usize| modes.patch[NAMES[patch]].coupling_n_per_v[mode];
    let dynamic = |mode: usize| {
        let natural = modes.frequency_rad_s[mode];
        c64::new(
            natural * natural - w * w,
            2.0 * modes.damping_ratio[mode] * natural * w,
        )
    };
    let admittance = |r: usize| {
        let modal: c64 = (0..3)
            .map(|mode| s * (theta(p, mode) * theta(r, mode)) / dynamic(mode))
            .sum();
        if p == r {
            modal + s * modes.patch[NAMES[p]].capacitance_f
        } else {
            modal
        }
    };
    let source: c64 = (0..3)
        .map(|mode| s * (theta(p, mode) * modes.participation_sqrt_kg[mode]) / dynamic(mode))
        .sum();
    vec![admittance(0), admittance(1), admittance(2), current, source]
}

/// Impedance of the load with its inductor.
fn load_impedance(load: &Load, w: f64) -> c64 {
    let s = c64::new(0.0, w);
    match load.inductor {
        None => c64::new(load.resistance_ohm, 0.0),
        Some((l, Wiring::Parallel)) => {
            1.0 / (c64::new(1.0 / load.resistance_ohm, 0.0) + 1.0 / (s * l))
        }
        Some((l, Wiring::Series)) => s * l + load.resistance_ohm,
    }
}

/// Linear equations on `(V_a, V_b, V_c, i)`, `i` the current into the load: coefficients and right
/// side.
///
/// Series members carry `sign i`, parallel ones have `sign V`, open ones carry no current.
fn equations(load: &Load, w: f64) -> Vec<Vec<c64>> {
    let zero = c64::new(0.0, 0.0);
    let balance = |p: usize, current: c64| current_balance(p, current, w);
    let sign = |p: usize| {
        load.connections
            .iter()
            .find(|connection| connection.patch == NAMES[p])
            .map_or(0.0, |connection| connection.sign)
    };
    let members: Vec<usize> = (0..3).filter(|p| sign(*p) != 0.0).collect();
    let mut rows: Vec<Vec<c64>> = (0..3)
        .filter(|p| sign(*p) == 0.0)
        .map(|p| balance(p, zero))
        .collect();
    let mut terminal = vec![zero; 5];
    terminal[3] = -load_impedance(load, w);
    if load.wiring == Wiring::Series {
        rows.extend(members.iter().map(|p| balance(*p, c64::new(sign(*p), 0.0))));
        members
            .iter()
            .for_each(|p| terminal[*p] = c64::new(sign(*p), 0.0));
    } else {
        let mut sum = vec![zero; 5];
        for p in &members {
            balance(*p, zero)
                .iter()
                .zip(&mut sum)
                .for_each(|(entry, sum)| *sum += entry * sign(*p));
        }
        sum[3] = c64::new(1.0, 0.0);
        rows.push(sum);
        for pair in members.windows(2) {
            let mut same = vec![zero; 5];
            (same[pair[0]], same[pair[1]]) =
                (c64::new(sign(pair[0]), 0.0), c64::new(-sign(pair[1]), 0.0));
            rows.push(same);
        }
        terminal[members[0]] = c64::new(sign(members[0]), 0.0);
    }
    rows.push(terminal);
    rows
}

/// Gauss elimination with pivoting; the last column is the right side.
fn solve(mut rows: Vec<Vec<c64>>) -> Vec<c64> {
    let n = rows.len();
    for k in 0..n {
        let pivot = (k..n)
            .max_by(|i, j| rows[*i][k].norm().total_cmp(&rows[*j][k].norm()))
            .unwrap();
        rows.swap(k, pivot);
        let above = rows[k].clone();
        for i in (0..n).filter(|i| *i != k) {
            let factor = rows[i][k] / above[k];
            rows[i]
                .iter_mut()
                .zip(&above)
                .for_each(|(value, above)| *value -= factor * above);
        }
    }
    (0..n).map(|k| rows[k][n] / rows[k][k]).collect()
}

/// Every wiring of unequal patches, with and without an inductor.
#[test]
fn voltages_solve_the_circuit_equations() {
    let outputs = NAMES.map(|name| FrfOutput::Voltage(name.into()));
    let mut worst = 0.0_f64;
    for patches in [
        &[("a", 1.0), ("b", -1.0)][..],
        &[("c", 1.0), ("a", -1.0), ("b", 1.0)],
        &[("b", -1.0)],
    ] {
        for wiring in [Wiring::Parallel, Wiring::Series] {
            for inductor in [
                None,
                Some((40.0, Wiring::Parallel)),
                Some((90.0, Wiring::Series)),
            ] {
                let load = load(patches, wiring, inductor);
                let plant = plant(&load);
                for frequency_hz in [3.0, 9.6, 40.0, 150.0] {
                    let exact = solve(equations(&load, TAU * frequency_hz));
                    let responses = frf(
                        &plant,
                        &FrfInput::BaseAcceleration,
                        &outputs,
                        &[frequency_hz],
                    )
                    .unwrap();
                    let scale = exact[..3].iter().map(|v| v.norm()).fold(0.0, f64::max);
                    for (response, exact) in responses.iter().zip(&exact) {
                        let error = (response.value[0] - exact).norm() / scale;
                        worst = worst.max(error);
                        assert!(
                            error < 1e-9,
                            "{patches:?} {wiring:?} {inductor:?} {frequency_hz} Hz: {error:e}"
                        );
                    }
                }
            }
        }
    }
    eprintln!("largest error {worst:.1e}");
}

/// An open patch has constant charge: its state is at rest, has rate exactly 0, and enters no
/// meter.
#[test]
fn an_open_patch_keeps_its_charge() {
    let plant = plant(&load(&[("a", 1.0)], Wiring::Parallel, None));
    let reals = &plant.diagonal.block.reals;
    let zeros: Vec<usize> = (0..reals.len()).filter(|k| reals[*k] == 0.0).collect();
    assert_eq!(zeros.len(), 2, "{reals:?}");
    for k in zeros {
        let column = 2 * plant.diagonal.block.pairs.len() + k;
        assert!((3..6).all(|velocity| plant.diagonal.to_physical[(velocity, column)] == 0.0));
        assert_eq!(plant.load_voltage_row(0)[column], 0.0);
    }
    assert!(Meters::new(&plant).is_ok());
}
