//! Hunt-Crossley contact without adhesion: `F = k delta^n max(0, 1 + a delta')`, continuous at
//! first touch.
//!
//! Source: Hunt and Crossley, J. Appl. Mech. 42 (1975) 440; for small `a v` the restitution is
//! about `1 - (2/3) a v`.

use super::{ContactLaw, Hertz, Slopes};
use jounce_simd::Simd;

/// Hertz force times a rate factor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HuntCrossley {
    /// `k delta^n`.
    pub elastic: Hertz,
    /// `a`, s/m.
    pub damping_s_m: f64,
}

impl ContactLaw for HuntCrossley {
    const RATE_DEPENDENT: bool = true;

    #[inline(always)]
    fn force_n(&self, penetration_m: f64, rate_m_s: f64) -> f64 {
        self.elastic.force_n(penetration_m, 0.0) * (1.0 + self.damping_s_m * rate_m_s).max(0.0)
    }

    #[inline(always)]
    fn forces_n<W: Simd>(
        &self,
        simd: W,
        penetration_m: W::Register,
        rate_m_s: W::Register,
    ) -> W::Register {
        let factor = simd.fma(simd.splat(self.damping_s_m), rate_m_s, simd.splat(1.0));
        simd.mul(
            self.elastic.forces_n(simd, penetration_m, rate_m_s),
            simd.max(factor, simd.zero()),
        )
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
            stiffness_n_m: self.elastic.slopes(penetration_m, 0.0).stiffness_n_m * factor,
            damping_n_s_m: self.elastic.force_n(penetration_m, 0.0) * self.damping_s_m,
        }
    }

    fn energy_j(&self, penetration_m: f64) -> f64 {
        self.elastic.energy_j(penetration_m)
    }

    #[inline(always)]
    fn elastic_force_n(&self, penetration_m: f64) -> f64 {
        self.elastic.force_n(penetration_m, 0.0)
    }
}
