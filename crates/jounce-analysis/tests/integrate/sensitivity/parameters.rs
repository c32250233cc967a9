//! Derivatives by gap, stiffness and drive.

use super::{START_S, end_state, state_after_contacts};
use crate::plants::{bench, kernel};
use jounce_dynamics::{FlowSensitivity, Kernel, ParameterSensitivity};
use jounce_model::contact::{Hertz, Law};
use jounce_model::plant::System;

/// A parameter, its change, the step of the difference, and its derivative in closed form.
type Case = (
    &'static str,
    fn(&mut System, f64),
    f64,
    ParameterSensitivity,
);

fn cases(base: &System, at: &Kernel) -> [Case; 4] {
    let w = at.plant.tones[0].angular_frequency_rad_s;
    let steady = at.plant.ports[0].steady_m[0];
    let with_drive = |step: f64| {
        let mut drives = base.drives.clone();
        drives[0].frequency_hz += step;
        at.plant.with_drives(drives).unwrap().ports[0].steady_m[0]
    };
    let by_frequency = (with_drive(1e-6) - with_drive(-1e-6)) / 2e-6;
    [
        (
            "gap",
            |system, d| system.stops[0].gap_m += d,
            1e-8,
            ParameterSensitivity {
                gap_m: vec![1.0],
                ..ParameterSensitivity::default()
            },
        ),
        (
            "stiffness",
            |system, d| {
                system.stops[0].law = Law::Hertz(Hertz {
                    stiffness: 1000.0 + d,
                    exponent: 1.5,
                })
            },
            1e-2,
            ParameterSensitivity {
                force_relative: vec![1e-3],
                ..ParameterSensitivity::default()
            },
        ),
        (
            "amplitude",
            |system, d| system.drives[0].amplitude_n += d,
            1e-3,
            ParameterSensitivity {
                tones: vec![(vec![steady / 50.0], 0.0)],
                ..ParameterSensitivity::default()
            },
        ),
        (
            "frequency",
            |system, d| system.drives[0].frequency_hz += d,
            1e-6,
            ParameterSensitivity {
                tones: vec![(vec![by_frequency], w / 11.0)],
                ..ParameterSensitivity::default()
            },
        ),
    ]
}

/// Central difference of flows of modified systems.
fn difference_of_flows(
    base: &System,
    y: &[f64],
    duration_s: f64,
    change: fn(&mut System, f64),
    step: f64,
) -> Vec<f64> {
    let perturbed = |sign: f64| {
        let mut system = base.clone();
        change(&mut system, sign * step);
        end_state(&kernel(system), y, duration_s)
    };
    perturbed(1.0)
        .iter()
        .zip(perturbed(-1.0))
        .map(|(plus, minus)| (plus - minus) / (2.0 * step))
        .collect()
}

/// Derivatives by gap, stiffness and drive, against differences of flows of modified systems.
#[test]
fn drift_is_the_difference_of_flows_of_changed_systems() {
    let base = bench(50.0, 11.0);
    let at = kernel(base.clone());
    let (y, period_s) = state_after_contacts(&at);
    for (name, change, step, drift) in cases(&base, &at) {
        let expected = difference_of_flows(&base, &y, period_s, change, step);
        let sensitivity = FlowSensitivity::integrate(&at, &y, START_S, period_s, 1e-12, &drift)
            .unwrap()
            .drift;
        let size = expected.iter().fold(0.0_f64, |max, v| max.max(v.abs()));
        let jacobian_error = expected
            .iter()
            .zip(&sensitivity)
            .fold(0.0_f64, |max, (a, b)| max.max((a - b).abs()))
            / size;
        eprintln!("{name}: {jacobian_error:.1e}");
        assert!(jacobian_error < 1e-5, "{name}: {jacobian_error:e}");
    }
}
