//! Cubic spring, which pulls and pushes: `F = k delta + k3 delta^3` on both sides of its
//! equilibrium.
//!
//! `k3 > 0` hardens, `k3 < 0` softens; with `k < 0 < k3` there are two wells. The point never
//! leaves contact, so there are no contacts to count and no grazing. A mass on a linear spring and
//! this one is Duffing's oscillator.
//!
//! Source: I. Kovacic and M. J. Brennan, *The Duffing Equation* (Wiley, 2011), section 1.1.

use super::{ContactLaw, Slopes};

/// Linear and cubic stiffness of either sign.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cubic {
    /// `k`, N/m.
    pub stiffness_n_m: f64,
    /// `k3`, N/m^3.
    pub cubic_stiffness_n_m3: f64,
}

impl ContactLaw for Cubic {
    const RATE_DEPENDENT: bool = false;
    const BOTH_SIDES: bool = true;

    #[inline(always)]
    fn force_n(&self, penetration_m: f64, _rate_m_s: f64) -> f64 {
        penetration_m
            * (self.stiffness_n_m + self.cubic_stiffness_n_m3 * penetration_m * penetration_m)
    }

    fn slopes(&self, penetration_m: f64, _rate_m_s: f64) -> Slopes {
        let stiffness_n_m =
            self.stiffness_n_m + 3.0 * self.cubic_stiffness_n_m3 * penetration_m * penetration_m;
        Slopes {
            stiffness_n_m,
            damping_n_s_m: 0.0,
        }
    }

    fn steepest(&self, reach_m: f64) -> Slopes {
        let stiffness_n_m =
            self.stiffness_n_m.abs() + 3.0 * self.cubic_stiffness_n_m3.abs() * reach_m * reach_m;
        Slopes {
            stiffness_n_m,
            damping_n_s_m: 0.0,
        }
    }

    fn energy_j(&self, penetration_m: f64) -> f64 {
        let square = penetration_m * penetration_m;
        square * (0.5 * self.stiffness_n_m + 0.25 * self.cubic_stiffness_n_m3 * square)
    }

    #[inline(always)]
    fn elastic_force_n(&self, penetration_m: f64) -> f64 {
        self.force_n(penetration_m, 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Compares slope, force and energy with central differences of a cubic and a quartic; the
    /// error is at most 3e-11.
    #[test]
    fn energy_force_and_slope_are_consistent_on_both_sides() {
        let law = Cubic {
            stiffness_n_m: -1.3,
            cubic_stiffness_n_m3: 0.7,
        };
        let h = 1e-5;
        for x in [-2.0, -0.4, 0.0, 0.9] {
            let difference = |f: &dyn Fn(f64) -> f64| (f(x + h) - f(x - h)) / (2.0 * h);
            assert!((difference(&|x| law.energy_j(x)) - law.force_n(x, 0.0)).abs() < 2e-10);
            assert!(
                (difference(&|x| law.force_n(x, 0.0)) - law.slopes(x, 0.0).stiffness_n_m).abs()
                    < 2e-10
            );
            assert!(law.slopes(x, 0.0).stiffness_n_m.abs() <= law.steepest(x).stiffness_n_m);
        }
    }
}
