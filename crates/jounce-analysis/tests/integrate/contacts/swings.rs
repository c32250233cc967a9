//! Oscillations against a spring: bilinear period, preloaded contact, a blow on a piezoelectric
//! oscillator.

use crate::plants::{distance, integrate, kernel, physical, relative};
use jounce_model::reference::{Bilinear, Duffing, Impulse, Reference};
use std::f64::consts::TAU;

#[test]
fn bilinear_oscillator_comes_back_after_its_period() {
    for (stop_stiffness_n_m, gap_m) in [
        (10.0, 0.0),
        (1e4, 0.0),
        (1e7, 0.0),
        (10.0, 0.004),
        (1e4, 0.009),
    ] {
        let problem = Bilinear {
            mass_kg: 0.5,
            frequency_rad_s: 20.0,
            damping_ratio: 0.0,
            stop_stiffness_n_m,
            gap_m,
        };
        let start = problem.start(0.01);
        let kernel = kernel(problem.system());
        let swings = 20.0;
        let integrator = integrate(&kernel, &start, 0.0, swings * problem.period_s(0.01), 1e-10);
        let end = physical(&integrator, &kernel);
        // An error dt of the period appears as a speed: q' = -w^2 q dt. Relative to the period it
        // is the mean of 20 periods.
        let late = end[1] / (start[0] * 20.0 * 20.0) / (swings * problem.period_s(0.01));
        let depth = relative(
            integrator.statistics().max_penetration_m,
            problem.peak_penetration_m(0.01),
        );
        eprintln!("k {stop_stiffness_n_m:e}, gap {gap_m}: period {late:.1e}, depth {depth:.1e}");
        assert!(
            late.abs() <= Bilinear::TOLERANCE && depth <= 1e-8,
            "{late:e} {depth:e}"
        );
        assert_eq!(integrator.statistics().contacts, 20);
    }
}

/// With its centre pressed 2 mm into the stop at rest, the mass oscillates about its new
/// equilibrium and never leaves the stop.
#[test]
fn preloaded_contact_is_a_spring() {
    let problem = Bilinear {
        mass_kg: 0.5,
        frequency_rad_s: 20.0,
        damping_ratio: 0.0,
        stop_stiffness_n_m: 60.0,
        gap_m: -2e-3,
    };
    let w = problem.contact_frequency_rad_s();
    let equilibrium_m = -60.0 * 2e-3 / (0.5 * w * w);
    let kernel = kernel(problem.system());
    for end_s in [0.01, 0.1, 1.0, 3.7] {
        let integrator = integrate(&kernel, &problem.start(0.0), 0.0, end_s, 1e-10);
        let root = 0.5_f64.sqrt();
        let exact = [
            root * equilibrium_m * (1.0 - (w * end_s).cos()),
            root * equilibrium_m * w * (w * end_s).sin(),
        ];
        let error = distance(&kernel, &physical(&integrator, &kernel), &exact);
        assert!(error < 1e-8, "{end_s}: {error:e}");
        assert!(relative(integrator.statistics().time_s, end_s) < 1e-12);
        assert!(
            integrator.energies().residual_relative().abs() < 1e-9,
            "{}",
            integrator.energies().residual_relative()
        );
    }
}

/// A stop that is never reached: all energy of the blow is lost in the damping and in the load.
#[test]
fn share_of_a_blow_that_reaches_the_resistor() {
    for (damping_ratio, coupling_squared, alpha) in
        [(0.01, 0.1, 1.0), (0.005, 0.02, 0.5), (0.2, 0.5, 3.0)]
    {
        let blow = Impulse {
            alpha,
            coupling_squared,
            damping_ratio,
        };
        let mut system = blow.oscillator().system(0.0, 1.0);
        system.drives.clear();
        let kernel = kernel(system);
        let integrator = integrate(&kernel, &[0.0, 3.0, 0.0], 0.0, 12_000.0, 1e-10);
        let share = integrator.energies().loads_j[0] / 4.5;
        assert!(
            relative(share, blow.efficiency()) < Impulse::TOLERANCE,
            "{share} {}",
            blow.efficiency()
        );
    }
}

/// Pressed so deep that it never leaves the stop, the mass has one stiffer spring.
#[test]
fn stiffness_in_parallel_adds() {
    let soft = Bilinear {
        mass_kg: 0.5,
        frequency_rad_s: 20.0,
        damping_ratio: 0.0,
        stop_stiffness_n_m: 300.0,
        gap_m: -1.0,
    };
    let kernel = kernel(soft.system());
    let w = soft.contact_frequency_rad_s();
    let equilibrium_m = -300.0 / (0.5 * w * w);
    // Released 1 cm from the equilibrium, it returns after one period of the stiffened spring.
    let start = [0.5_f64.sqrt() * (equilibrium_m + 0.01), 0.0];
    let integrator = integrate(&kernel, &start, 0.0, 10.0 * TAU / w, 1e-10);
    let error = distance(&kernel, &physical(&integrator, &kernel), &start);
    assert!(error < 1e-9, "{error:e}");
}

/// A cubic spring on both sides, hardening and softening: returns after twenty exact periods with
/// its energy. Measured: period 8e-13, and 4e-10 at a large softening amplitude near the unstable
/// equilibrium (1.4 of 1.414); energy 6e-12.
#[test]
fn duffing_oscillator_comes_back_after_its_elliptic_period() {
    for (cubic_stiffness_n_m3, amplitude_m) in [
        (0.5, 1.0),
        (1.0, 1.0),
        (1.0, 30.0),
        (-0.5, 1.0),
        (-0.5, 1.4),
    ] {
        let problem = Duffing {
            mass_kg: 0.5,
            frequency_rad_s: 1.0,
            damping_ratio: 0.0,
            cubic_stiffness_n_m3: 0.5 * cubic_stiffness_n_m3,
        };
        let (start, swings) = (problem.at_rest(-amplitude_m), 20.0);
        let kernel = kernel(problem.system());
        let period_s = TAU / problem.backbone_rad_s(amplitude_m);
        let integrator = integrate(&kernel, &start, 0.0, swings * period_s, 1e-10);
        let end = physical(&integrator, &kernel);
        let pull = 1.0 + cubic_stiffness_n_m3 * amplitude_m * amplitude_m;
        let late = end[1] / (start[0] * pull) / (swings * period_s);
        let depth = relative(integrator.statistics().max_penetration_m, amplitude_m);
        let energy = integrator.energies().residual_relative();
        eprintln!(
            "b {cubic_stiffness_n_m3}, amplitude {amplitude_m}: period {late:.1e}, depth {depth:.1e}, energy {energy:.1e}"
        );
        eprintln!("{:?}", integrator.work());
        assert!(
            late.abs() <= Duffing::TOLERANCE && depth <= 1e-8 && energy.abs() < 1e-9,
            "{late:e} {depth:e} {energy:e}"
        );
        assert_eq!(integrator.statistics().contacts, 0);
    }
}
