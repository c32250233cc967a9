//! Systems with several stops.

use crate::plants::{bench, springs};
use jounce_model::contact::{Hertz, Law};
use jounce_model::plant::{Drive, Stop, System};

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
