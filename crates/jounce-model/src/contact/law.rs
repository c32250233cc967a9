//! Trait of a contact law, and the enum of all laws.

use super::{Cubic, Hertz, HuntCrossley, KelvinVoigt, Rigid, Table};
use jounce_simd::{F64x8, Simd};
use jounce_spec::{Stop, StopLaw};

/// Derivatives of a contact force.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Slopes {
    /// `dF/d delta`, N/m.
    pub stiffness_n_m: f64,
    /// `dF/d delta'`, N s/m.
    pub damping_n_s_m: f64,
}

/// A compliant contact law. All functions are total: outside contact they return zero.
pub trait ContactLaw: Copy + Send + Sync {
    /// True when the force depends on the rate of penetration.
    const RATE_DEPENDENT: bool;

    /// True for a law that acts on both sides of its surface: the point never leaves it.
    const BOTH_SIDES: bool = false;

    /// [`ContactLaw::RATE_DEPENDENT`], including laws known only at run time.
    #[inline(always)]
    fn is_rate_dependent(&self) -> bool {
        Self::RATE_DEPENDENT
    }

    /// [`ContactLaw::BOTH_SIDES`], including laws known only at run time.
    #[inline(always)]
    fn acts_on_both_sides(&self) -> bool {
        Self::BOTH_SIDES
    }

    /// Compressive force, N; negative only where the law acts on both sides.
    fn force_n(&self, penetration_m: f64, rate_m_s: f64) -> f64;

    /// Forces at eight instants; a law overrides this where that is faster.
    #[inline(always)]
    fn forces_n<W: Simd>(
        &self,
        simd: W,
        penetration_m: W::Register,
        rate_m_s: W::Register,
    ) -> W::Register {
        let (penetration_m, rate_m_s) = (simd.store(penetration_m).0, simd.store(rate_m_s).0);
        simd.load(&F64x8(std::array::from_fn(|i| {
            self.force_n(penetration_m[i], rate_m_s[i])
        })))
    }

    /// Both slopes of the force; at the edge of the contact, the one-sided slopes from inside.
    fn slopes(&self, penetration_m: f64, rate_m_s: f64) -> Slopes;

    /// Largest magnitudes of the slopes up to the given penetration, at zero rate.
    #[inline(always)]
    fn steepest(&self, reach_m: f64) -> Slopes {
        self.slopes(reach_m, 0.0)
    }

    /// Energy stored by the elastic part of the force, J.
    fn energy_j(&self, penetration_m: f64) -> f64;

    /// Elastic part of the force, N: the derivative of the stored energy.
    fn elastic_force_n(&self, penetration_m: f64) -> f64;
}

/// Calls a method of the compliant law of a stop; a rigid stop has the last value.
macro_rules! of_law {
    ($law:expr, $method:ident($($argument:expr),*), $rigid:expr) => {
        match $law {
            Law::Hertz(law) => law.$method($($argument),*),
            Law::KelvinVoigt(law) => law.$method($($argument),*),
            Law::HuntCrossley(law) => law.$method($($argument),*),
            Law::Cubic(law) => law.$method($($argument),*),
            Law::Table(law) => law.$method($($argument),*),
            Law::Rigid(_) => $rigid,
        }
    };
}

impl ContactLaw for Law {
    const RATE_DEPENDENT: bool = true;

    #[inline(always)]
    fn is_rate_dependent(&self) -> bool {
        of_law!(self, is_rate_dependent(), false)
    }

    #[inline(always)]
    fn acts_on_both_sides(&self) -> bool {
        Law::acts_on_both_sides(self)
    }

    #[inline(always)]
    fn force_n(&self, penetration_m: f64, rate_m_s: f64) -> f64 {
        Law::force_n(self, penetration_m, rate_m_s)
    }

    #[inline(always)]
    fn forces_n<W: Simd>(
        &self,
        simd: W,
        penetration_m: W::Register,
        rate_m_s: W::Register,
    ) -> W::Register {
        of_law!(self, forces_n(simd, penetration_m, rate_m_s), simd.zero())
    }

    #[inline(always)]
    fn slopes(&self, penetration_m: f64, rate_m_s: f64) -> Slopes {
        Law::slopes(self, penetration_m, rate_m_s)
    }

    fn steepest(&self, reach_m: f64) -> Slopes {
        of_law!(self, steepest(reach_m), Slopes::default())
    }

    fn energy_j(&self, penetration_m: f64) -> f64 {
        Law::energy_j(self, penetration_m)
    }

    fn elastic_force_n(&self, penetration_m: f64) -> f64 {
        of_law!(self, elastic_force_n(penetration_m), 0.0)
    }
}

/// Any contact law of a stop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Law {
    /// `F = k delta^n`; the linear spring is `n = 1`.
    Hertz(Hertz),
    /// Linear spring and dashpot that never pull.
    KelvinVoigt(KelvinVoigt),
    /// Hertz force with damping that grows with penetration.
    HuntCrossley(HuntCrossley),
    /// Linear and cubic spring on both sides.
    Cubic(Cubic),
    /// Monotone curve through measured points.
    Table(Table),
    /// Instantaneous rebound.
    Rigid(Rigid),
}

impl Law {
    /// Returns the law of a stop of a spec; `None` for a table whose points are no force curve,
    /// which a valid spec does not have.
    pub fn of(stop: &Stop) -> Option<Self> {
        Some(match stop.law {
            StopLaw::Hertz {
                stiffness,
                exponent,
            } => Law::Hertz(Hertz {
                stiffness,
                exponent,
            }),
            StopLaw::Spring { stiffness_n_m } => Law::Hertz(Hertz {
                stiffness: stiffness_n_m,
                exponent: 1.0,
            }),
            StopLaw::KelvinVoigt {
                stiffness_n_m,
                damping_n_s_m,
            } => Law::KelvinVoigt(KelvinVoigt {
                stiffness_n_m,
                damping_n_s_m,
            }),
            StopLaw::HuntCrossley {
                stiffness,
                exponent,
                damping_s_m,
            } => Law::HuntCrossley(HuntCrossley {
                elastic: Hertz {
                    stiffness,
                    exponent,
                },
                damping_s_m,
            }),
            StopLaw::Cubic {
                stiffness_n_m,
                cubic_stiffness_n_m3,
            } => Law::Cubic(Cubic {
                stiffness_n_m,
                cubic_stiffness_n_m3,
            }),
            StopLaw::Table { damping_s_m } => {
                Law::Table(Table::new(stop.table.curve()?, damping_s_m))
            }
            StopLaw::Rigid { restitution } => Law::Rigid(Rigid { restitution }),
        })
    }

    /// True where the point never leaves the law: it acts on both sides of its surface.
    pub fn acts_on_both_sides(&self) -> bool {
        matches!(self, Law::Cubic(_))
    }

    /// Compressive force, N; 0 for a rigid stop, whose force is an impulse.
    pub fn force_n(&self, penetration_m: f64, rate_m_s: f64) -> f64 {
        of_law!(self, force_n(penetration_m, rate_m_s), 0.0)
    }

    /// Both slopes of the force; 0 for a rigid stop.
    pub fn slopes(&self, penetration_m: f64, rate_m_s: f64) -> Slopes {
        of_law!(self, slopes(penetration_m, rate_m_s), Slopes::default())
    }

    /// Energy stored by the elastic part of the force, J; a rigid stop stores none.
    pub fn energy_j(&self, penetration_m: f64) -> f64 {
        of_law!(self, energy_j(penetration_m), 0.0)
    }
}
