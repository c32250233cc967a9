//! Bending modes of a uniform clamped-free beam (Euler and Bernoulli).
//!
//! ```text
//! 1 + cos l cosh l = 0,     w = (l / L)^2 sqrt(EI / m),     |phi(L)| = 2 / sqrt(m L)
//! phi(x) = (cosh b - cos b - s (sinh b - sin b)) / sqrt(m L),  b = l x / L,  s = (cosh l + cos l) / (sinh l + sin l)
//! ```
//!
//! `EI` in N m^2, `m` in kg/m, `phi` mass-normalised, kg^-1/2. Source: Blevins, Formulas for
//! Natural Frequency and Mode Shape (1979), table 8-1.

use super::Reference;
use super::root::between;
use crate::structure::Modes;
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// Uniform clamped-free beam.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cantilever {
    /// `EI`, N m^2.
    pub bending_stiffness_n_m2: f64,
    /// `m`, kg/m.
    pub mass_per_length_kg_m: f64,
    /// `L`, m.
    pub length_m: f64,
}

impl Reference for Cantilever {
    const SOURCE: &'static str =
        "Blevins, Formulas for Natural Frequency and Mode Shape (1979), table 8-1";
    const TOLERANCE: f64 = 1e-9;
}

impl Cantilever {
    /// Root `l` of the frequency equation of mode `mode`, counted from 0.
    pub fn root(mode: usize) -> f64 {
        // Divided by cosh, which grows without bound. The root lies within 0.32 of (mode + 1/2) pi,
        // and nearer for higher modes.
        let middle = (mode as f64 + 0.5) * PI;
        between(|l| l.cos() + 1.0 / l.cosh(), middle - 0.4, middle + 0.4)
    }

    /// Angular frequency, rad/s.
    pub fn frequency_rad_s(&self, mode: usize) -> f64 {
        (Self::root(mode) / self.length_m).powi(2)
            * (self.bending_stiffness_n_m2 / self.mass_per_length_kg_m).sqrt()
    }

    /// Mass-normalised shape at a distance from the clamp, kg^-1/2; the tip moves in the positive
    /// direction.
    pub fn shape(&self, mode: usize, position_m: f64) -> f64 {
        let l = Self::root(mode);
        let b = l * position_m / self.length_m;
        // cosh b - s sinh b without the difference of two large numbers, and s - 1 likewise.
        let divisor = 0.5 * (1.0 - (-2.0 * l).exp()) + l.sin() * (-l).exp();
        let ratio = (0.5 * (1.0 + (-2.0 * l).exp()) + l.cos() * (-l).exp()) / divisor;
        let below_one = (l.sin() - l.cos() - (-l).exp()) * (-l).exp() / divisor;
        let hyperbolic = 0.5 * below_one * b.exp() + 0.5 * (1.0 + ratio) * (-b).exp();
        let value = hyperbolic - b.cos() + ratio * b.sin();
        let sign = if mode.is_multiple_of(2) { 1.0 } else { -1.0 };
        sign * value / (self.mass_per_length_kg_m * self.length_m).sqrt()
    }

    /// Mass times mass-normalised shape, integrated over the beam, kg^1/2: `2 s sqrt(m L) / l`. The
    /// sign is positive where the tip and most of the beam move in the positive direction.
    pub fn participation_sqrt_kg(&self, mode: usize) -> f64 {
        let l = Self::root(mode);
        // s - 1 = (exp(-l) + cos l - sin l) / (sinh l + sin l), all terms divided by exp(l).
        let divisor = 0.5 * (1.0 - (-2.0 * l).exp()) + l.sin() * (-l).exp();
        let ratio = 1.0 + ((-l).exp() + l.cos() - l.sin()) * (-l).exp() / divisor;
        let sign = if mode.is_multiple_of(2) { 1.0 } else { -1.0 };
        sign * 2.0 * ratio / l * (self.mass_per_length_kg_m * self.length_m).sqrt()
    }

    /// Returns the first modes, undamped, with the point `tip`.
    pub fn modes(&self, count: usize) -> Modes {
        let tip = 2.0 / (self.mass_per_length_kg_m * self.length_m).sqrt();
        Modes {
            frequency_rad_s: (0..count).map(|mode| self.frequency_rad_s(mode)).collect(),
            damping_ratio: vec![0.0; count],
            shape: BTreeMap::from([("tip".to_owned(), vec![tip; count])]),
            patch: BTreeMap::new(),
            participation_sqrt_kg: (0..count)
                .map(|mode| self.participation_sqrt_kg(mode))
                .collect(),
            base_sqrt_kg: BTreeMap::new(),
            discretisation_error: vec![0.0; count],
            ..Modes::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_are_the_published_ones() {
        let published = [
            1.875_104_068_711_961,
            4.694_091_132_974_175,
            7.854_757_438_237_613,
            10.995_540_734_875_467,
        ];
        for (mode, expected) in published.into_iter().enumerate() {
            assert!(
                (Cantilever::root(mode) / expected - 1.0).abs() < 4e-16,
                "{}",
                Cantilever::root(mode)
            );
        }
    }

    #[test]
    fn shapes_are_clamped_at_the_root_and_two_at_the_tip() {
        let beam = Cantilever {
            bending_stiffness_n_m2: 2.0,
            mass_per_length_kg_m: 0.5,
            length_m: 2.0,
        };
        for mode in 0..12 {
            assert!(beam.shape(mode, 0.0).abs() < 1e-14, "mode {mode}");
            assert!(
                (beam.shape(mode, 2.0) - 2.0).abs() < 1e-12,
                "mode {mode}: {}",
                beam.shape(mode, 2.0)
            );
        }
    }
}
