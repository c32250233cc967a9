//! Free mass that strikes an elastic stop `F = k d^n` and rebounds with its approach speed.
//!
//! ```text
//! d_max = ((n + 1) m v^2 / (2 k))^(1 / (n + 1)),   F_max = k d_max^n
//! t_c = 2 (d_max / v) sqrt(pi) Gamma(1 + 1/(n+1)) / Gamma(1/2 + 1/(n+1))
//! ```
//!
//! SI units, `k` in N/m^n. `n = 1` gives `t_c = pi sqrt(m / k)`, `n = 3/2` gives
//! `2.943275184 d_max / v`. Source: energy balance; Hertz, J. reine angew. Math. 92 (1882) 156 for
//! `n = 3/2`.

use super::Reference;
use super::single_mode::{oscillator, state, with_stop};
use crate::contact::{Hertz, Law};
use crate::plant::System;
use std::f64::consts::PI;

/// Free mass and a stop at displacement 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HertzCollision {
    /// `m`, kg.
    pub mass_kg: f64,
    /// `v`, m/s.
    pub speed_m_s: f64,
    /// `k`, N/m^n.
    pub stiffness: f64,
    /// `n`, at least 1.
    pub exponent: f64,
}

impl Reference for HertzCollision {
    const SOURCE: &'static str = "energy balance; Hertz, J. reine angew. Math. 92 (1882) 156";
    const TOLERANCE: f64 = 1e-8;
}

impl HertzCollision {
    /// Returns the system to integrate, with the stop at displacement 0.
    pub fn system(&self) -> System {
        let law = Law::Hertz(Hertz {
            stiffness: self.stiffness,
            exponent: self.exponent,
        });
        with_stop(oscillator(self.mass_kg, 0.0, 0.0), self.mass_kg, 0.0, law)
    }

    /// Returns the initial state `(q, q')` at a distance before the stop, moving towards it.
    pub fn start(&self, before_m: f64) -> Vec<f64> {
        state(self.mass_kg, -before_m, self.speed_m_s)
    }

    /// `d_max`, m.
    pub fn peak_penetration_m(&self) -> f64 {
        let n1 = self.exponent + 1.0;
        (0.5 * n1 * self.mass_kg * self.speed_m_s.powi(2) / self.stiffness).powf(1.0 / n1)
    }

    /// `F_max`, N.
    pub fn peak_force_n(&self) -> f64 {
        self.stiffness * self.peak_penetration_m().powf(self.exponent)
    }

    /// `t_c`, s.
    pub fn contact_time_s(&self) -> f64 {
        let share = 1.0 / (self.exponent + 1.0);
        let gammas = libm::tgamma(1.0 + share) / libm::tgamma(0.5 + share);
        2.0 * self.peak_penetration_m() / self.speed_m_s * PI.sqrt() * gammas
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_published_collision_and_the_spring() {
        let hertz = HertzCollision {
            mass_kg: 0.01,
            speed_m_s: 0.5,
            stiffness: 1000.0,
            exponent: 1.5,
        };
        assert!(
            (hertz.peak_penetration_m() / 6.279716079e-3 - 1.0).abs() < 1e-9,
            "{}",
            hertz.peak_penetration_m()
        );
        // Published as 2.943275184 times the peak penetration over the speed.
        let published_s = 2.943275184 * hertz.peak_penetration_m() / hertz.speed_m_s;
        assert!(
            (hertz.contact_time_s() / published_s - 1.0).abs() < 1e-9,
            "{}",
            hertz.contact_time_s()
        );
        assert!(
            (hertz.peak_force_n() / 0.4976339632 - 1.0).abs() < 1e-9,
            "{}",
            hertz.peak_force_n()
        );
        let spring = HertzCollision {
            exponent: 1.0,
            ..hertz
        };
        assert!((spring.contact_time_s() / (PI * (0.01_f64 / 1000.0).sqrt()) - 1.0).abs() < 1e-14);
    }
}
