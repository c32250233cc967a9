//! Free motion of a mass whose spring is stiffer beyond a gap.
//!
//! Released at rest at `x = -a`, the mass meets a second spring, relaxed at the gap `g`. With `w1`
//! on the free side and `w2 = sqrt(w1^2 + k / m)` in contact:
//!
//! ```text
//! T = 2 / w1 (pi - acos(g / a)) + 2 / w2 acos((g - c) / b)
//! c = g (1 - w1^2 / w2^2),   b^2 = (g - c)^2 + w1^2 (a^2 - g^2) / w2^2,   x_max = c + b
//! ```
//!
//! `c` is the equilibrium in contact and `b` the amplitude about it. Without a gap
//! `T = pi / w1 + pi / w2` at any amplitude: the bilinear frequency `2 w1 w2 / (w1 + w2)`. With a
//! gap, this is the backbone of the driven motion.
//!
//! SI units. Source: two sinusoids joined at the gap; Shaw and Holmes, J. Sound Vib. 90 (1983) 129.

use super::Reference;
use super::single_mode::{oscillator, shape, state, with_stop};
use crate::contact::{Hertz, Law};
use crate::plant::{Drive, System};
use std::f64::consts::{PI, TAU};

/// Mass on a spring that touches a second spring on one side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bilinear {
    /// `m`, kg.
    pub mass_kg: f64,
    /// `w1`, rad/s.
    pub frequency_rad_s: f64,
    /// `zeta` of the first spring; the closed forms hold for 0.
    pub damping_ratio: f64,
    /// `k` of the second spring, N/m.
    pub stop_stiffness_n_m: f64,
    /// `g`, m, not negative.
    pub gap_m: f64,
}

impl Reference for Bilinear {
    const SOURCE: &'static str = "Shaw and Holmes, J. Sound Vib. 90 (1983) 129";
    const TOLERANCE: f64 = 1e-8;
}

impl Bilinear {
    /// Returns the system without a drive.
    pub fn system(&self) -> System {
        let law = Law::Hertz(Hertz {
            stiffness: self.stop_stiffness_n_m,
            exponent: 1.0,
        });
        with_stop(
            oscillator(self.mass_kg, self.frequency_rad_s, self.damping_ratio),
            self.mass_kg,
            self.gap_m,
            law,
        )
    }

    /// Returns the system under `F sin(w t)`.
    pub fn driven(&self, amplitude_n: f64, drive_rad_s: f64) -> System {
        let mut system = self.system();
        system.drives.push(Drive {
            name: "drive".to_owned(),
            shape: shape(self.mass_kg),
            amplitude_n,
            frequency_hz: drive_rad_s / TAU,
            phase_rad: 0.0,
            base: None,
        });
        system
    }

    /// Returns the initial state `(q, q')` at rest, away from the stop.
    pub fn start(&self, away_m: f64) -> Vec<f64> {
        state(self.mass_kg, -away_m, 0.0)
    }

    /// `w2`, rad/s.
    pub fn contact_frequency_rad_s(&self) -> f64 {
        self.frequency_rad_s
            .hypot((self.stop_stiffness_n_m / self.mass_kg).sqrt())
    }

    /// `(g - c, b)`, m: gap and amplitude, measured from the equilibrium in contact.
    fn contact_m(&self, away_m: f64) -> (f64, f64) {
        let ratio = self.frequency_rad_s / self.contact_frequency_rad_s();
        let edge_m = self.gap_m * ratio * ratio;
        (
            edge_m,
            edge_m.hypot(ratio * ((away_m - self.gap_m) * (away_m + self.gap_m)).sqrt()),
        )
    }

    /// `T`, s, of the motion that reaches `away_m` on the free side; that of the first spring where
    /// this is within the gap.
    pub fn period_s(&self, away_m: f64) -> f64 {
        if away_m <= self.gap_m {
            return TAU / self.frequency_rad_s;
        }
        let (edge_m, amplitude_m) = self.contact_m(away_m);
        let free_s = 2.0 / self.frequency_rad_s * (PI - (self.gap_m / away_m).acos());
        free_s + 2.0 / self.contact_frequency_rad_s() * (edge_m / amplitude_m).acos()
    }

    /// Largest penetration after a release at rest, m.
    pub fn peak_penetration_m(&self, away_m: f64) -> f64 {
        let (edge_m, amplitude_m) = self.contact_m(away_m.max(self.gap_m));
        amplitude_m - edge_m
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_are_the_bilinear_and_the_linear_frequency() {
        let bilinear = Bilinear {
            mass_kg: 0.5,
            frequency_rad_s: 3.0,
            damping_ratio: 0.0,
            stop_stiffness_n_m: 60.0,
            gap_m: 0.0,
        };
        let w2 = bilinear.contact_frequency_rad_s();
        assert!((TAU / bilinear.period_s(0.3) - 2.0 * 3.0 * w2 / (3.0 + w2)).abs() < 1e-13);
        assert!((bilinear.peak_penetration_m(0.3) - 0.3 * 3.0 / w2).abs() < 1e-15);
        let with_gap = Bilinear {
            gap_m: 0.1,
            ..bilinear
        };
        // Just beyond the gap the contact lasts 2 v / (w1^2 g), the same time as with the first
        // spring only.
        assert!((with_gap.period_s(0.1 + 1e-9) - TAU / 3.0).abs() < 1e-6);
        assert!((with_gap.period_s(1e9) - bilinear.period_s(1.0)).abs() < 1e-9);
        // Energy: m w1^2 a^2 = m w1^2 x^2 + k (x - g)^2 at the far turning point.
        let depth = with_gap.peak_penetration_m(0.3);
        let energy = 0.5 * 9.0 * (0.1 + depth).powi(2) + 60.0 * depth * depth;
        assert!((energy - 0.5 * 9.0 * 0.09).abs() < 1e-14, "{energy}");
    }
}
