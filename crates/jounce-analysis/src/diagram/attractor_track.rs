//! One attractor along the key.

use super::diagram_point::DiagramPoint;
use crate::AttractorKind;
use serde::Serialize;

/// An attractor at one value.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TrackPoint {
    /// Value of the key, SI.
    pub parameter: f64,
    /// Mean power, W.
    pub mean_power_w: f64,
    /// Contacts per period, 0 without contact.
    pub contacts_per_period: u64,
    /// Fraction of the successful starts; 0 where only an integration from the neighbouring value
    /// finds it.
    pub fraction: f64,
    /// Lower end of the 95 % interval of the fraction.
    pub fraction_low: f64,
    /// Upper end of the 95 % interval of the fraction.
    pub fraction_high: f64,
}

/// Begin or end of an attractor.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Transition {
    /// First value at which the attractor exists, or is missing, SI.
    pub parameter: f64,
    /// Id of the attractor that the integration over the step comes from or ends on; `None` if it
    /// was not found there.
    pub other: Option<String>,
}

/// Attractor followed over the values of the key.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AttractorTrack {
    /// Drive cycles of the period and a letter by first appearance: `1a`, `2a`; `chaos-a`.
    pub id: String,
    /// Kind of the attractor.
    pub motion: AttractorKind,
    /// Drive cycles of the period, 0 for an aperiodic motion.
    pub period_cycles: u32,
    /// Transition where it begins; `None` where it exists at the first value.
    pub born: Option<Transition>,
    /// Transition where it ends; `None` where it exists at the last value.
    pub died: Option<Transition>,
    /// Points at which it was found.
    pub seen: Vec<TrackPoint>,
}

impl AttractorTrack {
    /// Returns an id that is not in use yet.
    pub(super) fn name(known: &[AttractorTrack], of: &DiagramPoint) -> String {
        let is_same_kind = |known: &&AttractorTrack| {
            known.motion == of.motion && known.period_cycles == of.period_cycles
        };
        let letters = crate::basins::letters(known.iter().filter(is_same_kind).count());
        match of.motion {
            AttractorKind::Orbit => format!("{}{letters}", of.period_cycles),
            other => format!("{}-{letters}", other.name()),
        }
    }
}
