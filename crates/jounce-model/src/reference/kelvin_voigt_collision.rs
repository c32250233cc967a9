//! Free mass that strikes a spring and dashpot that push and never pull.
//!
//! With `w = sqrt(k / m)`, `zeta = c / (2 sqrt(k m)) < 1` and `phi = 2 acos(zeta)`, the force
//! vanishes after `t_c = phi / (w sqrt(1 - zeta^2))`, while the mass is still past the stop. The
//! restitution is
//!
//! ```text
//! e = exp(-zeta phi / sqrt(1 - zeta^2))
//! ```
//!
//! SI units. Source: Schwager and Poeschel, Granular Matter 9 (2007) 465.

use super::Reference;
use super::single_mode::{oscillator, state, with_stop};
use crate::contact::{KelvinVoigt, Law};
use crate::plant::System;

/// Free mass and a stop at displacement 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KelvinVoigtCollision {
    /// `m`, kg.
    pub mass_kg: f64,
    /// `v`, m/s.
    pub speed_m_s: f64,
    /// `k`, N/m.
    pub stiffness_n_m: f64,
    /// `c`, N s/m, below critical.
    pub damping_n_s_m: f64,
}

impl Reference for KelvinVoigtCollision {
    const SOURCE: &'static str = "Schwager and Poeschel, Granular Matter 9 (2007) 465";
    const TOLERANCE: f64 = 1e-8;
}

impl KelvinVoigtCollision {
    /// Returns the system to integrate, with the stop at displacement 0.
    pub fn system(&self) -> System {
        let law = Law::KelvinVoigt(KelvinVoigt {
            stiffness_n_m: self.stiffness_n_m,
            damping_n_s_m: self.damping_n_s_m,
        });
        with_stop(oscillator(self.mass_kg, 0.0, 0.0), self.mass_kg, 0.0, law)
    }

    /// Returns the initial state `(q, q')` at a distance before the stop, moving towards it.
    pub fn start(&self, before_m: f64) -> Vec<f64> {
        state(self.mass_kg, -before_m, self.speed_m_s)
    }

    /// `zeta`.
    pub fn damping_ratio(&self) -> f64 {
        0.5 * self.damping_n_s_m / (self.stiffness_n_m * self.mass_kg).sqrt()
    }

    /// `e`, rebound speed over approach speed.
    pub fn restitution(&self) -> f64 {
        let zeta = self.damping_ratio();
        (-zeta * 2.0 * zeta.acos() / ((1.0 - zeta) * (1.0 + zeta)).sqrt()).exp()
    }

    /// Time during which the stop pushes, s.
    pub fn push_time_s(&self) -> f64 {
        let zeta = self.damping_ratio();
        2.0 * zeta.acos()
            / ((self.stiffness_n_m / self.mass_kg) * (1.0 - zeta) * (1.0 + zeta)).sqrt()
    }
}
