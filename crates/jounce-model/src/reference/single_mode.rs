//! Systems of one mode, the basis of most references.
//!
//! A point mass `m` with displacement `x` is the mode `q = sqrt(m) x`, of shape `1 / sqrt(m)` at
//! the mass. Without a spring its frequency is 0.

use crate::contact::Law;
use crate::plant::{Stop, System};
use crate::structure::Modes;
use std::collections::BTreeMap;

/// Name of the point at the mass.
pub const MASS: &str = "mass";

/// Name of the patch of a reference that has one.
pub const PATCH: &str = "patch";

/// Returns a mass on a spring and a dashpot to the ground.
pub(super) fn oscillator(mass_kg: f64, frequency_rad_s: f64, damping_ratio: f64) -> System {
    let modes = Modes {
        frequency_rad_s: vec![frequency_rad_s],
        damping_ratio: vec![damping_ratio],
        shape: BTreeMap::from([(MASS.to_owned(), shape(mass_kg))]),
        patch: BTreeMap::new(),
        participation_sqrt_kg: vec![mass_kg.sqrt()],
        base_sqrt_kg: BTreeMap::new(),
        discretisation_error: vec![0.0],
        ..Modes::default()
    };
    System {
        modes: modes.into(),
        ..System::default()
    }
}

/// Adds a stop in the positive direction.
pub(super) fn with_stop(mut system: System, mass_kg: f64, gap_m: f64, law: Law) -> System {
    system.stops.push(Stop {
        name: "stop".to_owned(),
        shape: shape(mass_kg),
        gap_m,
        law,
        bases: Vec::new(),
    });
    system
}

/// Displacement of the mass per unit modal coordinate, kg^-1/2.
pub(super) fn shape(mass_kg: f64) -> Vec<f64> {
    vec![1.0 / mass_kg.sqrt()]
}

/// Returns `(q, q')` for a displacement and a velocity of the mass.
pub(super) fn state(mass_kg: f64, displacement_m: f64, velocity_m_s: f64) -> Vec<f64> {
    vec![
        mass_kg.sqrt() * displacement_m,
        mass_kg.sqrt() * velocity_m_s,
    ]
}
