//! Where a start ends.

use super::attracting_orbit::AttractingOrbit;
use super::attractor_kind::AttractorKind;
use super::lyapunov::Lyapunov;
use std::sync::Arc;

/// Where a start ends.
#[derive(Debug, Clone, PartialEq)]
pub enum SteadyState {
    /// On a periodic orbit, as its contraction proves.
    Periodic(Arc<AttractingOrbit>),
    /// On no orbit that was found.
    Aperiodic(Aperiodic),
    /// Nowhere: the integration failed, for this reason.
    Failed(String),
}

/// A motion without a period.
#[derive(Debug, Clone, PartialEq)]
pub struct Aperiodic {
    /// Torus, chaos or undecided.
    pub kind: AttractorKind,
    /// Largest exponent, where it was computed.
    pub exponent: Option<Lyapunov>,
    /// Mean power of all loads over the second half of the cycles, W.
    pub mean_power_w: f64,
    /// Physical state at the end, at the start of a drive cycle.
    pub state: Vec<f64>,
    /// Drive cycles integrated.
    pub cycles: u32,
}

impl SteadyState {
    /// The kind.
    pub fn kind(&self) -> AttractorKind {
        match self {
            Self::Periodic(_) => AttractorKind::Orbit,
            Self::Aperiodic(found) => found.kind,
            Self::Failed(_) => AttractorKind::Lost,
        }
    }

    /// The orbit, where there is one.
    pub fn orbit(&self) -> Option<&Arc<AttractingOrbit>> {
        match self {
            Self::Periodic(orbit) => Some(orbit),
            Self::Aperiodic(_) | Self::Failed(_) => None,
        }
    }
}
