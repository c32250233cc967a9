//! Origin of a draft, and what of it is known to be missing.

use super::response_result::ResponseBranch;
use serde::Serialize;

/// Largest error of a line that is drawn: a hundredth of the range, or 5 % of the power.
const MAX_LINE_ERROR: f64 = 0.01;

/// Draft of a response, computed without a search.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Draft {
    /// How the branches were found.
    pub origin: DraftOrigin,
    /// Share of the points of the last searched response that were lost since.
    pub lost_share: f64,
    /// Largest distance of a drawn line from its curve, in the range and a fifth of the
    /// logarithm of the power. Lines with a larger [`line_error`] are not drawn. `None` where no
    /// line is drawn.
    ///
    /// [`line_error`]: super::ResponseBranch::line_error
    pub error: Option<f64>,
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
            error: None,
        }
    }

    /// Returns the draft of branches that were continued.
    pub(super) fn continued(origin: DraftOrigin) -> Self {
        Self {
            origin,
            lost_share: 0.0,
            error: None,
        }
    }

    /// Returns the draft with the largest error of the lines that are drawn.
    pub(super) fn with_lines(self, branches: &[ResponseBranch]) -> Self {
        let lines = branches.iter().flat_map(|branch| &branch.line_error);
        let drawn = lines.copied().filter(|error| *error <= MAX_LINE_ERROR);
        Self {
            error: drawn.max_by(f64::total_cmp),
            ..self
        }
    }
}
