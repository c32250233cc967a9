//! One attractor along the key.

use super::diagram_point::DiagramPoint;
use crate::analysis::AttractorKind;
use serde::Serialize;

/// An attractor at one value.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TrackPoint {
    /// Value of the key, SI.
    pub parameter: f64,
    /// Mean power, W.
    pub mean_power_w: f64,
    /// Contacts per period, 0 for none.
    pub contacts_per_period: u64,
    /// Share of the starts whose march did not fail; 0 where only a march from the neighbouring value finds it.
    pub fraction: f64,
    /// Lower end of its 95 % interval.
    pub fraction_low: f64,
    /// Upper end of its 95 % interval.
    pub fraction_high: f64,
}

/// How an attractor begins or ends.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Transition {
    /// First value at which it is there, or no longer there, SI.
    pub parameter: f64,
    /// The attractor that a march over the step comes from, or ends on; `None` for one that was not seen there.
    pub other: Option<String>,
}

/// An attractor with its own id.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AttractorTrack {
    /// Drive cycles of the period and a letter by first appearance: `1a`, `2a`; `chaos-a`.
    pub id: String,
    /// What the motion is.
    pub motion: AttractorKind,
    /// Drive cycles of the period, 0 for none.
    pub period_cycles: u32,
    /// How it came about; `None` where it is there at the first value.
    pub born: Option<Transition>,
    /// How it ended; `None` where it is there at the last value.
    pub died: Option<Transition>,
    /// Where it was seen.
    pub seen: Vec<TrackPoint>,
}

impl AttractorTrack {
    /// A name that is not taken yet.
    pub(super) fn name(known: &[AttractorTrack], of: &DiagramPoint) -> String {
        let alike = |known: &&AttractorTrack| {
            known.motion == of.motion && known.period_cycles == of.period_cycles
        };
        let letters = crate::analysis::basins::letters(known.iter().filter(alike).count());
        match of.motion {
            AttractorKind::Orbit => format!("{}{letters}", of.period_cycles),
            other => format!("{}-{letters}", other.name()),
        }
    }
}
