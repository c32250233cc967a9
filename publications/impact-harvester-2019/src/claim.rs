//! Claims of the paper with their verdicts.

use serde::Serialize;

/// Claim of the paper, with verdict and evidence.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Claim {
    /// The claim in one sentence, with its number in the literature notes (`S2` to `S9`).
    pub claim: String,
    /// True where the criterion in `evidence` is met.
    pub holds: bool,
    /// The criterion and the numbers for the verdict.
    pub evidence: String,
}

impl Claim {
    pub(super) fn new(claim: &str, holds: bool, evidence: String) -> Self {
        Self {
            claim: claim.to_owned(),
            holds,
            evidence,
        }
    }
}
