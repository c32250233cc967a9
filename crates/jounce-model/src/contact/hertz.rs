//! Hertz contact `F = k max(0, delta)^n` (paper eq. (4) with `n = 3/2`); the one-sided linear
//! spring is `n = 1`.

use super::{ContactLaw, Slopes};
use jounce_simd::{Simd, power};

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
        let depth_m = penetration_m.max(0.0);
        // Common exponents avoid `powf`.
        if self.exponent == 1.5 {
            self.stiffness * (depth_m * depth_m.sqrt())
        } else if self.exponent == 1.0 {
            self.stiffness * depth_m
        } else if self.exponent == 2.0 {
            self.stiffness * (depth_m * depth_m)
        } else {
            self.stiffness * depth_m.powf(self.exponent)
        }
    }

    #[inline(always)]
    fn forces_n<W: Simd>(
        &self,
        simd: W,
        penetration_m: W::Register,
        _rate_m_s: W::Register,
    ) -> W::Register {
        let depth_m = simd.max(penetration_m, simd.zero());
        let stiffness = simd.splat(self.stiffness);
        if self.exponent == 1.5 {
            simd.mul(stiffness, simd.mul(depth_m, simd.sqrt(depth_m)))
        } else if self.exponent == 1.0 {
            simd.mul(stiffness, depth_m)
        } else if self.exponent == 2.0 {
            simd.mul(stiffness, simd.mul(depth_m, depth_m))
        } else {
            simd.mul(stiffness, power(simd, depth_m, self.exponent))
        }
    }

    #[inline]
    fn slopes(&self, penetration_m: f64, _rate_m_s: f64) -> Slopes {
        // n k delta^(n-1) = n F / delta
        let stiffness_n_m = if penetration_m > 0.0 {
            self.exponent * self.force_n(penetration_m, 0.0) / penetration_m
        } else if penetration_m == 0.0 && self.exponent == 1.0 {
            self.stiffness
        } else {
            0.0
        };
        Slopes {
            stiffness_n_m,
            damping_n_s_m: 0.0,
        }
    }

    fn energy_j(&self, penetration_m: f64) -> f64 {
        self.stiffness * penetration_m.max(0.0).powf(self.exponent + 1.0) / (self.exponent + 1.0)
    }

    #[inline(always)]
    fn elastic_force_n(&self, penetration_m: f64) -> f64 {
        self.force_n(penetration_m, 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use jounce_simd::{F64x8, Portable};

    #[test]
    fn eight_forces_are_the_force_eight_times() {
        let depths = F64x8([-1e-3, 0.0, 1e-9, 1e-6, 1e-4, 1e-3, 0.1, 2.0]);
        for exponent in [1.0, 1.3, 1.5, 2.0, 2.5] {
            let law = Hertz {
                stiffness: 1e3,
                exponent,
            };
            let simd = Portable::new();
            let forces = simd.store(law.forces_n(simd, simd.load(&depths), simd.zero()));
            for (force, depth) in forces.0.iter().zip(depths.0) {
                let expected = law.force_n(depth, 0.0);
                assert!(
                    (force - expected).abs() <= 6.0 * f64::EPSILON * expected,
                    "exponent {exponent}: {force} {expected}"
                );
            }
        }
    }
}
