//! Steady states against the physical equations and closed forms.

use crate::diagonal::physical_matrix;
use crate::systems::bench;
use jounce_linalg::c64;
use jounce_model::plant::Plant;
use jounce_model::reference::Reference;
use jounce_model::reference::{Harmonic, MASS, PiezoResistor};
use std::f64::consts::TAU;

/// `(i w I - A) X = B G` in physical coordinates.
#[test]
fn steady_state_solves_the_physical_equations() {
    let system = bench();
    let plant = Plant::new(system.clone()).unwrap();
    let (a, scale) = physical_matrix(&system);
    let (tone, n) = (&plant.tones[0], plant.len());
    let t = &plant.diagonal.to_physical;
    let x: Vec<c64> = (0..n)
        .map(|i| (0..n).map(|j| tone.steady[j] * t[(i, j)]).sum())
        .collect();
    let modes = system.modes.len();
    let norm = |i: usize| {
        (0..n)
            .map(|j| (x[j] * a[(i, j)]).norm())
            .fold(0.0, f64::max)
    };
    let size = (0..n).map(|i| scale[i] * norm(i)).fold(0.0, f64::max);
    for i in 0..n {
        let force = if i >= modes && i < 2 * modes {
            tone.force[i - modes]
        } else {
            c64::new(0.0, 0.0)
        };
        let inertia = c64::new(0.0, tone.angular_frequency_rad_s) * x[i];
        let flow: c64 = (0..n).map(|j| x[j] * a[(i, j)]).sum();
        let residual = scale[i] * (inertia - flow - force).norm() / size;
        // Roundoff of 17 states through the eigenvectors and back: measured 9e-14.
        assert!(residual < 1e-12, "row {i}: {residual:e}");
    }
}

#[test]
fn steady_state_of_one_mode_is_the_closed_form() {
    for (frequency_rad_s, damping_ratio, drive_hz) in [
        (60.0, 0.02, 7.0),
        (60.0, 0.3, 60.0 / TAU),
        (60.0, 1.0, 3.0),
        (60.0, 4.0, 30.0),
        (0.0, 0.0, 5.0),
    ] {
        let problem = Harmonic {
            mass_kg: 0.2,
            frequency_rad_s,
            damping_ratio,
            amplitude_n: 3.0,
            drive_hz,
        };
        let system = problem.system();
        let plant = Plant::new(system.clone()).unwrap();
        let response = plant.steady_output(&plant.displacement_row(&system.modes.shape[MASS]))[0];
        // x = X sin(w t - a) = Re(-i X e^{-i a} e^{i w t})
        let exact = c64::new(0.0, -problem.amplitude_m()) * c64::cis(-problem.lag_rad());
        let error = (response - exact).norm() / exact.norm();
        assert!(error < Harmonic::TOLERANCE, "{problem:?}: {error:e}");
    }
}

#[test]
fn voltage_and_power_of_one_mode_are_the_closed_form() {
    for (resistance_ohm, drive_hz) in [(1e3, 47.0), (3e4, 106.7), (1e7, 120.0)] {
        let problem = PiezoResistor {
            mass_kg: 9.12e-3,
            frequency_rad_s: 670.493,
            damping_ratio: 0.0178,
            coupling_n_per_v: -4.57e-3,
            capacitance_f: 4.3e-8,
            resistance_ohm,
        };
        let plant = Plant::new(problem.system(2.0, drive_hz)).unwrap();
        let voltage = plant.steady_output(&plant.voltage_row(0))[0];
        let exact = problem.voltage_per_newton(drive_hz) * c64::new(0.0, -2.0);
        assert!(
            (voltage - exact).norm() / exact.norm() < PiezoResistor::TOLERANCE,
            "{voltage:?} {exact:?}"
        );
        let power = jounce_model::linear::steady_power_w(&plant);
        assert!(
            (power / problem.mean_power_w(2.0, drive_hz) - 1.0).abs() < PiezoResistor::TOLERANCE
        );
        let resonant = Plant::new(problem.system(2.0, problem.frequency_rad_s / TAU)).unwrap();
        let best = jounce_model::linear::optimal_resistance(&resonant, 0).unwrap();
        let error = (best.resistance_ohm / problem.best_resistance_short_circuit_ohm() - 1.0).abs();
        assert!(error < 1e-9, "{error:e}");
    }
}

/// The period of all drives is the smallest common multiple of their periods.
#[test]
fn drives_have_their_least_common_period() {
    let period_s = |frequencies_hz: &[f64]| {
        let mut system = bench();
        let drive = system.drives[0].clone();
        system.drives = frequencies_hz
            .iter()
            .map(|f| jounce_model::plant::Drive {
                frequency_hz: *f,
                ..drive.clone()
            })
            .collect();
        Plant::new(system).unwrap().period_s()
    };
    let cases: [(&[f64], Option<f64>); 7] = [
        (&[20.0], Some(0.05)),
        (&[20.0, 60.0], Some(0.05)),
        (&[20.0, 30.0], Some(0.1)),
        (&[30.0, 20.0, 50.0], Some(0.1)),
        (&[42.0, 43.0], Some(1.0)),
        (&[12.5, 17.5, 30.0], Some(0.4)),
        (&[20.0, 20.0 * std::f64::consts::SQRT_2], None),
    ];
    for (frequencies_hz, expected_s) in cases {
        let found_s = period_s(frequencies_hz);
        let error = found_s
            .zip(expected_s)
            .map_or(0.0, |(value, expected)| (value / expected - 1.0).abs());
        assert!(
            found_s.is_some() == expected_s.is_some() && error < 1e-12,
            "{frequencies_hz:?}: {found_s:?}, not {expected_s:?}"
        );
    }
}
