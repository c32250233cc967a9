//! Steady state reached from a start.

use super::attracting_orbit::AttractingOrbit;
use super::attractor_kind::AttractorKind;
use super::lyapunov::Lyapunov;
use std::sync::Arc;

/// Steady state reached from a start.
#[derive(Debug, Clone, PartialEq)]
pub enum SteadyState {
    /// Periodic orbit, proved by contraction.
    Periodic(ReachedOrbit),
    /// Aperiodic motion: no orbit was found.
    Aperiodic(Aperiodic),
    /// The integration failed, with its reason.
    Failed(String),
}

/// Orbit with the motion that has reached it.
#[derive(Debug, Clone, PartialEq)]
pub struct ReachedOrbit {
    /// The orbit.
    pub attracting: Arc<AttractingOrbit>,
    /// Drive cycles integrated until it was reached.
    pub cycles: u32,
    /// State of the motion in block coordinates at the search before the last, at the start of a
    /// drive cycle; `None` before two searches.
    pub earlier: Option<Vec<f64>>,
}

/// Aperiodic motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Aperiodic {
    /// Torus, chaos or undecided.
    pub kind: AttractorKind,
    /// Largest exponent, if computed.
    pub exponent: Option<Lyapunov>,
    /// Mean power of all loads over the second half of the cycles, W.
    pub mean_power_w: f64,
    /// Physical state at the last start of a drive cycle.
    pub state: Vec<f64>,
    /// Drive cycles integrated.
    pub cycles: u32,
}

impl SteadyState {
    /// Returns the kind of the attractor.
    pub fn kind(&self) -> AttractorKind {
        match self {
            Self::Periodic(_) => AttractorKind::Orbit,
            Self::Aperiodic(aperiodic) => aperiodic.kind,
            Self::Failed(_) => AttractorKind::Lost,
        }
    }

    /// Returns the orbit of a periodic steady state.
    pub fn orbit(&self) -> Option<&Arc<AttractingOrbit>> {
        match self {
            Self::Periodic(reached) => Some(&reached.attracting),
            Self::Aperiodic(_) | Self::Failed(_) => None,
        }
    }
}
