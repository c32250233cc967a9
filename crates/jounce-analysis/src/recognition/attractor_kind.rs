//! Kinds of long-term motion.

use serde::{Deserialize, Serialize};

/// Kind of an attractor, or the reason why a start has no attractor.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum AttractorKind {
    /// Periodic orbit.
    Orbit,
    /// Chaos: neighbouring trajectories diverge exponentially.
    Chaos,
    /// Quasi-periodic: neighbouring trajectories maintain their distance, and averages converge.
    Torus,
    /// No attractor was proved within the permitted cycles.
    Undecided,
    /// The integration failed.
    Lost,
}

impl AttractorKind {
    /// Returns the name in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Orbit => "orbit",
            Self::Chaos => "chaos",
            Self::Torus => "torus",
            Self::Undecided => "undecided",
            Self::Lost => "lost",
        }
    }
}
