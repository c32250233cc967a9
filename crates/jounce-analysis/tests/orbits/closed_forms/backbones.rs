//! Driven oscillators at phase resonance, against the exactly known period of their free motion.
//!
//! Under `F sin(w t)` the motion `x(-t) = x(t)` of the undriven, undamped oscillator lags the drive
//! by a quarter of a period, and force and damping balance. At a given amplitude both change the
//! frequency to second order in the damping.

use crate::harvesters::Systems;
use jounce_continuation::{Corrector, Metric, Position, correct_at};
use jounce_dynamics::{Integrator, Kernel};
use jounce_model::plant::{Plant, System};
use jounce_model::reference::{Bilinear, Duffing};
use jounce_orbits::{HarmonicBalance, Orbit, OrbitMethod, ParametricModel, Shooting};
use std::f64::consts::TAU;

const CORRECTOR: Corrector = Corrector {
    goal: 1e-11,
    most: 20,
};

/// Where a multiplier is close to 1, errors of the integration are amplified.
const AT_RESONANCE: Corrector = Corrector {
    goal: 2e-10,
    most: 20,
};

/// Orbit at a parameter, from a physical state near it.
fn orbit(
    make: &(impl Fn(f64) -> System + Sync),
    corrector: &Corrector,
    state: &[f64],
    parameter: f64,
) -> Orbit {
    let harvester = Systems(make);
    let kernel = harvester.at(parameter).unwrap().kernel;
    let shooting = Shooting::new(&harvester, &kernel, 1, 1e-12);
    let position = Position {
        unknown: shooting.unknown(state),
        parameter,
    };
    let solution = correct_at(&shooting, corrector, &Metric::at(&position, 1.0), position).unwrap();
    shooting.orbit(&solution.local, solution.error).unwrap()
}

/// Parameter, and displacement relative to the drive, where the velocity vanishes at the start of
/// the cycle: by secants.
pub fn phase_resonance(
    make: impl Fn(f64) -> System + Sync,
    start: &[f64],
    parameter: f64,
    scale: f64,
) -> (f64, f64) {
    let speed_at = |state: &[f64], parameter: f64| {
        let candidate = orbit(&make, &AT_RESONANCE, state, parameter);
        let kernel = Systems(&make).at(parameter).unwrap().kernel;
        let physical =
            Shooting::new(&Systems(&make), &kernel, 1, 1e-12).physical(candidate.start());
        (physical[1], physical)
    };
    let (mut at, mut next) = (parameter, parameter * (1.0 + 1e-5));
    let (mut speed, mut state) = speed_at(start, at);
    for _ in 0..30 {
        let (next_speed, reached) = speed_at(&state, next);
        let step = -next_speed * (next - at) / (next_speed - speed);
        (at, speed, state) = (next, next_speed, reached);
        // The phase is then equally accurate, and the amplitude better by the factor of the
        // damping.
        if speed.abs() < 1e-8 * scale {
            return (at, -state[0]);
        }
        next = at + step;
    }
    panic!("no phase resonance near {parameter}");
}

/// Force that balances the damping `c x'` of the free motion that starts at rest:
/// `c int x'^2 dt = F int x' sin(w t) dt`.
fn balancing_force(free: System, start: &[f64], w: f64, damping_n_s_m: f64) -> f64 {
    let kernel = Kernel::new(Plant::new(free).unwrap()).unwrap();
    let mut integrator =
        Integrator::new(&kernel, &kernel.plant.from_physical(start, 0.0), 0.0, 1e-10).unwrap();
    let samples = 256;
    let (mut dissipation, mut input) = (0.0, 0.0);
    for k in 1..=samples {
        let angle = TAU * f64::from(k) / f64::from(samples);
        integrator.advance_to(angle / w).unwrap();
        let speed = kernel.plant.to_physical(&integrator.state(), 0.0)[1];
        (dissipation, input) = (dissipation + speed * speed, input + speed * angle.sin());
    }
    damping_n_s_m * dissipation / input
}

/// Errors of the frequency at two dampings; the second damping is half the first.
fn check(name: &str, errors: [f64; 2], allowed: f64) {
    let order = (errors[0] / errors[1]).abs().log2();
    eprintln!(
        "{name}: off the backbone by {:.2e} and {:.2e}, order {order:.3} in the damping",
        errors[0], errors[1]
    );
    assert!(
        errors[1].abs() < allowed && (order - 2.0).abs() < 0.05,
        "{name}: {errors:?}, order {order}"
    );
}

