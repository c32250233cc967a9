//! Derivative of the flow against differences of the flow, its determinant and the closed form of
//! the impact oscillator.

mod conduction_states;
mod gravity;
mod jacobian;
mod parameters;

use jounce_dynamics::{FlowSensitivity, Integrator, Kernel, ParameterSensitivity};
use jounce_model::contact::Law;
use jounce_model::plant::System;

/// A state after some contacts, and one drive period from there.
fn state_after_contacts(kernel: &Kernel) -> (Vec<f64>, f64) {
    let period_s = 1.0 / kernel.plant.system.drives[0].frequency_hz;
    let y = kernel
        .plant
        .from_physical(&vec![0.0; kernel.plant.len()], 0.0);
    let mut integrator = Integrator::new(kernel, &y, 0.0, 1e-11).unwrap();
    integrator.advance_to(30.0 * period_s).unwrap();
    (integrator.state(), period_s)
}

/// Start time of every check: any integer number of periods is equivalent to time 0.
const START_S: f64 = 0.0;

fn end_state(kernel: &Kernel, y: &[f64], duration_s: f64) -> Vec<f64> {
    let mut integrator = Integrator::new(kernel, y, START_S, 1e-13).unwrap();
    integrator.advance_to(START_S + duration_s).unwrap();
    integrator.state()
}

fn with_law(mut system: System, law: Law) -> System {
    system.stops[0].law = law;
    system
}

/// Error of the Jacobian on any interval.
fn against_differences(
    kernel: &Kernel,
    y: &[f64],
    duration_s: f64,
    sensitivity: &FlowSensitivity,
) -> f64 {
    let size = y.iter().fold(0.0_f64, |max, v| max.max(v.abs()));
    let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
    for j in 0..y.len() {
        let step = 1e-5 * size;
        let perturbed = |sign: f64| {
            let mut y = y.to_vec();
            y[j] += sign * step;
            end_state(kernel, &y, duration_s)
        };
        let (plus, minus) = (perturbed(1.0), perturbed(-1.0));
        for i in 0..y.len() {
            let difference = (plus[i] - minus[i]) / (2.0 * step);
            worst = worst.max((difference - sensitivity.jacobian[(i, j)]).abs());
            largest = largest.max(difference.abs());
        }
    }
    worst / largest
}

/// Largest error of the Jacobian against central differences, relative to its largest entry, on an
/// interval with contacts.
fn jacobian_error(kernel: &Kernel, y: &[f64], duration_s: f64) -> f64 {
    let sensitivity = FlowSensitivity::integrate(
        kernel,
        y,
        START_S,
        duration_s,
        1e-12,
        &ParameterSensitivity::default(),
    )
    .unwrap();
    assert!(
        sensitivity.statistics.contacts > 0 || sensitivity.statistics.time_s > 0.0,
        "the check needs a contact"
    );
    against_differences(kernel, y, duration_s, &sensitivity)
}
