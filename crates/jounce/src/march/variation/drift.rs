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

/// The share of the drives in the motion of the port at a time, and its change with the parameter.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Driven {
    pub displacement_m: f64,
    pub velocity_m_s: f64,
    pub acceleration_m_s2: f64,
    /// Per unit of the parameter: penetration, m.
    pub penetration_drift_m: f64,
    /// Per unit of the parameter: its rate, m/s.
    pub rate_drift_m_s: f64,
}

impl Drift {
    /// The port under the drives of a plant.
    pub(super) fn driven(&self, plant: &Plant, time_s: f64) -> Driven {
        let mut driven = Driven { penetration_drift_m: -self.gap_m, ..Driven::default() };
        for (k, (tone, s)) in plant.tones.iter().zip(&plant.ports[0].steady_m).enumerate() {
            let w = tone.angular_frequency_rad_s;
            let turn = c64::cis(w * time_s);
            let turned = s * turn;
            driven.displacement_m += turned.re;
            driven.velocity_m_s -= w * turned.im;
            driven.acceleration_m_s2 -= w * w * turned.re;
            if let Some((ds, dw)) = self.tones.get(k) {
                let change = ds + s * c64::new(0.0, time_s * dw);
                let hastened = change * c64::new(0.0, w) + s * c64::new(0.0, *dw);
                driven.penetration_drift_m += (change * turn).re;
                driven.rate_drift_m_s += (hastened * turn).re;
            }
        }
        driven
    }
}
