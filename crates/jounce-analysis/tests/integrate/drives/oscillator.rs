//! An oscillator under signals, and its stop.

use jounce_model::contact::Law;
use jounce_model::drive::Wave;
use jounce_model::plant::{Signal, Stop, System};
use jounce_model::reference::Harmonic;
use jounce_spec::Spec;

/// A mass of 1 kg, so modal and physical coordinates are equal.
pub fn oscillator(frequency_rad_s: f64, damping_ratio: f64) -> System {
    let mut system = Harmonic {
        mass_kg: 1.0,
        frequency_rad_s,
        damping_ratio,
        amplitude_n: 0.0,
        drive_hz: 1.0,
    }
    .system();
    system.drives.clear();
    system
}

pub fn with_signal(mut system: System, wave: Wave) -> System {
    let shape = vec![1.0; system.modes.len()];
    system.signals.push(Signal {
        name: "signal".into(),
        shape,
        wave,
        base: None,
        drawn_from: None,
    });
    system
}

pub fn with_stop(mut system: System, gap_m: f64, law: Law) -> System {
    system.stops.push(Stop {
        name: "stop".into(),
        shape: vec![1.0],
        gap_m,
        law,
        bases: Vec::new(),
    });
    system
}

pub fn pseudo_random(count: u32) -> Vec<f64> {
    (0..count)
        .map(|k| 3.0 * (1.7 * f64::from(k * k % 1009)).sin() + (0.37 * f64::from(k)).cos())
        .collect()
}

pub fn spring_mass(drive: &str) -> System {
    let text = format!(
        "[mass.m]\nmass = \"2 kg\"\nstiffness = \"7.2 kN/m\"\ndamping_ratio = 0.04\n[reduction]\nmodes = 1\n{drive}"
    );
    let spec = Spec::from_toml(&text).unwrap();
    System::assemble(&spec, jounce_model::structure::modes(&spec).unwrap()).unwrap()
}
