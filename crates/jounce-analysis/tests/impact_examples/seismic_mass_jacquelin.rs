//! `examples/seismic-mass-jacquelin-2011`: Jacquelin, Adhikari and Friswell, Smart Mater. Struct.
//! 20 (2011) 105008.

use crate::example::{integrator, kernel, motion, relative, run, set_velocity, system};
use crate::reduced_basis::{fixed_contact, free_interface};
use crate::rows::check;
use jounce_dynamics::Kernel;
use jounce_model::contact::{Hertz, Law};
use jounce_model::plant::System;
use jounce_model::reference::HertzCollision;
use std::sync::Arc;

const EXAMPLE: &str = "seismic-mass-jacquelin-2011";
const SPEC: &str = "harvester.toml";
const SEISMIC_KG: f64 = 50e-3;

/// The seismic mass, released from its spring, before the upper beam with `modes` modes, without
/// damping.
fn without_lower_beam(modes: usize, settings: &[(&str, &str)]) -> System {
    let modes_text = format!("{}", 2 * modes + 1);
    let settings: Vec<(&str, &str)> = [
        ("reduction.modes", modes_text.as_str()),
        ("damping.beyond", "0"),
    ]
    .into_iter()
    .chain(settings.iter().copied())
    .collect();
    let mut system = system(EXAMPLE, SPEC, &settings);
    let names = |part: &str| part.starts_with("lower");
    system.drives.clear();
    system.stops.retain(|stop| !names(&stop.name));
    system.loads.retain(|load| !names(&load.name));
    // The remaining parts: the free mass and the upper beam.
    let seismic = system.modes.shape["seismic"]
        .iter()
        .position(|s| *s != 0.0)
        .unwrap();
    let upper = (0..system.modes.len()).filter(|i| system.modes.shape["upper.end"][*i] != 0.0);
    let order: Vec<usize> = std::iter::once(seismic).chain(upper.take(modes)).collect();
    let pick = |row: &mut Vec<f64>| *row = order.iter().map(|i| row[*i]).collect();
    let modal = Arc::make_mut(&mut system.modes);
    modal.frequency_rad_s[seismic] = 0.0;
    modal.patch.retain(|name, _| !names(name));
    modal.shape.retain(|name, _| !names(name));
    [
        &mut modal.frequency_rad_s,
        &mut modal.participation_sqrt_kg,
        &mut modal.discretisation_error,
    ]
    .into_iter()
    .for_each(pick);
    modal.shape.values_mut().for_each(pick);
    modal.patch.values_mut().for_each(|patch| {
        pick(&mut patch.coupling_n_per_v);
        patch.strain.clear();
    });
    modal.damping_ratio = vec![0.0; order.len()];
    system.stops.iter_mut().for_each(|stop| {
        pick(&mut stop.shape);
        stop.gap_m = 0.0;
    });
    system
}

/// Contact force, N, at 4000 times over the first 8 ms after the mass arrives at 0.1 m/s, and its
/// final speed.
fn force_n(system: System) -> (Vec<f64>, f64) {
    let kernel = kernel(system);
    let mut start = vec![0.0; kernel.plant.len()];
    set_velocity(&kernel.plant.system, &mut start, "seismic", 0.1);
    let mut integrator = integrator(&kernel, &start, 1e-11);
    integrator.start_record();
    integrator.advance_to(8e-3).unwrap();
    let speed = motion(&integrator, &kernel, "seismic")[1];
    let times: Vec<f64> = (0..4000).map(|k| 2e-6 * f64::from(k)).collect();
    (
        integrator
            .take_record()
            .at(&kernel, &times)
            .iter()
            .map(|at| at.forces_n[0])
            .collect(),
        speed,
    )
}

fn distance(one: &[f64], other: &[f64]) -> f64 {
    let norm = |values: &mut dyn Iterator<Item = f64>| values.map(|x| x * x).sum::<f64>().sqrt();
    norm(&mut one.iter().zip(other).map(|(a, b)| a - b)) / norm(&mut other.iter().copied())
}

/// The two bases of the model give equal results when complete, and the one with the static shape
/// needs fewer coordinates. A soft contact (1e6 N/m^1.5) makes the comparison depend on the bases
/// and not on the number of bounces. Measured: complete bases differ by 1.3e-7, the roundoff of the
/// two eigenproblems amplified by the contact.
#[test]
fn free_interface_and_fixed_contact_bases_are_equivalent() {
    let many = 40;
    let mut system = without_lower_beam(many, &[]);
    system.stops[0].law = Law::Hertz(Hertz {
        stiffness: 1e6,
        exponent: 1.5,
    });
    let (exact, speed) = force_n(free_interface(&system, many));
    let (other, other_speed) = force_n(fixed_contact(&system, many));
    let complete = distance(&other, &exact);
    eprintln!(
        "complete: {complete:.1e}, speed {speed} {:.1e}",
        relative(other_speed, speed)
    );
    assert!(
        complete < 1e-6 && exact.iter().any(|force| *force > 0.1),
        "{complete:e}"
    );
    let mut before = [f64::INFINITY; 2];
    for coordinates in [2, 4, 8] {
        let errors = [
            free_interface(&system, coordinates),
            fixed_contact(&system, coordinates),
        ]
        .map(|reduced| distance(&force_n(reduced).0, &exact));
        eprintln!(
            "{coordinates} coordinates: free interface {:.2e}, fixed contact {:.2e}",
            errors[0], errors[1]
        );
        assert!(
            errors[1] < errors[0] && errors[0] < before[0] && errors[1] < before[1],
            "{errors:?}"
        );
        before = errors;
    }
}

