//! Origin of a draft, and what of it is known to be missing.

use serde::Serialize;

/// Draft of a response, computed without a search.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Draft {
    /// How the branches were found.
    pub origin: DraftOrigin,
    /// Share of the points of the last searched response that were lost since.
    pub lost_share: f64,
}

/// How the branches of a draft were found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum DraftOrigin {
    /// Each point of the previous response was corrected.
    Updated,
    /// Continuation from some orbits of the previous response.
    Continued,
    /// Continuation from the orbits on which an integration settles at both ends of the range.
    Settled,
}

impl Draft {
    /// Returns the draft after an update of an earlier response that has lost a share of its
    /// points.
    pub(super) fn updated(previous: Option<Self>, lost_share: f64) -> Self {
        let kept = (1.0 - previous.map_or(0.0, |draft| draft.lost_share)) * (1.0 - lost_share);
        Self {
            origin: DraftOrigin::Updated,
            lost_share: 1.0 - kept,
        }
    }

    /// Returns the draft of branches that were continued.
    pub(super) fn continued(origin: DraftOrigin) -> Self {
        Self {
            origin,
            lost_share: 0.0,
        }
    }
}