/// Measured at the lower damping: 3e-7 to 9.3e-7, order 2.000.
#[test]
fn duffing_backbone_is_elliptic() {
    for (b, amplitude) in [(0.5, 1.0), (1.0, 1.0), (2.0, 1.0), (-0.4, 1.0)] {
        let errors = [0.008, 0.004].map(|damping_ratio| {
            let duffing = Duffing {
                mass_kg: 1.0,
                frequency_rad_s: 1.0,
                damping_ratio,
                cubic_stiffness_n_m3: b,
            };
            let w = duffing.backbone_rad_s(amplitude);
            let free = Duffing {
                damping_ratio: 0.0,
                ..duffing
            }
            .system();
            let force = balancing_force(free, &duffing.at_rest(-amplitude), w, 2.0 * damping_ratio);
            let (_, reached) = phase_resonance(
                |force| duffing.driven(force, w),
                &duffing.at_rest(-amplitude),
                force,
                amplitude,
            );
            duffing.backbone_rad_s(reached) / w - 1.0
        });
        check(&format!("b {b}, amplitude {amplitude}"), errors, 1e-5);
    }
}

/// Measured at the lower damping: 2.5e-6 to 4.1e-6, order 2.000.
#[test]
fn bilinear_backbone_is_two_joined_sinusoids() {
    for (gap_m, away_m) in [(0.3, 1.0), (0.8, 1.0), (0.3, 4.0)] {
        let errors = [0.008, 0.004].map(|damping_ratio| {
            let bilinear = Bilinear {
                mass_kg: 1.0,
                frequency_rad_s: 1.0,
                damping_ratio,
                stop_stiffness_n_m: 8.0,
                gap_m,
            };
            let w = TAU / bilinear.period_s(away_m);
            let free = Bilinear {
                damping_ratio: 0.0,
                ..bilinear
            }
            .system();
            let force = balancing_force(free, &bilinear.start(away_m), w, 2.0 * damping_ratio);
            let (_, reached) = phase_resonance(
                |force| bilinear.driven(force, w),
                &bilinear.start(away_m),
                force,
                away_m,
            );
            TAU / bilinear.period_s(reached) / w - 1.0
        });
        check(&format!("gap {gap_m}, amplitude {away_m}"), errors, 1e-4);
    }
}

/// Without a gap the frequency does not depend on the amplitude: `2 w1 w2 / (w1 + w2)`, here
/// `2 * 1 * 3 / (1 + 3)`.
#[test]
fn without_a_gap_the_resonance_is_the_bilinear_frequency() {
    let errors = [0.008, 0.004].map(|damping_ratio| {
        let bilinear = Bilinear {
            mass_kg: 1.0,
            frequency_rad_s: 1.0,
            damping_ratio,
            stop_stiffness_n_m: 8.0,
            gap_m: 0.0,
        };
        let force = 2.0 * damping_ratio * 1.5;
        let (w, _) = phase_resonance(
            |w| bilinear.driven(force, w),
            &bilinear.start(1.0),
            1.5,
            1.0,
        );
        w / 1.5 - 1.0
    });
    check("no gap", errors, 1e-4);
}

/// A two-sided spring by harmonic balance: the state and the multipliers of shooting, within both
/// error estimates.
#[test]
fn harmonic_balance_agrees_with_shooting_on_a_cubic_spring() {
    for (b, gap_m, drive_rad_s) in [(1.0, 0.0, 1.2), (-0.3, 0.0, 0.7), (1.0, 0.2, 1.3)] {
        let duffing = Duffing {
            mass_kg: 1.0,
            frequency_rad_s: 1.0,
            damping_ratio: 0.05,
            cubic_stiffness_n_m3: b,
        };
        let make = |force: f64| {
            let mut system = duffing.driven(force, drive_rad_s);
            system.stops[0].gap_m = gap_m;
            system
        };
        let (force, harvester) = (0.1, Systems(make));
        let exact = orbit(&make, &CORRECTOR, &duffing.at_rest(0.0), force);
        let kernel = harvester.at(force).unwrap().kernel;
        let mut last = f64::INFINITY;
        for harmonics in [4, 8, 24] {
            let method = HarmonicBalance::new(
                Shooting::new(&harvester, &kernel, 1, 1e-12),
                &kernel,
                harmonics,
                0.0,
            )
            .unwrap();
            let position = Position {
                unknown: method.unknown_of(exact.start(), force).unwrap(),
                parameter: force,
            };
            let solution =
                correct_at(&method, &CORRECTOR, &Metric::at(&position, 1.0), position).unwrap();
            let other = method.orbit(&solution.local, solution.error).unwrap();
            let error = exact
                .start()
                .iter()
                .zip(other.start())
                .map(|(a, b)| (a - b).abs())
                .fold(0.0, f64::max)
                / exact.size();
            eprintln!(
                "b {b}, gap {gap_m}, {harmonics} harmonics: state off by {error:.1e}, estimate {:.1e}",
                other.error_estimate
            );
            assert!(
                error < 3.0 * other.error_estimate + 1e-10 && error < (0.1 * last).max(1e-10),
                "{error:e} after {last:e}"
            );
            assert!(
                (other.floquet_max_abs() - exact.floquet_max_abs()).abs() < 10.0 * error + 1e-9
                    && other.contacts == 0
            );
            last = error;
        }
    }
}
