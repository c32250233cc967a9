//! Free motion of a mass whose spring is stiffer on one side.
//!
//! With `w1` on the free side and `w2 = sqrt(w1^2 + k / m)` against the stop, each half swing lasts half a period of its own:
//!
//! ```text
//! T = pi / w1 + pi / w2,     x_max = a w1 / w2 for a release at rest from x = -a
//! ```
//!
//! SI units. Source: Shaw and Holmes, J. Sound Vib. 90 (1983) 129.

use super::Reference;
use super::single_mode::{oscillator, state, with_stop};
use crate::contact::{Hertz, Law};
use crate::plant::System;
use std::f64::consts::PI;

/// A mass on a spring that touches a second spring on one side, both relaxed at the place 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bilinear {
    /// `m`, kg.
    pub mass_kg: f64,
    /// `w1`, rad/s.
    pub frequency_rad_s: f64,
    /// `k` of the second spring, N/m.
    pub stop_stiffness_n_m: f64,
}

impl Reference for Bilinear {
    const SOURCE: &'static str = "Shaw and Holmes, J. Sound Vib. 90 (1983) 129";
    const TOLERANCE: f64 = 1e-8;
}

impl Bilinear {
    /// The system to march.
    pub fn system(&self) -> System {
        let law = Law::Hertz(Hertz { stiffness: self.stop_stiffness_n_m, exponent: 1.0 });
        with_stop(oscillator(self.mass_kg, self.frequency_rad_s, 0.0), self.mass_kg, 0.0, law)
    }

    /// Start `(q, q')` at rest, away from the stop.
    pub fn start(&self, away_m: f64) -> Vec<f64> {
        state(self.mass_kg, -away_m, 0.0)
    }

    /// `w2`, rad/s.
    pub fn contact_frequency_rad_s(&self) -> f64 {
        self.frequency_rad_s.hypot((self.stop_stiffness_n_m / self.mass_kg).sqrt())
    }

    /// `T`, s.
    pub fn period_s(&self) -> f64 {
        PI / self.frequency_rad_s + PI / self.contact_frequency_rad_s()
    }

    /// Largest penetration after a release at rest, m.
    pub fn peak_penetration_m(&self, away_m: f64) -> f64 {
        away_m * self.frequency_rad_s / self.contact_frequency_rad_s()
    }
}
