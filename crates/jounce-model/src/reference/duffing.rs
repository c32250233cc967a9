//! Duffing's oscillator: a mass on a linear and a cubic spring.
//!
//! ```text
//! m (x'' + 2 zeta w0 x' + w0^2 x) + k3 x^3 = F sin(w t),   b = k3 / m
//! ```
//!
//! The backbone is that of the free undamped motion, `w(a) = pi sqrt(w0^2 + b a^2) / (2 K(n))`,
//! with `n = b a^2 / (2 (w0^2 + b a^2))` and `K` the complete elliptic integral. The first harmonic
//! alone gives `w^2 = w0^2 + 3/4 b a^2`. For the driven motion it gives
//! `[(w0^2 - w^2 + 3/4 b a^2)^2 + (2 zeta w0 w)^2] a^2 = (F / m)^2`, a curve with folds.
//!
//! SI units, amplitudes zero to peak. Source: I. Kovacic and M. J. Brennan, *The Duffing Equation*
//! (Wiley, 2011), sections 2.2 and 5.3.

use super::Reference;
use super::root::between;
use super::single_mode::{oscillator, shape, state, with_stop};
use crate::contact::{Cubic, Law};
use crate::plant::{Drive, System};
use std::f64::consts::TAU;

/// Mass on a linear and a cubic spring.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Duffing {
    /// `m`, kg.
    pub mass_kg: f64,
    /// `w0`, rad/s.
    pub frequency_rad_s: f64,
    /// `zeta`.
    pub damping_ratio: f64,
    /// `k3`, N/m^3; negative for a spring that softens.
    pub cubic_stiffness_n_m3: f64,
}

impl Reference for Duffing {
    const SOURCE: &'static str = "Kovacic and Brennan, The Duffing Equation (Wiley, 2011)";
    const TOLERANCE: f64 = 1e-9;
}

