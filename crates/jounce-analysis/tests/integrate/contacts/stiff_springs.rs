//! Stiff springs that stay in contact while the bodies move slowly, and fast modes under a force that
//! always acts: against the closed form or Runge and Kutta's method, and the number of steps.

use super::several_stops::stop;
use crate::plants::{integrate, kernel, physical, springs};
use crate::runge_kutta::runge_kutta;
use jounce_model::contact::{Cubic, KelvinVoigt, Law};
use std::f64::consts::TAU;

const STIFFNESS_N_M: f64 = 1e8;
const GAP_M: f64 = -1e-2;
const AMPLITUDE_M: f64 = 1e-4;
const END_S: f64 = 2.0;

/// Two unit masses on springs to the ground, whose sum a stiff stop keeps near `GAP_M`. They start
/// at rest, away from the equilibrium along the slow mode.
struct Held {
    stiffness_n_m: [f64; 2],
}

impl Held {
    fn of(frequencies_hz: [f64; 2]) -> Self {
        Self {
            stiffness_n_m: frequencies_hz.map(|f| (TAU * f).powi(2)),
        }
    }

    /// `(k_i + K) x_i + K x_j = K gap` at rest.
    fn at_rest_m(&self) -> [f64; 2] {
        let [a, b] = self.stiffness_n_m;
        let determinant = a * b + STIFFNESS_N_M * (a + b);
        [b, a].map(|other| STIFFNESS_N_M * GAP_M * other / determinant)
    }

    /// Square of the slow frequency and the second entry of its mode; the first is 1.
    fn slow(&self) -> [f64; 2] {
        let [a, b] = self.stiffness_n_m;
        let determinant = a * b + STIFFNESS_N_M * (a + b);
        let sum = a + b + 2.0 * STIFFNESS_N_M;
        let fast = 0.5 * (sum + (sum * sum - 4.0 * determinant).sqrt());
        let slow = determinant / fast;
        [slow, (slow - a - STIFFNESS_N_M) / STIFFNESS_N_M]
    }

    fn displacements_m(&self, time_s: f64) -> [f64; 2] {
        let ([first, second], [slow, entry]) = (self.at_rest_m(), self.slow());
        let moved_m = AMPLITUDE_M * (slow.sqrt() * time_s).cos();
        [first + moved_m, second + entry * moved_m]
    }
}

/// The stiff mode turns 4,500 times: 28,000 rad, of which the fixed point of a step allows about one.
/// One stop, and two at once.
#[test]
fn a_stiff_spring_that_holds_a_slow_motion_costs_no_steps() {
    let both = [([10.0, 14.0], "first"), ([8.0, 17.0], "second")];
    for held in [&both[..1], &both[..]] {
        let frequencies: Vec<f64> = held.iter().flat_map(|(hz, _)| *hz).collect();
        let (mut system, count) = (springs(&frequencies, 0.0), frequencies.len());
        let mut start = vec![0.0; 2 * count];
        for (index, (hz, name)) in held.iter().enumerate() {
            let mut shape = vec![0.0; count];
            shape[2 * index..2 * index + 2].fill(1.0);
            start[2 * index..2 * index + 2].copy_from_slice(&Held::of(*hz).displacements_m(0.0));
            let law = Law::KelvinVoigt(KelvinVoigt {
                stiffness_n_m: STIFFNESS_N_M,
                damping_n_s_m: 0.0,
            });
            system.stops.push(stop(name, &shape, GAP_M, law));
        }
        let kernel = kernel(system);
        let integrator = integrate(&kernel, &start, 0.0, END_S, 1e-9);
        let end = physical(&integrator, &kernel);
        let exact = held
            .iter()
            .flat_map(|(hz, _)| Held::of(*hz).displacements_m(END_S));
        let error = end
            .iter()
            .zip(exact)
            .map(|(x, exact)| (x - exact).abs() / AMPLITUDE_M)
            .fold(0.0, f64::max);
        let work = integrator.work();
        eprintln!("error {error:.1e}, {work:?}");
        assert!(error < 1e-6, "{error:e}");
        assert!(
            work.contact_steps + work.contact_rejections < 5_000,
            "{work:?}"
        );
    }
}

/// A cubic spring drives a slow and a fast mode. The fast one follows the force and turns 6,000 times:
/// 38,000 rad.
#[test]
fn a_fast_mode_that_follows_a_cubic_force_costs_no_steps() {
    const CUBIC_N_M3: f64 = 1e6;
    let frequencies = [2.0, 3000.0];
    let stiffness = frequencies.map(|f| (TAU * f).powi(2));
    let force_n = |x: f64, y: f64| CUBIC_N_M3 * (x + y).powi(3);
    let start_m = 0.01;
    let follows_m = (0..50).fold(0.0, |y, _| -force_n(start_m, y) / stiffness[1]);
    let mut system = springs(&frequencies, 0.0);
    let law = Law::Cubic(Cubic {
        stiffness_n_m: 0.0,
        cubic_stiffness_n_m3: CUBIC_N_M3,
    });
    system.stops.push(stop("cubic", &[1.0, 1.0], 0.0, law));
    let kernel = kernel(system);
    let integrator = integrate(&kernel, &[start_m, follows_m, 0.0, 0.0], 0.0, END_S, 1e-9);
    let end = physical(&integrator, &kernel);
    let rates = |_, [x, y, u, v]: [f64; 4]| {
        let force = force_n(x, y);
        [u, v, -stiffness[0] * x - force, -stiffness[1] * y - force]
    };
    let reference = runge_kutta(rates, [start_m, follows_m, 0.0, 0.0], END_S, 1_500_000);
    let error = ((end[0] - reference[0]) / start_m).abs();
    let work = integrator.work();
    eprintln!("error {error:.1e}, {work:?}");
    assert!(error < 1e-7, "{error:e}");
    assert!(
        work.contact_steps + work.contact_rejections < 500,
        "{work:?}"
    );
}
