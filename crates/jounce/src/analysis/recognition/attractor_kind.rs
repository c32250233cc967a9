//! Kinds of long-term motion.

use serde::{Deserialize, Serialize};

/// The kind of an attractor, or why a start has none.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum AttractorKind {
    /// Periodic.
    Orbit,
    /// Neighbours part exponentially.
    Chaos,
    /// Quasi-periodic: neighbours keep their distance, and averages converge.
    Torus,
    /// No attractor was proved to be reached within the cycles allowed.
    Undecided,
    /// The integration failed.
    Lost,
}

impl AttractorKind {
    /// Name in results.
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
