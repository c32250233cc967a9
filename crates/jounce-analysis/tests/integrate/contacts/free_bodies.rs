//! A mass without stiffness that carries a patch on a small resistor, between rigid stops, against
//! closed forms. The patch slows it down at `theta^2 R` per second, over days or longer.

use crate::plants::{integrate, kernel, physical, springs};
use jounce_dynamics::Kernel;
use jounce_model::contact::{Law, Rigid};
use jounce_model::drive::Wave;
use jounce_model::plant::{Drive, Load, Signal, Stop};
use jounce_model::structure::PatchModes;
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::sync::Arc;

const CAPACITANCE_F: f64 = 5e-7;
const RESISTANCE_OHM: f64 = 15.0;
const GRAVITY_M_S2: f64 = 9.81;
const RESTITUTION: f64 = 0.8;
const GAP_M: f64 = 2e-3;
const AMPLITUDE_M_S2: f64 = 30.0;
const FREQUENCY_HZ: f64 = 40.0;

/// A mass of 1 kg between two stops, with its patch.
fn body(theta_n_per_v: f64, gravity_m_s2: f64, amplitude_n: f64) -> Kernel {
    let mut system = springs(&[0.0], 0.0);
    let patch = PatchModes {
        coupling_n_per_v: vec![theta_n_per_v],
        capacitance_f: CAPACITANCE_F,
        leakage_ohm: None,
        strain: Vec::new(),
    };
    Arc::make_mut(&mut system.modes).patch = BTreeMap::from([("p".into(), patch)]);
    system.loads = vec![Load::resistor("c", "p", RESISTANCE_OHM)];
    system.stops = [1.0, -1.0]
        .map(|side| Stop {
            name: format!("stop {side}"),
            shape: vec![side],
            gap_m: GAP_M,
            law: Law::Rigid(Rigid {
                restitution: RESTITUTION,
            }),
            bases: Vec::new(),
        })
        .to_vec();
    system.drives = vec![Drive {
        name: "d".into(),
        shape: vec![1.0],
        amplitude_n,
        frequency_hz: FREQUENCY_HZ,
        phase_rad: 0.0,
        base: None,
    }];
    system.signals = vec![Signal {
        name: "gravity".into(),
        shape: vec![1.0],
        wave: Wave::Constant(gravity_m_s2),
        base: None,
        drawn_from: None,
    }];
    kernel(system)
}

/// Exact motion `(x, v)` a time after `(x, v)` at another time, with impacts on the stops; `flight`
/// is the motion without stops.
fn bounced(
    mut state: [f64; 3],
    mut time_s: f64,
    end_s: f64,
    flight: impl Fn([f64; 3], f64, f64) -> [f64; 3],
) -> ([f64; 3], u32) {
    let (sample_s, mut impacts) = (1e-5_f64, 0);
    while time_s < end_s {
        let step_s = sample_s.min(end_s - time_s);
        let is_past = |after_s: f64| flight(state, time_s, after_s)[0].abs() > GAP_M;
        if !is_past(step_s) {
            state = flight(state, time_s, step_s);
            time_s += step_s;
            continue;
        }
        let (mut low, mut high) = (0.0, step_s);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if is_past(middle) {
                high = middle;
            } else {
                low = middle;
            }
        }
        state = flight(state, time_s, low);
        state[0] = GAP_M.copysign(state[0]) * (1.0 - 1e-16);
        state[1] *= -RESTITUTION;
        (time_s, impacts) = (time_s + low, impacts + 1);
    }
    (state, impacts)
}

/// `(1 - e^(-r t)) / r`, and its integral over time.
fn decayed(rate: f64, t: f64) -> [f64; 2] {
    let first = -(-rate * t).exp_m1() / rate;
    let z = rate * t;
    let second = if z < 0.1 {
        let terms = (0..12).scan(0.5 * t * t, |term, k| {
            let this = *term;
            *term *= -z / f64::from(k + 3);
            Some(this)
        });
        terms.sum()
    } else {
        (t - first) / rate
    };
    [first, second]
}

