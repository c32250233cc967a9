//! Under gravity: constant forces on modes and on a free body.

use super::{START_S, end_state, jacobian_error, state_after_contacts, with_law};
use crate::plants::{bench, kernel};
use jounce_analysis::Model;
use jounce_dynamics::{FlowSensitivity, Kernel, ParameterSensitivity};
use jounce_model::contact::{Hertz, HuntCrossley, KelvinVoigt, Law};
use jounce_model::drive::Wave;
use jounce_model::plant::Signal;
use jounce_spec::Spec;

/// A ball that falls under gravity on a shaken table, compliant or rigid.
fn ball(stop: &str) -> Kernel {
    let text = format!(
        "[mass.ball]\non = \"nothing\"\nmass = \"0.5 kg\"\n[stop.t]\nat = \"ball\"\nside = \"negative\"\ngap = \"0 mm\"\n{stop}\n\
         [gravity]\nacceleration = \"-9.81 m/s^2\"\n[drive.b]\nkind = \"base-acceleration\"\namplitude = \"13 m/s^2\"\nfrequency = \"5 Hz\"\nphase = \"0.4 rad\"\n"
    );
    Model::new(Spec::from_toml(&text).unwrap()).unwrap().kernel
}

/// The bench plant with a contact law, under a constant force.
fn bench_under_gravity(law: Law) -> Kernel {
    let mut system = with_law(bench(50.0, 11.0), law);
    let shape = system.modes.participation_sqrt_kg.clone();
    let shape = if shape.iter().all(|p| *p == 0.0) {
        system.stops[0].shape.clone()
    } else {
        shape
    };
    system.signals.push(Signal {
        name: "gravity".to_owned(),
        shape,
        wave: Wave::Constant(0.1),
        base: None,
        drawn_from: None,
    });
    kernel(system)
}

/// Error of the derivative by the duration against a central difference, relative to its largest
/// entry.
fn duration_error(kernel: &Kernel, y: &[f64], period_s: f64) -> f64 {
    let rate = FlowSensitivity::integrate(
        kernel,
        y,
        START_S,
        period_s,
        1e-12,
        &ParameterSensitivity::default(),
    )
    .unwrap()
    .rate;
    let h = 1e-6 * period_s;
    let (later, earlier) = (
        end_state(kernel, y, period_s + h),
        end_state(kernel, y, period_s - h),
    );
    let size = rate.iter().fold(0.0_f64, |max, v| max.max(v.abs()));
    (0..y.len())
        .map(|i| ((later[i] - earlier[i]) / (2.0 * h) - rate[i]).abs() / size)
        .fold(0.0, f64::max)
}

/// Constant forces on modes with restoring forces and on a free body, which has none. Includes the
/// derivative by the duration. Measured: 5e-10 to 3e-6, the largest for the ball and Kelvin and
/// Voigt; by the duration 2e-9.
#[test]
fn jacobian_is_the_difference_of_flows_under_gravity() {
    let hertz = Hertz {
        stiffness: 1000.0,
        exponent: 1.5,
    };
    for (name, kernel) in [
        ("hertz", bench_under_gravity(Law::Hertz(hertz))),
        (
            "kelvin-voigt",
            bench_under_gravity(Law::KelvinVoigt(KelvinVoigt {
                stiffness_n_m: 100.0,
                damping_n_s_m: 0.1,
            })),
        ),
        (
            "hunt-crossley",
            bench_under_gravity(Law::HuntCrossley(HuntCrossley {
                elastic: hertz,
                damping_s_m: 0.3,
            })),
        ),
        (
            "ball, hunt-crossley",
            ball("law = \"hunt-crossley\"\nstiffness = \"1e5 N/m^1.5\"\ndamping = \"0.3 s/m\""),
        ),
        (
            "ball, kelvin-voigt",
            ball("law = \"kelvin-voigt\"\nstiffness = \"1e4 N/m\"\ndamping = \"9 N s/m\""),
        ),
        ("ball, rigid", ball("law = \"rigid\"\nrestitution = 0.8")),
    ] {
        let (y, period_s) = state_after_contacts(&kernel);
        let largest_error = jacobian_error(&kernel, &y, period_s);
        let duration_error = duration_error(&kernel, &y, period_s);
        eprintln!(
            "under gravity, {name}: {largest_error:.1e}, by the duration {duration_error:.1e}"
        );
        assert!(
            largest_error < 1e-5 && duration_error < 1e-5,
            "{name}: {largest_error:e} {duration_error:e}"
        );
    }
}
