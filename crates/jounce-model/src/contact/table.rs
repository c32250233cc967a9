//! Tabulated contact without adhesion: `F = f(delta) max(0, 1 + a delta')` with a monotone force
//! curve `f` through measured points (see [`ForceCurve`]).
//!
//! A law is copied by every step, so it holds a reference to its curve. Curves live as long as the
//! program; equal curves are stored once. A sweep over the points stores one curve for each value,
//! 56 bytes for each point.

use super::{ContactLaw, Slopes};
use jounce_spec::ForceCurve;
use std::sync::{Mutex, PoisonError};

/// Curves of all tables of the program.
static CURVES: Mutex<Vec<&'static ForceCurve>> = Mutex::new(Vec::new());

/// Force curve through points, times a rate factor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Table {
    /// `f(delta)`.
    curve: &'static ForceCurve,
    /// `a`, s/m; 0 for an elastic contact.
    damping_s_m: f64,
}

impl Table {
    /// Creates the law of a force curve with a damping factor, s/m.
    pub fn new(curve: ForceCurve, damping_s_m: f64) -> Self {
        let mut curves = CURVES.lock().unwrap_or_else(PoisonError::into_inner);
        let known = curves.iter().rev().find(|known| ***known == curve).copied();
        let curve = known.unwrap_or_else(|| {
            let curve: &'static ForceCurve = Box::leak(Box::new(curve));
            curves.push(curve);
            curve
        });
        Self { curve, damping_s_m }
    }

    /// Returns the force curve.
    pub fn curve(&self) -> &'static ForceCurve {
        self.curve
    }

    /// Returns the damping factor, s/m.
    pub fn damping_s_m(&self) -> f64 {
        self.damping_s_m
    }
}

impl ContactLaw for Table {
    const RATE_DEPENDENT: bool = true;

    #[inline(always)]
    fn is_rate_dependent(&self) -> bool {
        self.damping_s_m > 0.0
    }

    #[inline]
    fn force_n(&self, penetration_m: f64, rate_m_s: f64) -> f64 {
        self.curve.force_n(penetration_m) * (1.0 + self.damping_s_m * rate_m_s).max(0.0)
    }

    fn slopes(&self, penetration_m: f64, rate_m_s: f64) -> Slopes {
        let factor = 1.0 + self.damping_s_m * rate_m_s;
        if factor < 0.0 {
            return Slopes {
                stiffness_n_m: 0.0,
                damping_n_s_m: 0.0,
            };
        }
        Slopes {
            stiffness_n_m: self.curve.slope_n_m(penetration_m) * factor,
            damping_n_s_m: self.curve.force_n(penetration_m) * self.damping_s_m,
        }
    }

    fn steepest(&self, reach_m: f64) -> Slopes {
        Slopes {
            stiffness_n_m: self.curve.steepest_n_m(reach_m),
            damping_n_s_m: self.curve.force_n(reach_m) * self.damping_s_m,
        }
    }

    fn energy_j(&self, penetration_m: f64) -> f64 {
        self.curve.energy_j(penetration_m)
    }

    #[inline]
    fn elastic_force_n(&self, penetration_m: f64) -> f64 {
        self.curve.force_n(penetration_m)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn equal_curves_are_stored_once() {
        let law = |force_n: f64| Table::new(ForceCurve::through(&[1.0], &[force_n]).unwrap(), 0.5);
        assert!(std::ptr::eq(law(2.0).curve, law(2.0).curve));
        assert!(law(2.0) != law(3.0));
    }

    #[test]
    fn the_rate_multiplies_the_force_of_the_curve_and_never_pulls() {
        let curve = ForceCurve::through(&[1.0, 2.0], &[1.0, 4.0]).unwrap();
        let law = Table::new(curve, 0.5);
        let elastic = law.elastic_force_n(1.5);
        assert_eq!(law.force_n(1.5, 1.0), 1.5 * elastic);
        assert_eq!(law.force_n(1.5, -3.0), 0.0);
        let slopes = law.slopes(1.5, 1.0);
        let h = 1e-6;
        let stiffness = (law.force_n(1.5 + h, 1.0) - law.force_n(1.5 - h, 1.0)) / (2.0 * h);
        assert!((slopes.stiffness_n_m - stiffness).abs() < 1e-8);
        assert_eq!(slopes.damping_n_s_m, 0.5 * elastic);
    }
}
