//! A claim of the paper with its verdict.

use serde::Serialize;

/// What the paper says, whether our numbers agree, and the numbers.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Claim {
    /// The claim, in a sentence, with its number in the literature notes (`S2` to `S9`).
    pub claim: String,
    /// Whether the criterion that `evidence` names is met.
    pub holds: bool,
    /// The criterion and the numbers it was judged on.
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
