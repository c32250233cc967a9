//! Kelvin-Voigt contact without adhesion: `F = max(0, k delta + c delta')` for `delta > 0`.
//!
//! The force jumps to `c delta'` at first touch, and vanishes while the point is still past the
//! undeformed stop.

use super::{ContactLaw, Slopes};

/// Linear spring and dashpot in parallel, which push and never pull.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KelvinVoigt {
    /// `k`, N/m.
    pub stiffness_n_m: f64,
    /// `c`, N s/m.
    pub damping_n_s_m: f64,
}

impl ContactLaw for KelvinVoigt {
    const RATE_DEPENDENT: bool = true;

    #[inline(always)]
    fn force_n(&self, penetration_m: f64, rate_m_s: f64) -> f64 {
        if penetration_m < 0.0 {
            0.0
        } else {
            (self.stiffness_n_m * penetration_m + self.damping_n_s_m * rate_m_s).max(0.0)
        }
    }

    fn slopes(&self, penetration_m: f64, rate_m_s: f64) -> Slopes {
        let pushes = penetration_m >= 0.0
            && self.stiffness_n_m * penetration_m + self.damping_n_s_m * rate_m_s >= 0.0;
        if pushes {
            Slopes {
                stiffness_n_m: self.stiffness_n_m,
                damping_n_s_m: self.damping_n_s_m,
            }
        } else {
            Slopes {
                stiffness_n_m: 0.0,
                damping_n_s_m: 0.0,
            }
        }
    }

    fn energy_j(&self, penetration_m: f64) -> f64 {
        0.5 * self.stiffness_n_m * penetration_m.max(0.0).powi(2)
    }

    #[inline(always)]
    fn elastic_force_n(&self, penetration_m: f64) -> f64 {
        self.stiffness_n_m * penetration_m.max(0.0)
    }
}
