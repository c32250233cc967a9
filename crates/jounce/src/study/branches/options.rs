//! Options of a search for branches.

use super::events::Level;
use crate::continuation::StepControl;

/// How branches are followed, beside what a search needs in any case.
#[derive(Debug, Clone, PartialEq)]
pub struct BranchOptions {
    /// Largest step along a branch, in the metric of continuation: a relative change of the state, or 1/20 of the range of the key.
    pub largest_step: f64,
    /// Levels of quantities that are labelled where a branch passes them.
    pub levels: Vec<Level>,
}

impl Default for BranchOptions {
    fn default() -> Self {
        Self { largest_step: StepControl::default().longest, levels: Vec::new() }
    }
}
