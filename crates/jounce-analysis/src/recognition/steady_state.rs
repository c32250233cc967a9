//! Steady state reached from a start.

use super::attracting_orbit::AttractingOrbit;
use super::attractor_kind::AttractorKind;
use super::lyapunov::Lyapunov;
use std::sync::Arc;

/// Steady state reached from a start.
#[derive(Debug, Clone, PartialEq)]
pub enum SteadyState {
    /// Periodic orbit, proved by contraction.
    Periodic(Arc<AttractingOrbit>),
    /// Aperiodic motion: no orbit was found.
    Aperiodic(Aperiodic),
    /// The integration failed, with its reason.
    Failed(String),
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
            Self::Periodic(orbit) => Some(orbit),
            Self::Aperiodic(_) | Self::Failed(_) => None,
        }
    }
}