/// Hertz's stiffness, N/m^1.5, of a steel sphere (200 GPa, 0.29) of 5 mm radius on brass (110 GPa,
/// 0.35): `(4/3) E* sqrt(R)`.
fn hertz_stiffness() -> f64 {
    let modulus_pa = ((1.0 - 0.29 * 0.29) / 200e9 + (1.0 - 0.35 * 0.35) / 110e9_f64).recip();
    4.0 / 3.0 * modulus_pa * 5e-3_f64.sqrt()
}

/// With increasing stiffness and mass of the beam, the collision approaches that of Hertz with a
/// fixed body: peak force and duration. Measured: 2e-2, 2e-4, 2e-6 and 8e-3, 8e-5, 7e-7.
fn hertz_errors(times: f64) -> [f64; 2] {
    let (modulus, density) = (
        format!("{} GPa", 110.0 * times),
        format!("{} kg/m^3", 8530.0 * times),
    );
    let system = without_lower_beam(
        4,
        &[
            ("beam.upper.youngs_modulus", &modulus),
            ("beam.upper.density", &density),
        ],
    );
    let problem = HertzCollision {
        mass_kg: SEISMIC_KG,
        speed_m_s: 0.1,
        stiffness: hertz_stiffness(),
        exponent: 1.5,
    };
    let kernel = kernel(system);
    let mut start = vec![0.0; kernel.plant.len()];
    set_velocity(&kernel.plant.system, &mut start, "seismic", 0.1);
    let mut integrator = integrator(&kernel, &start, 1e-12);
    integrator
        .advance_to(3.0 * problem.contact_time_s())
        .unwrap();
    let statistics = integrator.statistics();
    assert_eq!(statistics.contacts, 1);
    [
        relative(statistics.max_force_n, problem.peak_force_n()),
        relative(statistics.time_s, problem.contact_time_s()),
    ]
}

#[test]
fn a_heavy_beam_is_the_fixed_body_of_hertz() {
    let errors = [1e4, 1e6, 1e8].map(hertz_errors);
    eprintln!("peak force and duration: {errors:?}");
    for pair in errors.windows(2) {
        assert!(
            pair[1][0] < 0.02 * pair[0][0] && pair[1][1] < 0.02 * pair[0][1],
            "{errors:?}"
        );
    }
    assert!(errors[2].iter().all(|error| *error < 1e-5), "{errors:?}");
}

/// Largest power of all loads between two times of a run with a record, W.
fn peak_power_w(
    kernel: &Kernel,
    result: &jounce_analysis::run::RunResult,
    from_s: f64,
    to_s: f64,
) -> f64 {
    let plant = &kernel.plant;
    let times: Vec<f64> = (0..20_000)
        .map(|k| from_s + (to_s - from_s) * f64::from(k) / 2e4)
        .collect();
    let power = |at: jounce_dynamics::TrajectoryState| -> f64 {
        let voltages = plant.patch_voltages_v(&plant.to_physical(&at.state, at.time_s));
        let of_patch = |name: &str| {
            voltages[plant
                .system
                .modes
                .patch
                .keys()
                .position(|patch| patch == name)
                .unwrap()]
        };
        plant
            .system
            .loads
            .iter()
            .map(|load| of_patch(&load.connections[0].patch).powi(2) / load.resistance_ohm)
            .sum()
    };
    result
        .trajectory
        .at(kernel, &times)
        .into_iter()
        .map(power)
        .fold(0.0, f64::max)
}

#[test]
fn every_expected_row_is_met() {
    let (kernel, result) = run(EXAMPLE, SPEC, &[]);
    let residual = result.energies.residual_relative();
    let [transient_w, steady_w] =
        [[0.0, 1.0], [9.0, 10.0]].map(|[from, to]| peak_power_w(&kernel, &result, from, to));
    eprintln!(
        "residual {residual:.1e}; peak power {transient_w:.3e} W at first, {steady_w:.3e} W at last"
    );
    assert!(residual.abs() < 1e-8, "{residual:e}");
    assert!(transient_w > steady_w);
    let gaps_mm = [0.1, 1.0, 2.5, 4.0];
    let powers = gaps_mm.map(|gap| {
        let gap = format!("{gap} mm");
        let settings = [
            ("stop.upper.gap", gap.as_str()),
            ("stop.lower.gap", &gap),
            ("run.duration", "6 s"),
            ("run.average_over", "2 s"),
        ];
        run(EXAMPLE, SPEC, &settings).1.mean_power_w
    });
    eprintln!("power over the gap: {powers:?}");
    let best = (0..powers.len())
        .max_by(|a, b| powers[*a].total_cmp(&powers[*b]))
        .unwrap();
    assert!(best > 0 && best + 1 < powers.len(), "{powers:?}");
    let [force, duration] = hertz_errors(1e8);
    check(
        EXAMPLE,
        &[
            ("hertz_force_ratio", 1.0 + force),
            ("hertz_duration_ratio", 1.0 + duration),
            ("mean_power_w", result.mean_power_w),
        ],
    );
}
