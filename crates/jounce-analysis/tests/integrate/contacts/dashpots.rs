//! Stops with a strong dashpot: against the closed form and Runge-Kutta, and the number of steps.

use super::ports::errors;
use super::several_stops::{coupled, stop};
use crate::plants::{integrate, kernel, physical, relative, springs};
use jounce_model::contact::{Hertz, HuntCrossley, KelvinVoigt, Law};
use jounce_model::plant::System;

/// Time after which the motion is compared, s.
const END_S: f64 = 2.0;

/// An oscillator that its spring presses onto a stop with a spring and a dashpot.
struct Pressed {
    frequency_hz: f64,
    damping_n_s_m: f64,
}

/// Ratio of the stiffness of the stop to that of the oscillator.
const STIFFNESS_RATIO: f64 = 2.0;
const GAP_M: f64 = -1e-3;
const START_M: f64 = -0.2e-3;

impl Pressed {
    fn stiffness_n_m(&self) -> f64 {
        (std::f64::consts::TAU * self.frequency_hz).powi(2)
    }

    fn law(&self) -> Law {
        Law::KelvinVoigt(KelvinVoigt {
            stiffness_n_m: STIFFNESS_RATIO * self.stiffness_n_m(),
            damping_n_s_m: self.damping_n_s_m,
        })
    }

    /// Displacement at the end from rest at `START_M`: `x'' + c x' + (1 + r) k x = r k gap`, whose
    /// roots are both real.
    fn displacement_m(&self) -> f64 {
        let (c, k) = (
            self.damping_n_s_m,
            (1.0 + STIFFNESS_RATIO) * self.stiffness_n_m(),
        );
        let at_rest_m = STIFFNESS_RATIO / (1.0 + STIFFNESS_RATIO) * GAP_M;
        let fast = -0.5 * (c + (c * c - 4.0 * k).sqrt());
        let slow = k / fast;
        let away_m = START_M - at_rest_m;
        at_rest_m
            + away_m * (fast * (slow * END_S).exp() - slow * (fast * END_S).exp()) / (fast - slow)
    }
}

/// The spring pushes the point through the dashpot, which decays 8,000 to 400,000 times faster
/// than the motion: one port alone, and two at once.
#[test]
fn motion_through_a_strong_dashpot_has_its_closed_form() {
    let both = [
        Pressed {
            frequency_hz: 10.0,
            damping_n_s_m: 1e4,
        },
        Pressed {
            frequency_hz: 14.0,
            damping_n_s_m: 1e5,
        },
    ];
    for pressed in [&both[..1], &both[1..], &both[..]] {
        let frequencies: Vec<f64> = pressed.iter().map(|one| one.frequency_hz).collect();
        let mut system: System = springs(&frequencies, 0.0);
        let mut start = vec![0.0; 2 * pressed.len()];
        for (index, one) in pressed.iter().enumerate() {
            let mut shape = vec![0.0; pressed.len()];
            shape[index] = 1.0;
            start[index] = START_M;
            system
                .stops
                .push(stop(&format!("stop-{index}"), &shape, GAP_M, one.law()));
        }
        let kernel = kernel(system);
        let integrator = integrate(&kernel, &start, 0.0, END_S, 1e-9);
        let end = physical(&integrator, &kernel);
        for (x, one) in end.iter().zip(pressed) {
            let error = relative(*x, one.displacement_m());
            assert!(error < 1e-9, "{x} {} {error:e}", one.displacement_m());
        }
        // The fixed point alone contracts on steps up to a few times 1/c: 2,000 to 20,000 steps.
        let work = integrator.work();
        assert!(work.contact_steps < 500, "{work:?}");
    }
}

/// A strong dashpot that is struck and left, next to another stop.
#[test]
fn contacts_with_a_strong_dashpot_agree_with_a_plain_integrator() {
    let mut system = coupled();
    system.stops[0].law = Law::HuntCrossley(HuntCrossley {
        elastic: Hertz {
            stiffness: 4e5,
            exponent: 1.5,
        },
        damping_s_m: 300.0,
    });
    let errors = errors(&system, 0.4);
    assert!(errors[0] < 1e-5 && errors[3] < 1e-9, "{errors:?}");
}
