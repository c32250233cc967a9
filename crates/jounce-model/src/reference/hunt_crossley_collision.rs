//! Free mass that strikes a stop whose damping grows with penetration, `F = k d^n (1 + a d')`.
//!
//! `m s ds / (1 + a s) = -k d^n dd` for the rate `s` integrates to
//! `g(s) = s / a - ln(1 + a s) / a^2`, equal at entry and exit:
//!
//! ```text
//! g(-e v) = g(v),     k d_max^(n+1) / ((n + 1) m) = g(v)
//! ```
//!
//! SI units. Source: Hunt and Crossley, J. Appl. Mech. 42 (1975) 440, solved exactly.

use super::Reference;
use super::root::between;
use super::single_mode::{oscillator, state, with_stop};
use crate::contact::{Hertz, HuntCrossley, Law};
use crate::plant::System;

/// Free mass and a stop at displacement 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HuntCrossleyCollision {
    /// `m`, kg.
    pub mass_kg: f64,
    /// `v`, m/s.
    pub speed_m_s: f64,
    /// `k`, N/m^n.
    pub stiffness: f64,
    /// `n`, at least 1.
    pub exponent: f64,
    /// `a`, s/m, above 0.
    pub damping_s_m: f64,
}

impl Reference for HuntCrossleyCollision {
    const SOURCE: &'static str = "Hunt and Crossley, J. Appl. Mech. 42 (1975) 440, solved exactly";
    const TOLERANCE: f64 = 1e-8;
}

impl HuntCrossleyCollision {
    /// Returns the system to integrate, with the stop at displacement 0.
    pub fn system(&self) -> System {
        let elastic = Hertz {
            stiffness: self.stiffness,
            exponent: self.exponent,
        };
        let law = Law::HuntCrossley(HuntCrossley {
            elastic,
            damping_s_m: self.damping_s_m,
        });
        with_stop(oscillator(self.mass_kg, 0.0, 0.0), self.mass_kg, 0.0, law)
    }

    /// Returns the initial state `(q, q')` at a distance before the stop, moving towards it.
    pub fn start(&self, before_m: f64) -> Vec<f64> {
        state(self.mass_kg, -before_m, self.speed_m_s)
    }

    /// `e`, rebound speed over approach speed.
    pub fn restitution(&self) -> f64 {
        let av = self.damping_s_m * self.speed_m_s;
        let entry = scaled_energy(av);
        // The energy grows without bound as e a v approaches 1, so the root lies below both 1 and 1
        // / (a v).
        between(
            |e| scaled_energy(-e * av) - entry,
            0.0,
            1.0_f64.min((1.0 - f64::EPSILON) / av),
        )
    }

    /// `d_max`, m.
    pub fn peak_penetration_m(&self) -> f64 {
        let n1 = self.exponent + 1.0;
        let energy = scaled_energy(self.damping_s_m * self.speed_m_s) / self.damping_s_m.powi(2);
        (n1 * self.mass_kg * energy / self.stiffness).powf(1.0 / n1)
    }
}

/// `x - ln(1 + x)`, without cancellation near 0.
fn scaled_energy(x: f64) -> f64 {
    if x.abs() > 0.1 {
        return x - x.ln_1p();
    }
    // x^2/2 - x^3/3 + x^4/4 - ...
    (2..24).rev().map(|k| (-x).powi(k) / f64::from(k)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_damping_costs_two_thirds_of_a_v() {
        let collision = HuntCrossleyCollision {
            mass_kg: 1.0,
            speed_m_s: 1e-4,
            stiffness: 1.0,
            exponent: 1.5,
            damping_s_m: 1.0,
        };
        assert!(
            ((1.0 - collision.restitution()) / (2e-4 / 3.0) - 1.0).abs() < 1e-4,
            "{}",
            collision.restitution()
        );
    }

    #[test]
    fn series_and_closed_form_of_the_energy_meet() {
        for x in [0.0999999_f64, -0.0999999] {
            assert!((scaled_energy(x) / (x - x.ln_1p()) - 1.0).abs() < 1e-13);
        }
    }
}