impl Duffing {
    /// Returns the system without a drive.
    pub fn system(&self) -> System {
        let law = Law::Cubic(Cubic {
            stiffness_n_m: 0.0,
            cubic_stiffness_n_m3: self.cubic_stiffness_n_m3,
        });
        with_stop(
            oscillator(self.mass_kg, self.frequency_rad_s, self.damping_ratio),
            self.mass_kg,
            0.0,
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

    /// Returns the state `(q, q')` of the mass at rest at a displacement.
    pub fn at_rest(&self, displacement_m: f64) -> Vec<f64> {
        state(self.mass_kg, displacement_m, 0.0)
    }

    /// `b a^2`, rad^2/s^2.
    fn stiffening(&self, amplitude_m: f64) -> f64 {
        self.cubic_stiffness_n_m3 / self.mass_kg * amplitude_m * amplitude_m
    }

    /// Exact `w(a)` of the free motion, rad/s; for a softening spring only below the amplitude
    /// `w0 / sqrt(-b)`, above which the motion diverges.
    pub fn backbone_rad_s(&self, amplitude_m: f64) -> f64 {
        let (square, added) = (self.frequency_rad_s.powi(2), self.stiffening(amplitude_m));
        // K(n) = pi / (2 M(1, sqrt(1 - n))), with M the arithmetic-geometric mean.
        (square + added).sqrt()
            * gauss_mean(1.0, ((square + 0.5 * added) / (square + added)).sqrt())
    }

    /// `w(a)` by the first harmonic alone, rad/s.
    pub fn first_harmonic_backbone_rad_s(&self, amplitude_m: f64) -> f64 {
        (self.frequency_rad_s.powi(2) + 0.75 * self.stiffening(amplitude_m)).sqrt()
    }

    /// Folds of the driven motion by the first harmonic alone, `(w in rad/s, a in m)`, largest
    /// amplitude first.
    pub fn first_harmonic_folds(&self, amplitude_n: f64) -> Vec<(f64, f64)> {
        let curve = FirstHarmonic {
            square: self.frequency_rad_s.powi(2),
            bending: 0.75 * self.cubic_stiffness_n_m3 / self.mass_kg,
            loss: 2.0 * (self.damping_ratio * self.frequency_rad_s).powi(2),
            force: (amplitude_n / self.mass_kg).powi(2),
        };
        let Some(tip) = curve.tip() else {
            return Vec::new();
        };
        // The folds may lie arbitrarily close to the tip, so the samples have geometric spacing.
        let samples: Vec<f64> = (0..=LOOKS)
            .map(|k| tip * (1.0 - 1e-9_f64.powf(1.0 - f64::from(k) / f64::from(LOOKS + 1))))
            .collect();
        let turns = samples
            .windows(2)
            .filter(|pair| curve.slope(pair[0]) * curve.slope(pair[1]) < 0.0);
        turns
            .map(|pair| {
                let s = between(|s| curve.slope(s), pair[1], pair[0]);
                (curve.outer(s).sqrt(), s.sqrt())
            })
            .collect()
    }
}

/// Number of samples along the curve in the search for folds.
const LOOKS: u32 = 4000;

/// Curve `(w0^2 + h s - u)^2 + 2 l u = f^2 / s` over `s = a^2`, solved for `u = w^2` on the side
/// with folds:
///
/// ```text
/// u = w0^2 + h s - l +- r,   r^2 = l^2 - 2 l (w0^2 + h s) + f^2 / s
/// ```
struct FirstHarmonic {
    square: f64,
    /// `h`, `3 b / 4`.
    bending: f64,
    /// `l`, `2 zeta^2 w0^2`.
    loss: f64,
    /// `f^2`.
    force: f64,
}

impl FirstHarmonic {
    /// `s` where `r` vanishes: the largest amplitude.
    fn tip(&self) -> Option<f64> {
        let (a, b) = (
            2.0 * self.loss * self.bending,
            self.loss * (2.0 * self.square - self.loss),
        );
        // a s^2 + b s - f^2 = 0, the root next to 0.
        let root = (b * b + 4.0 * a * self.force).sqrt();
        (!root.is_nan()).then(|| 2.0 * self.force / (b + root))
    }

    fn root(&self, s: f64) -> f64 {
        (self.loss * (self.loss - 2.0 * (self.square + self.bending * s)) + self.force / s)
            .max(0.0)
            .sqrt()
    }

    fn outer(&self, s: f64) -> f64 {
        self.square + self.bending * s - self.loss + self.bending.signum() * self.root(s)
    }

    /// `2 r du/ds`.
    fn slope(&self, s: f64) -> f64 {
        2.0 * self.bending * self.root(s)
            - self.bending.signum() * (2.0 * self.loss * self.bending + self.force / (s * s))
    }
}

/// Arithmetic-geometric mean.
fn gauss_mean(mut a: f64, mut b: f64) -> f64 {
    while (a - b).abs() > 4.0 * f64::EPSILON * a {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    0.5 * (a + b)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn duffing(cubic_stiffness_n_m3: f64) -> Duffing {
        Duffing {
            mass_kg: 1.0,
            frequency_rad_s: 1.0,
            damping_ratio: 0.01,
            cubic_stiffness_n_m3,
        }
    }

    #[test]
    fn backbone_is_that_of_the_tables() {
        for (b, period_s, first) in [
            (0.5, 5.366659355, 1.172603940),
            (1.0, 4.768022029, 1.322875656),
        ] {
            let exact = duffing(b).backbone_rad_s(1.0);
            assert!((TAU / exact - period_s).abs() < 1e-9, "{}", TAU / exact);
            assert!((duffing(b).first_harmonic_backbone_rad_s(1.0) - first).abs() < 1e-9);
        }
        // Small amplitudes: w = w0 (1 + 3/8 b a^2 - 21/256 b^2 a^4 ...), both signs.
        for b in [1.0, -1.0] {
            let (a, exact) = (0.1, duffing(b).backbone_rad_s(0.1));
            let series = 1.0 + 0.375 * b * a * a - 21.0 / 256.0 * (b * a * a).powi(2);
            assert!((exact - series).abs() < 5e-8, "{exact} {series}");
        }
    }

    /// Checks both equations of a fold: the point is on the curve, and the curve is vertical there.
    #[test]
    fn folds_of_the_first_harmonic_solve_its_equations() {
        for (b, force) in [(0.05, 0.04), (-0.05, 0.02)] {
            let duffing = duffing(b);
            let folds = duffing.first_harmonic_folds(force);
            assert_eq!(folds.len(), 2, "{folds:?}");
            for (w, a) in folds {
                let (d, c, bent) = (1.0 - w * w + 0.75 * b * a * a, 0.02 * w, 0.75 * b * a * a);
                assert!(((d * d + c * c) * a * a / (force * force) - 1.0).abs() < 1e-10);
                assert!((d * d + c * c + 2.0 * bent * d).abs() < 1e-8, "{w} {a}");
            }
        }
    }
}
