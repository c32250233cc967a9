//! Contact laws from their textbook formulas, each smooth within a phase of the contact.
//!
//! With the penetration `d` (m) and its rate `d'` (m/s):
//!
//! ```text
//! power      F = k d^n (1 + a d')   d > 0, 1 + a d' > 0       Hertz (1882), a = 0; Hunt and Crossley (1975)
//! viscous    F = k d + c d'         d > 0, k d + c d' > 0     Kelvin-Voigt that does not pull
//! cubic      F = k d + k3 d^3       everywhere                Duffing
//! table      F = f(d) (1 + a d')    d > 0, 1 + a d' > 0       the curve f of the library, which its own tests check
//! rigid      d'+ = -e d'-           d = 0                     Newton
//! ```

use jounce_model::contact as theirs;
use jounce_spec::ForceCurve;

/// Parameters of a law.
#[derive(Debug, Clone, Copy)]
pub enum Law {
    Power { k: f64, n: f64, a: f64 },
    Viscous { k: f64, c: f64 },
    Cubic { k: f64, k3: f64 },
    Table { f: &'static ForceCurve, a: f64 },
    Rigid { e: f64 },
}

/// Phase of one contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    /// Open.
    Free,
    /// In contact with a positive force.
    Pushing,
    /// Past the surface of a damped stop that recovers more slowly: no force.
    Slack,
    /// Sticking to a rigid stop.
    Resting,
}

impl Law {
    /// Parameters from a law of the library.
    pub fn of(law: &theirs::Law) -> Self {
        match law {
            theirs::Law::Hertz(law) => Law::Power {
                k: law.stiffness,
                n: law.exponent,
                a: 0.0,
            },
            theirs::Law::HuntCrossley(law) => Law::Power {
                k: law.elastic.stiffness,
                n: law.elastic.exponent,
                a: law.damping_s_m,
            },
            theirs::Law::KelvinVoigt(law) => Law::Viscous {
                k: law.stiffness_n_m,
                c: law.damping_n_s_m,
            },
            theirs::Law::Cubic(law) => Law::Cubic {
                k: law.stiffness_n_m,
                k3: law.cubic_stiffness_n_m3,
            },
            theirs::Law::Table(law) => Law::Table {
                f: law.curve(),
                a: law.damping_s_m(),
            },
            theirs::Law::Rigid(law) => Law::Rigid { e: law.restitution },
        }
    }

    /// Phase at the start of a motion.
    pub fn phase(&self, d: f64, rate: f64) -> Phase {
        match self {
            Law::Cubic { .. } => Phase::Pushing,
            _ if d < 0.0 => Phase::Free,
            Law::Rigid { .. } => Phase::Free,
            _ if self.push(d, rate) < 0.0 => Phase::Slack,
            _ => Phase::Pushing,
        }
    }

    /// Force, N, in a phase.
    #[inline(always)]
    pub fn force(&self, phase: Phase, d: f64, rate: f64) -> f64 {
        if phase != Phase::Pushing {
            return 0.0;
        }
        match *self {
            Law::Power { k, n, a } => k * power(d.max(0.0), n) * (1.0 + a * rate),
            Law::Viscous { k, c } => k * d + c * rate,
            Law::Cubic { k, k3 } => d * (k + k3 * d * d),
            Law::Table { f, a } => f.force_n(d) * (1.0 + a * rate),
            Law::Rigid { .. } => 0.0,
        }
    }

    /// Quantity with the sign of a damped force past the surface.
    #[inline(always)]
    pub fn push(&self, d: f64, rate: f64) -> f64 {
        match *self {
            Law::Power { a, .. } | Law::Table { a, .. } => 1.0 + a * rate,
            Law::Viscous { k, c } => k * d + c * rate,
            Law::Cubic { .. } | Law::Rigid { .. } => 1.0,
        }
    }

    /// Rate of [`Law::push`].
    #[inline(always)]
    pub fn push_rate(&self, rate: f64, acceleration: f64) -> f64 {
        match *self {
            Law::Power { a, .. } | Law::Table { a, .. } => a * acceleration,
            Law::Viscous { k, c } => k * rate + c * acceleration,
            Law::Cubic { .. } | Law::Rigid { .. } => 0.0,
        }
    }

    /// Part of the force, N, that stores energy; zero off the stop.
    pub fn elastic(&self, d: f64) -> f64 {
        match *self {
            Law::Cubic { k, k3 } => d * (k + k3 * d * d),
            Law::Rigid { .. } => 0.0,
            _ if d <= 0.0 => 0.0,
            Law::Power { k, n, .. } => k * power(d, n),
            Law::Viscous { k, .. } => k * d,
            Law::Table { f, .. } => f.force_n(d),
        }
    }

    /// Energy stored at a penetration, J.
    pub fn stored(&self, d: f64) -> f64 {
        match *self {
            Law::Cubic { k, k3 } => 0.5 * d * d * (k + 0.5 * k3 * d * d),
            Law::Rigid { .. } => 0.0,
            _ if d <= 0.0 => 0.0,
            Law::Power { k, n, .. } => k * d * power(d, n) / (n + 1.0),
            Law::Viscous { k, .. } => 0.5 * k * d * d,
            Law::Table { f, .. } => f.energy_j(d),
        }
    }

    /// Stiffness and damping of a force that is a linear function of the state.
    pub fn linear(&self) -> Option<[f64; 2]> {
        match *self {
            Law::Viscous { k, c } => Some([k, c]),
            Law::Power { k, n: 1.0, a: 0.0 } => Some([k, 0.0]),
            _ => None,
        }
    }

    /// True where the force can vanish past the surface.
    pub fn is_damped(&self) -> bool {
        matches!(*self, Law::Power { a, .. } | Law::Table { a, .. } if a > 0.0)
            || matches!(*self, Law::Viscous { c, .. } if c > 0.0)
    }
}

#[inline(always)]
fn power(d: f64, n: f64) -> f64 {
    if n == 1.5 {
        d * d.sqrt()
    } else if n == 1.0 {
        d
    } else {
        d.powf(n)
    }
}
