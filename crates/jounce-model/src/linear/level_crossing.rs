//! Rate at which a stationary Gaussian response reaches a level.
//!
//! ```text
//! rate = s_v / (2 pi s) exp(-(a - m)^2 / (2 s^2)),        share of the time beyond = erfc((a - m) / (sqrt(2) s)) / 2
//! ```
//!
//! with `m` the mean of the response, `s` its standard deviation, `s_v` the standard deviation of
//! its velocity and `a` the level. Upward crossings are counted. Source: S. O. Rice, Bell Syst.
//! Tech. J. 24 (1945) 46, section 3.3.

use std::f64::consts::{FRAC_1_SQRT_2, TAU};

/// A stationary Gaussian displacement and a level.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LevelCrossing {
    /// `m`, m.
    pub mean_m: f64,
    /// `s`, m.
    pub deviation_m: f64,
    /// `s_v`, m/s.
    pub velocity_m_s: f64,
    /// `a`, m.
    pub level_m: f64,
}

impl LevelCrossing {
    /// Returns the upward crossings per second, Hz; 0 for a displacement at rest.
    pub fn rate_hz(&self) -> f64 {
        if self.deviation_m == 0.0 {
            return 0.0;
        }
        let normalised = (self.level_m - self.mean_m) / self.deviation_m;
        self.velocity_m_s / (TAU * self.deviation_m) * (-0.5 * normalised * normalised).exp()
    }

    /// Returns the fraction of the time beyond the level, 0 to 1.
    pub fn share_beyond(&self) -> f64 {
        if self.deviation_m == 0.0 {
            return f64::from(u8::from(self.mean_m > self.level_m));
        }
        0.5 * libm::erfc(FRAC_1_SQRT_2 * (self.level_m - self.mean_m) / self.deviation_m)
    }
}
