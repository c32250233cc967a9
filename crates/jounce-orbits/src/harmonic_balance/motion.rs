//! Motion of a port as a sum of harmonics.
//!
//! ```text
//! d(x) = u_0 + sqrt(2) sum_n (u_(2n-1) cos n x + u_(2n) sin n x),   x = w t / p
//! ```
//!
//! The factor makes `|u|^2` the mean square of `d` (m^2). `x` is an angle of the period, rad.

use super::angles::Angles;
use jounce_linalg::c64;
use jounce_model::contact::{ContactLaw, Law};
use std::f64::consts::SQRT_2;

/// Motion of the port relative to its stop.
#[derive(Debug)]
pub struct PortMotion {
    /// `c_n` of `d = Re sum c_n e^(i n x)` without the gap: penetration.
    pub depth: Vec<c64>,
    /// `w / p`, rad/s.
    pub step_rad_s: f64,
    /// Contact law of the stop.
    pub law: Law,
}

impl PortMotion {
    /// Creates the motion from the harmonics of the displacement.
    pub fn new(unknown: &[f64], step_rad_s: f64, gap_m: f64, law: Law) -> Self {
        let mut depth = complex(unknown);
        depth[0].re -= gap_m;
        Self {
            depth,
            step_rad_s,
            law,
        }
    }

    /// Returns penetration, m, and its rate, m/s.
    pub fn at(&self, angle: f64) -> (f64, f64) {
        let z = c64::cis(angle);
        let (mut value, mut slope) = (c64::new(0.0, 0.0), c64::new(0.0, 0.0));
        for (n, c) in self.depth.iter().enumerate().rev() {
            value = value * z + c;
            slope = slope * z + c * n as f64;
        }
        (value.re, -slope.im * self.step_rad_s)
    }

    /// Returns penetration, m, and its rate, m/s, at many angles; the rate is 0 where the law does
    /// not depend on it.
    pub fn along(&self, angles: &Angles) -> [Vec<f64>; 2] {
        if self.law.is_rate_dependent() {
            return angles.values([&self.depth, &rotated(&self.depth, self.step_rad_s)]);
        }
        let [depths_m] = angles.values([&self.depth]);
        let none = vec![0.0; depths_m.len()];
        [depths_m, none]
    }

    /// True where the stop pushes.
    pub fn touches(&self, (depth_m, rate_m_s): (f64, f64)) -> bool {
        self.law.acts_on_both_sides() || depth_m > 0.0 && self.law.force_n(depth_m, rate_m_s) > 0.0
    }
}

/// Returns the `c_n` of real harmonics.
pub fn complex(unknown: &[f64]) -> Vec<c64> {
    let pairs = unknown[1..]
        .chunks_exact(2)
        .map(|pair| c64::new(pair[0], -pair[1]) * SQRT_2);
    std::iter::once(c64::new(unknown[0], 0.0))
        .chain(pairs)
        .collect()
}

/// Returns the real harmonics of `c_n`.
pub fn real(coefficients: &[c64]) -> Vec<f64> {
    let pairs = coefficients[1..]
        .iter()
        .flat_map(|c| [c.re / SQRT_2, -c.im / SQRT_2]);
    std::iter::once(coefficients[0].re).chain(pairs).collect()
}

/// Returns the `c_n` of a density with the moments `m_n = 1/T int F e^(i n x) dt`.
pub fn harmonics(moments: &[c64]) -> Vec<c64> {
    moments
        .iter()
        .enumerate()
        .map(|(n, m)| m.conj() * if n == 0 { 1.0 } else { 2.0 })
        .collect()
}

/// Returns the `c_n` of the rate, per second.
pub fn rotated(coefficients: &[c64], step_rad_s: f64) -> Vec<c64> {
    coefficients
        .iter()
        .enumerate()
        .map(|(n, c)| c * c64::new(0.0, n as f64 * step_rad_s))
        .collect()
}
