//! Hertz contact `F = k max(0, delta)^n` (paper eq. (4) with `n = 3/2`); the one-sided linear spring is `n = 1`.

use super::{ContactLaw, Slopes};

/// Elastic contact with a power law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hertz {
    /// `k`, N/m^n.
    pub stiffness: f64,
    /// `n`, at least 1.
    pub exponent: f64,
}

impl ContactLaw for Hertz {
    const RATE_DEPENDENT: bool = false;

    #[inline(always)]
    fn force_n(&self, penetration_m: f64, _rate_m_s: f64) -> f64 {
        self.forces_n(&[penetration_m], &[0.0])[0]
    }

    #[inline(always)]
    fn forces_n<const N: usize>(&self, penetration_m: &[f64; N], _rate_m_s: &[f64; N]) -> [f64; N] {
        let mut force = [0.0; N];
        // The exponents of practice, 3/2 and 1, avoid `powf`, which does not vectorise.
        if self.exponent == 1.5 {
            for i in 0..N {
                let depth = if penetration_m[i] > 0.0 { penetration_m[i] } else { 0.0 };
                force[i] = self.stiffness * depth * depth.sqrt();
            }
        } else if self.exponent == 1.0 {
            for i in 0..N {
                force[i] = self.stiffness * if penetration_m[i] > 0.0 { penetration_m[i] } else { 0.0 };
            }
        } else {
            for i in 0..N {
                force[i] = self.stiffness * penetration_m[i].max(0.0).powf(self.exponent);
            }
        }
        force
    }

    #[inline]
    fn slopes(&self, penetration_m: f64, _rate_m_s: f64) -> Slopes {
        let inside = penetration_m >= 0.0;
        let stiffness_n_m = if inside { self.stiffness * self.exponent * penetration_m.max(0.0).powf(self.exponent - 1.0) } else { 0.0 };
        Slopes { stiffness_n_m, damping_n_s_m: 0.0 }
    }

    fn energy_j(&self, penetration_m: f64) -> f64 {
        self.stiffness * penetration_m.max(0.0).powf(self.exponent + 1.0) / (self.exponent + 1.0)
    }

    #[inline(always)]
    fn elastic_force_n(&self, penetration_m: f64) -> f64 {
        self.force_n(penetration_m, 0.0)
    }
}
