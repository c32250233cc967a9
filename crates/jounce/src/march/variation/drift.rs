//! The port at a fixed state: its motion under the drive, and what a parameter does to it.

use crate::plant::Plant;
use faer::c64;

/// What a parameter does at a fixed state `y`, per unit of the parameter.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Drift {
    /// Per tone: change of the complex port displacement (m) and of the angular frequency (rad/s).
    pub tones: Vec<(c64, f64)>,
    /// Change of the gap, m.
    pub gap_m: f64,
    /// Change of the contact force, relative to it.
    pub force_relative: f64,
}

/// Displacement (m), velocity (m/s) and acceleration (m/s2) of the port under the drives.
pub(super) fn driven(plant: &Plant, time_s: f64) -> [f64; 3] {
    let mut motion = [0.0; 3];
    for (tone, steady) in plant.tones.iter().zip(&plant.ports[0].steady_m) {
        let w = tone.angular_frequency_rad_s;
        let turned = steady * c64::cis(w * time_s);
        motion = [motion[0] + turned.re, motion[1] - w * turned.im, motion[2] - w * w * turned.re];
    }
    motion
}

impl Drift {
    /// What the parameter does to the penetration (m) and its rate (m/s) at a time.
    pub(super) fn of_port(&self, plant: &Plant, time_s: f64) -> [f64; 2] {
        let mut drift = [-self.gap_m, 0.0];
        for ((tone, s), (ds, dw)) in plant.tones.iter().zip(&plant.ports[0].steady_m).zip(&self.tones) {
            let w = tone.angular_frequency_rad_s;
            let turn = c64::cis(w * time_s);
            let change = ds + s * c64::new(0.0, time_s * dw);
            let hastened = change * c64::new(0.0, w) + s * c64::new(0.0, *dw);
            drift = [drift[0] + (change * turn).re, drift[1] + (hastened * turn).re];
        }
        drift
    }
}
