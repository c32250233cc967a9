//! `examples/two-beams-vijayan-2015`: Vijayan, Friswell, Haddad Khodaparast and Adhikari, Int. J.
//! Mech. Sci. 96-97 (2015) 101.

use crate::example::{integrator, kernel, relative, run, set_velocity, system};
use crate::rows::check;
use jounce_analysis::run::{RunPlan, StartState, simulate};
use jounce_linalg::{Mat, c64};
use jounce_model::contact::{Cubic, Law};
use jounce_model::linear::steady_power_w;
use jounce_model::plant::System;
use std::f64::consts::{PI, TAU};

const EXAMPLE: &str = "two-beams-vijayan-2015";
const SPEC: &str = "harvester.toml";
const STIFFNESS_N_M: f64 = 5e4;

/// Twenty periods of the relative motion of two equal oscillators that touch: half of each apart at
/// 1 rad/s, half in contact at 10 rad/s. Measured: state 3e-11, time of contact 1e-8.
#[test]
fn two_oscillators_swing_at_the_bilinear_frequency() {
    let kernel = kernel(system(EXAMPLE, "bilinear.toml", &[]));
    let mut start = vec![0.0; 4];
    set_velocity(&kernel.plant.system, &mut start, "lower", 0.5);
    set_velocity(&kernel.plant.system, &mut start, "upper", -0.5);
    let mut integrator = integrator(&kernel, &start, 1e-11);
    let bilinear_rad_s = 2.0 * 1.0 * 10.0 / (1.0 + 10.0);
    integrator
        .advance_to(20.0 * TAU / bilinear_rad_s * (1.0 - 1e-12))
        .unwrap();
    let state = kernel
        .plant
        .to_physical(&integrator.state(), integrator.time_s());
    let error = start
        .iter()
        .zip(&state)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max);
    let statistics = integrator.statistics();
    eprintln!(
        "{error:.1e}, pressed for {:.1e} relative",
        relative(statistics.time_s, 20.0 * PI / 10.0)
    );
    assert!(
        error < 1e-8 && relative(statistics.time_s, 20.0 * PI / 10.0) < 1e-7,
        "{error:e}"
    );
}

/// The spec shows it: in contact for half a period of 10 rad/s, at any speed.
#[test]
fn the_spec_starts_as_the_oscillators_meet() {
    for settings in [vec![], vec![("mass.lower.velocity", "0.3 m/s")]] {
        let (_, result) = run(EXAMPLE, "bilinear.toml", &settings);
        let error = relative(result.stops[0].mean_contact_duration_s, PI / 10.0);
        eprintln!("{settings:?}: {error:.1e}");
        assert!(
            result.contacts == 3 && error < 1e-6,
            "{settings:?}: {} contacts, {error:e}",
            result.contacts
        );
    }
}

/// Equal beams on one base move equally; beams far apart are uncoupled: no contact, and the power
/// of linear theory.
#[test]
fn equal_beams_and_distant_beams_are_linear() {
    for settings in [
        [("beam.upper.thickness", "1 mm"), ("run.start", "linear")],
        [("stop.tips.gap", "1 m"), ("run.start", "linear")],
    ] {
        let (kernel, result) = run(EXAMPLE, SPEC, &settings);
        let error = relative(result.mean_power_w, steady_power_w(&kernel.plant));
        eprintln!("{settings:?}: {error:.1e}");
        assert!(
            result.contacts == 0 && error < 1e-9,
            "{settings:?}: {} contacts, {error:e}",
            result.contacts
        );
    }
}

/// Steady power of the harvester with a two-sided spring between the tips, from the complex
/// equations.
fn coupled_power_w(system: &System) -> f64 {
    let (modes, drive) = (&system.modes, &system.drives[0]);
    let n = modes.len();
    let w = TAU * drive.frequency_hz;
    let patches: Vec<_> = modes.patch.values().collect();
    let between = &system.stops[0].shape;
    let size = n + patches.len();
    let entry = |row: usize, column: usize| -> c64 {
        let is = |same: bool| f64::from(same);
        match (row < n, column < n) {
            (true, true) => {
                let mode_rad_s = modes.frequency_rad_s[row];
                let diagonal = c64::new(
                    mode_rad_s * mode_rad_s - w * w,
                    2.0 * modes.damping_ratio[row] * mode_rad_s * w,
                ) * is(row == column);
                diagonal + STIFFNESS_N_M * between[row] * between[column]
            }
            (true, false) => c64::new(-patches[column - n].coupling_n_per_v[row], 0.0),
            (false, true) => c64::new(0.0, w * patches[row - n].coupling_n_per_v[column]),
            (false, false) => {
                c64::new(
                    1.0 / system.loads[row - n].resistance_ohm,
                    w * patches[row - n].capacitance_f,
                ) * is(row == column)
            }
        }
    };
    let force = Mat::from_fn(size, 1, |row, _| {
        c64::new(
            if row < n {
                drive.shape[row] * drive.amplitude_n
            } else {
                0.0
            },
            0.0,
        )
    });
    let solution = jounce_linalg::complex_solve(&Mat::from_fn(size, size, entry), &force);
    (0..patches.len())
        .map(|k| 0.5 * solution[(n + k, 0)].norm_sqr() / system.loads[k].resistance_ohm)
        .sum()
}

/// A two-sided spring, integrated from rest to steady state, against the coupled linear equations.
/// Measured: 7e-12.
fn permanent_contact_w() -> [f64; 2] {
    let mut system = system(EXAMPLE, SPEC, &[("stop.tips.gap", "0 mm")]);
    system.stops[0].law = Law::Cubic(Cubic {
        stiffness_n_m: STIFFNESS_N_M,
        cubic_stiffness_n_m3: 0.0,
    });
    let exact_w = coupled_power_w(&system);
    let kernel = kernel(system);
    let plan = RunPlan {
        duration_s: 15.0,
        average_over_s: 5.0,
        tolerance: 1e-10,
        record_s: 0.0,
    };
    let result = simulate(&kernel, &StartState::rest(&kernel.plant), &plan).unwrap();
    [result.mean_power_w, exact_w]
}

#[test]
fn every_expected_row_is_met() {
    let [integrated_w, exact_w] = permanent_contact_w();
    eprintln!(
        "permanent contact: {integrated_w:e} W, {:.1e}",
        relative(integrated_w, exact_w)
    );
    assert!(relative(integrated_w, exact_w) < 1e-6);
    let (kernel, result) = run(EXAMPLE, SPEC, &[]);
    let residual = result.energies.residual_relative();
    eprintln!("residual {residual:.1e}, {} contacts", result.contacts);
    assert!(residual.abs() < 1e-8 && result.settlement.unwrap().settled);
    check(
        EXAMPLE,
        &[
            ("permanent_contact_w", integrated_w),
            ("linear_power_w", steady_power_w(&kernel.plant)),
            ("mean_power_w", result.mean_power_w),
        ],
    );
}
