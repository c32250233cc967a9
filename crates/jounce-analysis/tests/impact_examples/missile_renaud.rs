//! `examples/missile-renaud-2009`: Renaud, Fiorini, van Schaijk and van Hoof, Smart Mater. Struct.
//! 18 (2009) 035001.

use crate::example::{integrator, kernel, motion, own_mode, relative, run, set_velocity, system};
use crate::rows::check;
use jounce_analysis::run::StartState;
use jounce_model::plant::System;
use jounce_model::reference::Impulse;

const EXAMPLE: &str = "missile-renaud-2009";
const GAP_M: f64 = 12.5e-3;
const RESTITUTION: f64 = 0.7;
const G_M_S2: f64 = 9.81;

fn without_drive(settings: &[(&str, &str)]) -> System {
    let mut system = system(EXAMPLE, "harvester.toml", settings);
    system.drives.clear();
    system
}

/// Mass that moves with the tip of the right beam, kg.
fn beam_kg(system: &System) -> f64 {
    system.modes.shape["right.end"][own_mode(system, "right.end")].powi(-2)
}

/// Newton's impact of a missile of 4 g on a beam at rest: both velocities, impulse, loss.
#[test]
fn one_impact_is_newtons() {
    let system = without_drive(&[]);
    let (m, beam, e, speed) = (4e-3, beam_kg(&system), RESTITUTION, 0.8);
    let kernel = kernel(system);
    let mut start = vec![0.0; kernel.plant.len()];
    set_velocity(&kernel.plant.system, &mut start, "missile", speed);
    let mut integrator = integrator(&kernel, &start, 1e-10);
    integrator.advance_to(GAP_M / speed + 1e-12).unwrap();
    let [after, tip] = ["missile", "right.end"].map(|point| motion(&integrator, &kernel, point)[1]);
    let reduced = m * beam / (m + beam);
    let statistics = integrator.statistics_by_stop()[1];
    let errors = [
        relative(after, (m - e * beam) / (m + beam) * speed),
        relative(tip, (1.0 + e) * m / (m + beam) * speed),
        relative(m * after + beam * tip, m * speed),
        relative(statistics.impulse_n_s, (1.0 + e) * reduced * speed),
        relative(
            integrator.energies().contact_loss_j,
            0.5 * reduced * (1.0 - e * e) * speed * speed,
        ),
    ];
    eprintln!(
        "beam of {:.3} g: velocities, momentum, impulse, loss {errors:?}",
        1e3 * beam
    );
    assert_eq!(statistics.contacts, 1);
    assert!(errors.iter().all(|error| *error < 1e-9), "{errors:?}");
}

/// A light missile strikes once and departs: the energy of the beam and its fraction in the load.
/// The missile is 40 mg and the other beam far away.
fn isolated_impact() -> [f64; 2] {
    let system = without_drive(&[("mass.missile.mass", "40 mg"), ("stop.left.gap", "10 m")]);
    let (m, beam, speed, mode) = (40e-6, beam_kg(&system), 0.8, own_mode(&system, "right.end"));
    let (modes, load) = (&system.modes, &system.loads[1]);
    let frequency_rad_s = modes.frequency_rad_s[mode];
    let coupling: f64 = load
        .connections
        .iter()
        .map(|connection| connection.sign * modes.patch[&connection.patch].coupling_n_per_v[mode])
        .sum();
    let capacitance_f: f64 = load
        .connections
        .iter()
        .map(|connection| modes.patch[&connection.patch].capacitance_f)
        .sum();
    let blow = Impulse {
        alpha: frequency_rad_s * capacitance_f * load.resistance_ohm,
        coupling_squared: coupling.powi(2) / (frequency_rad_s.powi(2) * capacitance_f),
        damping_ratio: modes.damping_ratio[mode],
    };
    let kernel = kernel(system);
    let mut start = vec![0.0; kernel.plant.len()];
    set_velocity(&kernel.plant.system, &mut start, "missile", speed);
    let mut integrator = integrator(&kernel, &start, 1e-10);
    integrator.advance_to(0.3).unwrap();
    assert_eq!(integrator.statistics().contacts, 1);
    let tip_m_s = (1.0 + RESTITUTION) * m / (m + beam) * speed;
    let exact_j = blow.efficiency() * 0.5 * beam * tip_m_s * tip_m_s;
    let found_j = integrator.energies().loads_j[1];
    eprintln!(
        "{blow:?}: {found_j:e} J, {:.1e}",
        relative(found_j, exact_j)
    );
    [found_j, exact_j]
}

/// Under gravity along the channel: time of flight and impact speed, from 12 mm before the middle.
#[test]
fn a_fall_through_the_channel_takes_its_time() {
    let mut system = without_drive(&[]);
    let participation: Vec<f64> = system.modes.participation_sqrt_kg.clone();
    let wave = jounce_model::drive::Wave::Constant(G_M_S2);
    system.signals.push(jounce_model::plant::Signal {
        name: "gravity".to_owned(),
        shape: participation,
        wave,
        base: None,
        drawn_from: None,
    });
    let kernel = kernel(system);
    let mut start = StartState::linear(&kernel.plant);
    let missile = own_mode(&kernel.plant.system, "missile");
    start.displacement[missile] = -12e-3 / kernel.plant.system.modes.shape["missile"][missile];
    let mut integrator = integrator(&kernel, &start.physical(), 1e-10);
    let fall_m = 12e-3 + GAP_M + motion(&integrator, &kernel, "right.end")[0];
    let impact_s = (2.0 * fall_m / G_M_S2).sqrt();
    integrator.advance_to(impact_s * (1.0 - 1e-9)).unwrap();
    assert_eq!(integrator.statistics().contacts, 0);
    integrator.advance_to(impact_s * (1.0 + 1e-9)).unwrap();
    let statistics = integrator.statistics_by_stop()[1];
    let error = relative(
        statistics.max_impact_velocity_m_s,
        (2.0 * G_M_S2 * fall_m).sqrt(),
    );
    eprintln!("strikes after {impact_s} s with {error:.1e}");
    assert!(statistics.contacts >= 1 && error < 1e-9, "{error:e}");
}

#[test]
fn every_expected_row_is_met() {
    let [harvested_j, exact_j] = isolated_impact();
    assert!(relative(harvested_j, exact_j) < 1e-6);
    // Means over 4 s of this irregular motion scatter by several percent.
    let longer = [("run.duration", "20 s"), ("run.average_over", "19 s")];
    let (_, shaking) = run(EXAMPLE, "harvester.toml", &longer);
    let (_, turning) = run(EXAMPLE, "turning.toml", &[]);
    for result in [&shaking, &turning] {
        let residual = result.energies.residual_relative();
        eprintln!(
            "{:.3e} W, residual {residual:.1e}, {} contacts",
            result.mean_power_w, result.contacts
        );
        assert!(residual.abs() < 1e-5 && result.stops.iter().all(|stop| stop.contacts > 10));
    }
    // The energy per turn is at most the weight of the missile times the length of the channel.
    assert!(turning.mean_power_w < 4e-3 * 9.80665 * 2.0 * GAP_M * 1.0);
    check(
        EXAMPLE,
        &[
            ("isolated_impact_j", harvested_j),
            ("turning_power_w", turning.mean_power_w),
            ("shaken_power_w", shaking.mean_power_w),
        ],
    );
}
