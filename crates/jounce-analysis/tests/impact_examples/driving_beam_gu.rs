//! `examples/driving-beam-gu-2011`: Gu and Livermore, Smart Mater. Struct. 20 (2011) 045004.

use crate::example::{integrator, kernel, motion, relative, run, set_velocity, system};
use crate::rows::check;
use jounce_dynamics::{Integrator, Kernel};
use std::f64::consts::{PI, TAU};

const EXAMPLE: &str = "driving-beam-gu-2011";
const SPEC: &str = "coupled.toml";
/// Masses, kg, and stiffnesses, N/m, of the driving and the generating oscillator.
const MASS_KG: [f64; 2] = [2e-3, 0.2e-3];
const STIFFNESS_N_M: [f64; 2] = [30.0, 2000.0];
const SPEED_M_S: f64 = 0.1;

/// `w = sqrt((k1 + k2) / (m1 + m2))` of both in contact, rad/s.
fn coupled_rad_s() -> f64 {
    (STIFFNESS_N_M.iter().sum::<f64>() / MASS_KG.iter().sum::<f64>()).sqrt()
}

/// `zeta = (c1 + c2) / (2 sqrt((k1 + k2) (m1 + m2)))` of both in contact.
fn coupled_damping(uncoupled_rad_s: [f64; 2]) -> f64 {
    let damping: f64 = (0..2)
        .map(|i| 2.0 * uncoupled_rad_s[i] * (STIFFNESS_N_M[i] * MASS_KG[i]).sqrt())
        .sum();
    damping / (2.0 * (STIFFNESS_N_M.iter().sum::<f64>() * MASS_KG.iter().sum::<f64>()).sqrt())
}

fn oscillators(damping: [f64; 2]) -> Kernel {
    let [driving, generating] = damping.map(|ratio| format!("{ratio}"));
    kernel(system(
        EXAMPLE,
        SPEC,
        &[
            ("mass.driving.damping_ratio", &driving),
            ("mass.generating.damping_ratio", &generating),
        ],
    ))
}

/// State where the driving mass has just come into contact at 0.1 m/s.
fn at_contact(kernel: &Kernel) -> Integrator<'_> {
    let mut start = vec![0.0; kernel.plant.len()];
    set_velocity(&kernel.plant.system, &mut start, "driving", SPEED_M_S);
    integrator(kernel, &start, 1e-11)
}

/// In contact they move as one oscillator, with its frequency and its damping. Measured: 1e-15.
#[test]
fn in_contact_the_beams_are_one_oscillator() {
    let damping = [0.02, 0.01];
    let kernel = oscillators(damping);
    let mut integrator = at_contact(&kernel);
    let (w, zeta) = (coupled_rad_s(), coupled_damping(damping));
    let swing = w * (1.0 - zeta * zeta).sqrt();
    let common = SPEED_M_S * MASS_KG[0] / MASS_KG.iter().sum::<f64>();
    for step in 1..=9 {
        let time_s = 0.1 * f64::from(step) * PI / w;
        integrator.advance_to(time_s).unwrap();
        let exact_m = common / swing * (-zeta * w * time_s).exp() * (swing * time_s).sin();
        let error = ["driving", "generating"]
            .map(|point| (motion(&integrator, &kernel, point)[0] - exact_m).abs() * w / common);
        eprintln!("after {step} tenths of the contact: {error:?}");
        assert!(error.iter().all(|error| *error < 1e-9), "{error:?}");
    }
}

/// Without damping they separate after half a period, where both springs are relaxed: duration and
/// energy lost in the merge.
fn contact() -> [f64; 2] {
    let kernel = oscillators([0.0, 0.0]);
    let mut integrator = at_contact(&kernel);
    integrator.advance_to(1.02 * PI / coupled_rad_s()).unwrap();
    let statistics = integrator.statistics();
    [statistics.sticking_s, integrator.energies().contact_loss_j]
}

/// The spec shows the impact: one contact of half a coupled period, and the loss of the merge.
/// Measured without damping: 1e-7 (time), 4e-16 (loss).
#[test]
fn the_spec_starts_with_the_strike() {
    let (_, result) = run(EXAMPLE, SPEC, &[]);
    let loss_j = 0.5 * MASS_KG[0] * MASS_KG[1] / MASS_KG.iter().sum::<f64>() * SPEED_M_S.powi(2);
    assert!(
        result.contacts == 1 && relative(result.energies.contact_loss_j, loss_j) < 1e-9,
        "{result:?}"
    );
    let free = [
        ("mass.driving.damping_ratio", "0"),
        ("mass.generating.damping_ratio", "0"),
        ("run.tolerance", "1e-11"),
    ];
    let (_, result) = run(EXAMPLE, SPEC, &free);
    let error = relative(
        result.stops[0].mean_contact_duration_s,
        PI / coupled_rad_s(),
    );
    eprintln!(
        "dwell {error:.1e}, loss {:.1e}",
        relative(result.energies.contact_loss_j, loss_j)
    );
    assert!(
        result.contacts == 1 && error < 1e-6,
        "{} contacts, {error:e}",
        result.contacts
    );
}

#[test]
fn every_expected_row_is_met() {
    let [duration_s, loss_j] = contact();
    let reduced_kg = MASS_KG[0] * MASS_KG[1] / MASS_KG.iter().sum::<f64>();
    assert!(
        relative(duration_s, PI / coupled_rad_s()) < 1e-6
            && relative(loss_j, 0.5 * reduced_kg * SPEED_M_S.powi(2)) < 1e-9
    );
    let (_, result) = run(EXAMPLE, "harvester.toml", &[]);
    let residual = result.energies.residual_relative();
    eprintln!(
        "{:.3e} W, residual {residual:.1e}, {} contacts",
        result.mean_power_w, result.contacts
    );
    assert!(residual.abs() < 1e-8 && result.stops.iter().all(|stop| stop.contacts > 10));
    check(
        EXAMPLE,
        &[
            ("coupled_hz", PI / duration_s / TAU),
            ("contact_s", duration_s),
            ("merge_loss_j", loss_j),
            ("mean_power_w", result.mean_power_w),
        ],
    );
}
