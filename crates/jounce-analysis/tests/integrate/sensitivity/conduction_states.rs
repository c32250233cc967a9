//! Derivative of the flow through diodes and switches, against differences of the flow and its
//! determinant.

use super::{against_differences, state_after_contacts};
use crate::circuits::cell::{cell, lossy_with_stop};
use crate::plants::kernel;
use jounce_dynamics::{FlowSensitivity, Integrator, Kernel, ParameterSensitivity};
use jounce_model::contact::{KelvinVoigt, Law, Rigid};
use jounce_model::plant::{RectifierScheme, Storage, System};

const SCHEMES: [RectifierScheme; 4] = [
    RectifierScheme::Standard,
    RectifierScheme::ParallelSshi { inversion: 0.6 },
    RectifierScheme::SeriesSshi { inversion: 0.6 },
    RectifierScheme::Extraction { efficiency: 0.9 },
];

const CAPACITOR: Storage = Storage::Capacitor {
    capacitance_f: 5.0,
    load_ohm: 3.0,
};

/// Error of the derivative over a period, relative to its largest entry; error of the rate; numbers
/// of changes and contacts.
fn sensitivity_errors(kernel: &Kernel) -> (f64, f64, usize, u64) {
    let (y, period_s) = state_after_contacts(kernel);
    let sensitivity = FlowSensitivity::integrate(
        kernel,
        &y,
        0.0,
        period_s,
        1e-12,
        &ParameterSensitivity::default(),
    )
    .unwrap();
    let error = against_differences(kernel, &y, period_s, &sensitivity);
    let later = |by: f64| {
        let mut integrator = Integrator::new(kernel, &y, 0.0, 1e-13).unwrap();
        integrator.advance_to(period_s * (1.0 + by)).unwrap();
        integrator.state()
    };
    let (early, late) = (later(-1e-6), later(1e-6));
    let size = sensitivity
        .rate
        .iter()
        .fold(0.0_f64, |max, v| max.max(v.abs()));
    let off =
        |i: usize| ((late[i] - early[i]) / (2e-6 * period_s) - sensitivity.rate[i]).abs() / size;
    let rate = (0..y.len()).map(off).fold(0.0, f64::max);
    (
        error,
        rate,
        sensitivity.trajectory.changes().len(),
        sensitivity.statistics.contacts,
    )
}

fn without_stop(scheme: RectifierScheme, storage: Storage) -> System {
    let mut system = lossy_with_stop(scheme, storage);
    system.stops.clear();
    system
}

#[test]
fn diodes_and_switches() {
    for scheme in SCHEMES {
        for storage in [CAPACITOR, Storage::Battery { voltage_v: 0.4 }] {
            let (error, rate, changes, _) =
                sensitivity_errors(&kernel(without_stop(scheme, storage)));
            eprintln!("{scheme:?}, {storage:?}: {error:.1e}, rate {rate:.1e}, {changes} changes");
            assert!(
                error < 1e-6 && rate < 1e-6 && changes >= 2,
                "{scheme:?}: {error:e} {rate:e}"
            );
        }
    }
}

/// A voltage inverted beyond that of the storage: the diodes conduct at the instant of the switch,
/// and their current jumps.
#[test]
fn diodes_that_conduct_at_once_after_a_switch() {
    let mut system = without_stop(RectifierScheme::ParallelSshi { inversion: 0.9 }, CAPACITOR);
    system.bridges[0].diode_ohm = 1.0;
    let kernel = kernel(system);
    let (error, rate, changes, _) = sensitivity_errors(&kernel);
    let (y, period_s) = state_after_contacts(&kernel);
    let sensitivity = FlowSensitivity::integrate(
        &kernel,
        &y,
        0.0,
        period_s,
        1e-12,
        &ParameterSensitivity::default(),
    )
    .unwrap();
    let at_once = sensitivity
        .trajectory
        .changes()
        .windows(2)
        .filter(|pair| pair[0].flipped.is_some() && pair[0].after == pair[1].after)
        .count();
    eprintln!("{error:.1e}, rate {rate:.1e}, {changes} changes, {at_once} at once");
    assert!(
        error < 1e-6 && rate < 1e-6 && at_once > 0,
        "{error:e} {rate:e}"
    );
}

/// Diodes that change and switches that close while the point is in contact or in flight.
#[test]
fn diodes_and_switches_next_to_a_stop() {
    let yielding = Law::KelvinVoigt(KelvinVoigt {
        stiffness_n_m: 40.0,
        damping_n_s_m: 0.8,
    });
    for scheme in SCHEMES {
        let hertz = lossy_with_stop(scheme, CAPACITOR);
        let mut yields = hertz.clone();
        yields.stops[0].law = yielding;
        for system in [hertz, yields] {
            let law = system.stops[0].law;
            let (error, rate, changes, contacts) = sensitivity_errors(&kernel(system));
            eprintln!(
                "{scheme:?}, {law:?}: {error:.1e}, rate {rate:.1e}, {changes} changes, {contacts} contacts"
            );
            assert!(
                error < 1e-5 && rate < 1e-5 && changes >= 2 && contacts > 0,
                "{scheme:?}: {error:e} {rate:e}"
            );
        }
    }
}

/// An impact on a rigid stop reverses the current of the patch, and the switch closes at that
/// instant.
#[test]
fn a_switch_closed_by_an_impact() {
    for scheme in SCHEMES {
        let mut system = lossy_with_stop(scheme, CAPACITOR);
        system.stops[0].law = Law::Rigid(Rigid { restitution: 0.7 });
        let (error, rate, changes, contacts) = sensitivity_errors(&kernel(system));
        eprintln!(
            "{scheme:?}: {error:.1e}, rate {rate:.1e}, {changes} changes, {contacts} contacts"
        );
        assert!(
            error < 1e-5 && rate < 1e-5 && changes >= 2 && contacts > 0,
            "{scheme:?}: {error:e} {rate:e}"
        );
    }
}

/// In a lossless cell with parallel SSHI on a battery that is never reached, only the switch
/// contracts volume: by `-q` for the voltage, times the ratio of the accelerations after and before
/// it.
#[test]
fn determinant_of_a_switch() {
    let (theta, inversion) = (0.4, 0.6);
    let kernel = kernel(cell(
        theta,
        0.0,
        0.8,
        RectifierScheme::ParallelSshi { inversion },
        Storage::Battery { voltage_v: 1e3 },
    ));
    let y = kernel.plant.from_physical(&[0.3, 0.2, -0.1], 0.0);
    let sensitivity = FlowSensitivity::integrate(
        &kernel,
        &y,
        0.0,
        12.0,
        1e-12,
        &ParameterSensitivity::default(),
    )
    .unwrap();
    let mut expected = 1.0;
    for change in sensitivity.trajectory.changes() {
        let (q, voltage) = (change.state[0], change.state[2]);
        let acceleration = |voltage: f64| (0.8 * change.time_s + 0.4).sin() - q + theta * voltage;
        expected *= -inversion * acceleration(-inversion * voltage) / acceleration(voltage);
    }
    let error = jounce_linalg::determinant(&sensitivity.jacobian) / expected - 1.0;
    eprintln!(
        "{} switches: {expected:.4} {error:.1e}",
        sensitivity.trajectory.changes().len()
    );
    assert!(sensitivity.trajectory.changes().len() > 2 && error.abs() < 1e-9);
}
