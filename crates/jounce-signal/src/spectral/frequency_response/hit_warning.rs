//! Faults of a hit.

use serde::Serialize;

/// Fault of a hit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum HitWarning {
    /// The hammer touched twice.
    Double {
        /// Time to the second peak, s.
        after_s: f64,
        /// Force of the second peak, N.
        force_n: f64,
    },
    /// The top is flat: the amplifier was saturated.
    Clipped {
        /// Equal samples at the top.
        samples: usize,
    },
    /// The pulse has too few samples for its shape.
    Coarse {
        /// Samples above the edge.
        samples: usize,
    },
    /// The record begins or ends within the pulse.
    Cut,
    /// A response moves before the hit: the structure still rings from the previous hit, or there
    /// is hum on the line.
    Ringing {
        /// RMS before the hit relative to the RMS of the block.
        share: f64,
    },
}

/// Text after "the hit": the fault with its numbers.
impl std::fmt::Display for HitWarning {
    fn fmt(&self, to: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Double { after_s, force_n } => {
                write!(to, "is double: {force_n:.4} N again after {after_s:.4e} s")
            }
            Self::Clipped { samples } => {
                write!(to, "is clipped: {samples} equal samples at the top")
            }
            Self::Coarse { samples } => write!(to, "is coarse: only {samples} samples"),
            Self::Cut => write!(to, "is truncated by the end of the record"),
            Self::Ringing { share } => write!(
                to,
                "occurs while a response still moves, with {share:.4} of its rms in the block: \
                wait longer between hits, or strike once per recording"
            ),
        }
    }
}
