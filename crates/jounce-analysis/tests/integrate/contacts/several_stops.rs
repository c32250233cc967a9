//! Systems with several stops.

use crate::plants::{bench, integrate, kernel, physical, springs};
use jounce_model::contact::{Cubic, Hertz, Law, Rigid};
use jounce_model::plant::{Drive, Stop, System};
use std::f64::consts::TAU;

pub fn stop(name: &str, shape: &[f64], gap_m: f64, law: Law) -> Stop {
    Stop {
        name: name.to_owned(),
        shape: shape.to_vec(),
        gap_m,
        law,
        bases: Vec::new(),
    }
}

pub fn driven(mut system: System, shape: &[f64], amplitude_n: f64, frequency_hz: f64) -> System {
    system.drives.push(Drive {
        name: "shaker".to_owned(),
        shape: shape.to_vec(),
        amplitude_n,
        frequency_hz,
        phase_rad: 0.3,
        base: None,
    });
    system
}

/// The bench plant between its stop and the mirror image of this stop.
pub fn between_stops(amplitude_n: f64, frequency_hz: f64) -> System {
    let mut system = bench(amplitude_n, frequency_hz);
    let first = &system.stops[0];
    let behind: Vec<f64> = first.shape.iter().map(|s| -s).collect();
    let second = stop("behind", &behind, first.gap_m, first.law);
    system.stops.push(second);
    system
}

/// Three coupled modes and two soft stops with contacts that overlap in time.
pub fn coupled() -> System {
    let mut system = driven(
        springs(&[8.0, 21.0, 45.0], 0.01),
        &[1.0, 0.7, 0.4],
        40.0,
        9.0,
    );
    system.stops.push(stop(
        "tip",
        &[1.0, 0.8, -0.6],
        5e-3,
        Law::Hertz(Hertz {
            stiffness: 4e5,
            exponent: 1.5,
        }),
    ));
    system.stops.push(stop(
        "middle",
        &[0.7, -0.9, 0.5],
        4e-3,
        Law::Hertz(Hertz {
            stiffness: 2e5,
            exponent: 1.5,
        }),
    ));
    system
}

/// A mass returns to its rigid stop and another one strikes its own within one long step of a third
/// mass, which a cubic spring always holds. The interpolants of the step pass zero in the wrong
/// order for some of the delays.
#[test]
fn two_impacts_within_a_step_of_contact_act_in_order() {
    let (omegas, restitution) = ([1.0, 3.0, 2.8].map(|f| TAU * f), 0.5_f64);
    // Displacements are `sin(phase) / omega`: the phases at the first impact of each mass.
    let phases = [0.0, -0.5, 0.8_f64];
    let rebound = |mode: usize, times: i32, after_s: f64| {
        let (sine, cosine) = (omegas[mode] * after_s).sin_cos();
        let speed_m_s = restitution.powi(times) * phases[mode].cos();
        (phases[mode].sin() * cosine - speed_m_s * sine) / omegas[mode]
    };
    let return_s = 2.0 * (-restitution / phases[1].tan()).atan() / omegas[1];
    let (struck_s, end_s) = (0.2, 0.3);
    let mut worst = 0.0_f64;
    for later_s in (-40..=40).map(|k| 2.5e-4 * f64::from(k)) {
        let impacts_s = [0.0, struck_s, struck_s + return_s + later_s];
        let mut system = springs(&[1.0, 3.0, 2.8], 0.0);
        let cubic = Cubic {
            stiffness_n_m: 1.0,
            cubic_stiffness_n_m3: 1.0,
        };
        let held = stop("held", &[1.0, 0.0, 0.0], 0.0, Law::Cubic(cubic));
        system.stops.push(held);
        let mut start = vec![0.0, 0.0, 0.0, 1.0, 0.0, 0.0];
        for mode in [1, 2] {
            let shape: Vec<f64> = (0..3).map(|k| f64::from(u8::from(k == mode))).collect();
            let gap_m = phases[mode].sin() / omegas[mode];
            let law = Law::Rigid(Rigid { restitution });
            system
                .stops
                .push(stop(&format!("s{mode}"), &shape, gap_m, law));
            let (sine, cosine) = (phases[mode] - omegas[mode] * impacts_s[mode]).sin_cos();
            (start[mode], start[3 + mode]) = (sine / omegas[mode], cosine);
        }
        let kernel = kernel(system);
        let end = physical(&integrate(&kernel, &start, 0.0, end_s, 1e-6), &kernel);
        let exact = [
            rebound(1, 2, end_s - struck_s - return_s),
            rebound(2, 1, end_s - impacts_s[2]),
        ];
        worst = (0..2).fold(worst, |worst, k| worst.max((end[1 + k] - exact[k]).abs()));
    }
    eprintln!("{worst:e} m");
    assert!(worst < 1e-12);
}
