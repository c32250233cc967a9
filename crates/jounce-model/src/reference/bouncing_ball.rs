//! Ball that falls on a rigid floor and rebounds with the fraction `e` of its speed at each bounce.
//!
//! ```text
//! time to rest = sqrt(2 h / g) (1 + e) / (1 - e),     distance to rest = h (1 + e^2) / (1 - e^2)
//! ```
//!
//! Infinitely many bounces happen in a finite time (Zeno). SI units. Source: Falcon et al., Eur.
//! Phys. J. B 3 (1998) 45.

use super::Reference;

/// Ball released at rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BouncingBall {
    /// `h`, m.
    pub height_m: f64,
    /// `g`, m/s^2.
    pub gravity_m_s2: f64,
    /// `e`, 0 to below 1.
    pub restitution: f64,
}

impl Reference for BouncingBall {
    const SOURCE: &'static str =
        "geometric series of bounces; Falcon et al., Eur. Phys. J. B 3 (1998) 45";
    const TOLERANCE: f64 = 1e-9;
}

impl BouncingBall {
    /// Time of bounce number `bounce` (from 0), s.
    pub fn bounce_s(&self, bounce: u32) -> f64 {
        let fall_s = (2.0 * self.height_m / self.gravity_m_s2).sqrt();
        let e = self.restitution;
        // fall (1 + 2 e + 2 e^2 + ... + 2 e^bounce)
        let powers: f64 = (1..=bounce).map(|k| e.powi(k as i32)).sum();
        fall_s * (1.0 + 2.0 * powers)
    }

    /// Speed just after bounce number `bounce` (from 0), m/s.
    pub fn speed_after_m_s(&self, bounce: u32) -> f64 {
        (2.0 * self.gravity_m_s2 * self.height_m).sqrt() * self.restitution.powi(bounce as i32 + 1)
    }

    /// Time to rest, s.
    pub fn time_to_rest_s(&self) -> f64 {
        let e = self.restitution;
        (2.0 * self.height_m / self.gravity_m_s2).sqrt() * (1.0 + e) / (1.0 - e)
    }

    /// Total distance to rest, up and down, m.
    pub fn way_to_rest_m(&self) -> f64 {
        let squared = self.restitution.powi(2);
        self.height_m * (1.0 + squared) / (1.0 - squared)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comes_to_rest_where_its_bounces_lead() {
        let ball = BouncingBall {
            height_m: 1.0,
            gravity_m_s2: 9.81,
            restitution: 0.8,
        };
        assert!(
            (ball.time_to_rest_s() - 4.063712769).abs() < 1e-9,
            "{}",
            ball.time_to_rest_s()
        );
        assert!((ball.way_to_rest_m() - 4.555556).abs() < 1e-6);
        assert!((ball.bounce_s(200) - ball.time_to_rest_s()).abs() < 1e-12);
        let between = 2.0 * ball.speed_after_m_s(3) / ball.gravity_m_s2;
        assert!((ball.bounce_s(4) - ball.bounce_s(3) - between).abs() < 1e-14);
    }
}
