//! Coefficient of restitution of metal bodies from their yield strength: an estimate.
//!
//! The contact is elastic up to the speed of first yield, at the maximum pressure `1.6 Y`:
//!
//! ```text
//! m v_y^2 / 2 = (8/15) (pi/2)^5 (1.6 Y)^5 R^3 / E*^4 = 53 Y^5 R^3 / E*^4
//! low:   e = sqrt(6 sqrt(3) / 5) sqrt(1 - s^2 / 6) (s / (s + 2 sqrt((6 - s^2) / 5)))^(1/4),   s = v_y / v <= 1
//! high:  e = min(1, 3.8 (Y/E*)^(1/2) (m v^2 / (2 Y R^3))^(-1/8))
//! ```
//!
//! `low` takes the pressure to remain at the yield limit, `high` the fully plastic pressure `3 Y`.
//! At high speeds both fall as `v^(-1/4)`, and `high` is twice `low`.
//!
//! Source: K. L. Johnson, *Contact Mechanics* (1985), equations (11.43) and (11.47); C. Thornton,
//! J. Appl. Mech. 64 (1997) 383, equation (23). Limits: work hardening, the rise of the yield
//! strength with the rate of strain, waves and bending of the bodies are not included.

use std::f64::consts::FRAC_PI_2;

/// Maximum pressure at first yield over the yield strength.
const YIELD_PRESSURE_RATIO: f64 = 1.6;

/// Two bodies in collision, the softer of which yields.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlasticCollision {
    /// `m`, effective mass `m1 m2 / (m1 + m2)`, kg.
    pub mass_kg: f64,
    /// `R`, effective radius, `1/R = 1/R1 + 1/R2`, m.
    pub radius_m: f64,
    /// `E*`, effective modulus, Pa.
    pub modulus_pa: f64,
    /// `Y`, yield strength of the softer body, Pa.
    pub yield_strength_pa: f64,
}

impl PlasticCollision {
    /// Returns the speed of approach at which the softer body begins to yield, m/s.
    pub fn yield_speed_m_s(&self) -> f64 {
        let pressure_pa = YIELD_PRESSURE_RATIO * self.yield_strength_pa;
        let energy_j = 8.0 / 15.0
            * FRAC_PI_2.powi(5)
            * pressure_pa
            * (pressure_pa / self.modulus_pa).powi(4)
            * self.radius_m.powi(3);
        (2.0 * energy_j / self.mass_kg).sqrt()
    }

    /// Returns the range `[low, high]` of the coefficient of restitution at a speed of approach,
    /// m/s; 1 up to the speed of first yield.
    pub fn restitution_range(&self, speed_m_s: f64) -> [f64; 2] {
        let share = self.yield_speed_m_s() / speed_m_s;
        if share >= 1.0 {
            return [1.0; 2];
        }
        let unloading = share / (share + 2.0 * ((6.0 - share * share) / 5.0).sqrt());
        let low =
            (1.2 * 3.0_f64.sqrt() * (1.0 - share * share / 6.0)).sqrt() * unloading.powf(0.25);
        let energy_j = 0.5 * self.mass_kg * speed_m_s * speed_m_s;
        let energy = energy_j / (self.yield_strength_pa * self.radius_m.powi(3));
        let high = 3.8 * (self.yield_strength_pa / self.modulus_pa).sqrt() * energy.powf(-0.125);
        [low, high.min(1.0)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEEL_BALL: PlasticCollision = PlasticCollision {
        mass_kg: 4.1e-3,
        radius_m: 5e-3,
        modulus_pa: 80e9,
        yield_strength_pa: 300e6,
    };

    /// Johnson (11.43) prints the factor 53 with two digits.
    #[test]
    fn yield_begins_at_the_energy_of_johnson() {
        let energy_j = 0.5 * STEEL_BALL.mass_kg * STEEL_BALL.yield_speed_m_s().powi(2);
        let unit_j = 300e6_f64.powi(5) * 5e-3_f64.powi(3) / 80e9_f64.powi(4);
        assert!(
            (energy_j / unit_j - 53.0).abs() < 0.5,
            "{}",
            energy_j / unit_j
        );
    }

    #[test]
    fn restitution_falls_from_1_with_the_fourth_root_of_the_speed() {
        let yield_m_s = STEEL_BALL.yield_speed_m_s();
        let at = |times: f64| STEEL_BALL.restitution_range(times * yield_m_s);
        assert_eq!(at(0.9), [1.0; 2]);
        let just_above = at(1.0 + 1e-9);
        assert!((just_above[0] - 1.0).abs() < 1e-8 && just_above[1] == 1.0);
        let (fast, faster) = (at(1e4), at(16e4));
        for (slow, quick) in fast.iter().zip(faster) {
            assert!((slow / quick - 2.0).abs() < 1e-3, "{slow} {quick}");
        }
        assert!((fast[1] / fast[0] - 1.95).abs() < 0.01, "{fast:?}");
    }
}
