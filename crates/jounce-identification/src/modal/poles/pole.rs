//! Pole of a structure.

use jounce_linalg::c64;
use std::f64::consts::TAU;

/// Pole in the upper half plane, as frequency and damping ratio.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Pole {
    /// Undamped natural frequency `|p| / 2 pi`, Hz.
    pub frequency_hz: f64,
    /// Damping ratio `-re p / |p|`.
    pub damping_ratio: f64,
}

impl Pole {
    /// Converts a complex pole, rad/s.
    pub(in crate::modal) fn of(p: c64) -> Self {
        Self {
            frequency_hz: p.norm() / TAU,
            damping_ratio: -p.re / p.norm(),
        }
    }

    /// Complex pole, rad/s.
    pub(in crate::modal) fn complex(self) -> c64 {
        let w = TAU * self.frequency_hz;
        c64::new(
            -self.damping_ratio * w,
            w * (1.0 - self.damping_ratio.powi(2)).max(0.0).sqrt(),
        )
    }
}