/// `v'' + v' / (R C) + theta^2 v / C = g / (R C)`, whose two rates have the product `theta^2 / C`.
fn slowed_fall(theta: f64, [x, v, voltage]: [f64; 3], t: f64) -> [f64; 3] {
    let charging = 1.0 / (RESISTANCE_OHM * CAPACITANCE_F);
    let product = theta * theta / CAPACITANCE_F;
    let fast = 0.5 * (charging + (charging * charging - 4.0 * product).sqrt());
    let slow = product / fast;
    let [of_slow, of_fast] = [slow, fast].map(|rate| decayed(rate, t));
    let [e_slow, e_fast] = [slow, fast].map(|rate| (-rate * t).exp());
    let apart = fast - slow;
    let first = GRAVITY_M_S2 + theta * voltage + slow * v;
    let forced = GRAVITY_M_S2 * charging;
    let part = |of: [f64; 2], k: usize| of[k] / apart;
    let moved = v * of_slow[0]
        + first * (part(of_slow, 0) - part(of_fast, 0))
        + forced * (part(of_slow, 1) - part(of_fast, 1));
    let speed = v * e_slow
        + first * (e_slow - e_fast) / apart
        + forced * (part(of_slow, 0) - part(of_fast, 0));
    let acceleration = -slow * v * e_slow
        + first * (fast * e_fast - slow * e_slow) / apart
        + forced * (e_slow - e_fast) / apart;
    [x + moved, speed, (acceleration - GRAVITY_M_S2) / theta]
}

/// Falls from the middle, and bounces on the lower stop. Before the displacement was the integral
/// of the velocity, `theta = 0.03 N/V` gave errors of 1e-6, and smaller ones were refused.
#[test]
fn a_slowed_body_falls_and_bounces() {
    for theta in [3.0, 0.03, 1e-4, 1e-8] {
        let kernel = body(theta, GRAVITY_M_S2, 0.0);
        let end_s = 0.06;
        let state = physical(&integrate(&kernel, &[0.0; 3], 0.0, end_s, 1e-10), &kernel);
        let flight = |state: [f64; 3], _: f64, after_s: f64| slowed_fall(theta, state, after_s);
        let (exact, impacts) = bounced([0.0; 3], 0.0, end_s, flight);
        let error_m = (state[0] - exact[0]).abs();
        let error_m_s = (state[1] - exact[1]).abs();
        eprintln!("{theta} N/V, {impacts} impacts: {error_m:.1e} m, {error_m_s:.1e} m/s");
        assert!(impacts >= 2);
        assert!(error_m < 1e-11 * GAP_M && error_m_s < 1e-10, "{theta}");
    }
}

/// A shaken body between its stops, slowed by less than roundoff: `x'' = g + a sin(w t)`.
#[test]
fn a_driven_body_flies_from_stop_to_stop() {
    let kernel = body(1e-9, GRAVITY_M_S2, AMPLITUDE_M_S2);
    let w = TAU * FREQUENCY_HZ;
    let flight = |[x, v, _]: [f64; 3], from_s: f64, t: f64| {
        let [(sin, cos), (sin_end, cos_end)] = [from_s, from_s + t].map(|t| (w * t).sin_cos());
        let driven = AMPLITUDE_M_S2 / w;
        let speed = v + GRAVITY_M_S2 * t + driven * (cos - cos_end);
        let moved = v * t + 0.5 * GRAVITY_M_S2 * t * t + driven * (cos * t - (sin_end - sin) / w);
        [x + moved, speed, 0.0]
    };
    let start = [0.0, -0.3, 0.0];
    let end_s = 0.1;
    let state = physical(&integrate(&kernel, &start, 0.0, end_s, 1e-10), &kernel);
    let (exact, impacts) = bounced(start, 0.0, end_s, flight);
    let error_m = (state[0] - exact[0]).abs();
    eprintln!("{impacts} impacts: {error_m:.1e} m of {} m", exact[0]);
    assert!(impacts >= 3 && error_m < 1e-9 * GAP_M);
}
