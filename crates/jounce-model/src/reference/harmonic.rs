//! Steady response of a mass on a spring and a dashpot to a sinusoidal force.
//!
//! ```text
//! m (x'' + 2 zeta w0 x' + w0^2 x) = F sin(w t),   x = X sin(w t - a)
//! X = (F / m) / sqrt((w0^2 - w^2)^2 + (2 zeta w0 w)^2),   a = atan2(2 zeta w0 w, w0^2 - w^2)
//! ```
//!
//! SI units, `X` zero to peak. Source: Den Hartog, Mechanical Vibrations (1956), section 2.9.

use super::Reference;
use super::single_mode::{oscillator, shape};
use crate::plant::{Drive, System};
use std::f64::consts::TAU;

/// Driven mass on a spring and a dashpot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Harmonic {
    /// `m`, kg.
    pub mass_kg: f64,
    /// `w0`, rad/s; 0 for a free mass.
    pub frequency_rad_s: f64,
    /// `zeta`, 1 = critical.
    pub damping_ratio: f64,
    /// `F`, N, zero to peak.
    pub amplitude_n: f64,
    /// `w / 2 pi`, Hz.
    pub drive_hz: f64,
}

impl Reference for Harmonic {
    const SOURCE: &'static str = "Den Hartog, Mechanical Vibrations (1956), section 2.9";
    const TOLERANCE: f64 = 1e-12;
}

impl Harmonic {
    /// Returns the system to solve.
    pub fn system(&self) -> System {
        let mut system = oscillator(self.mass_kg, self.frequency_rad_s, self.damping_ratio);
        system.drives.push(Drive {
            name: "drive".to_owned(),
            shape: shape(self.mass_kg),
            amplitude_n: self.amplitude_n,
            frequency_hz: self.drive_hz,
            phase_rad: 0.0,
            base: None,
        });
        system
    }

    /// `X`, m, zero to peak.
    pub fn amplitude_m(&self) -> f64 {
        let (elastic, damping) = self.parts();
        self.amplitude_n / self.mass_kg / elastic.hypot(damping)
    }

    /// `a`, rad, phase lag of the displacement behind the force, 0 to pi.
    pub fn lag_rad(&self) -> f64 {
        let (elastic, damping) = self.parts();
        damping.atan2(elastic)
    }

    fn parts(&self) -> (f64, f64) {
        let (w0, w) = (self.frequency_rad_s, TAU * self.drive_hz);
        ((w0 - w) * (w0 + w), 2.0 * self.damping_ratio * w0 * w)
    }
}
