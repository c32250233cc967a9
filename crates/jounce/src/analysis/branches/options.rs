//! Options of a search for branches.

use super::events::QuantityLevel;
use crate::continuation::StepControl;

/// Budget by default, drive cycles: some thirteen times what the harvester of the paper needs over its whole range.
const DEFAULT_BUDGET_CYCLES: usize = 10_000;

/// How branches are followed, beside what a search needs in any case.
#[derive(Debug, Clone, PartialEq)]
pub struct BranchOptions {
    /// Largest step along a branch, in the metric of continuation: a relative change of the state, or 1/20 of the range of the key.
    pub largest_step: f64,
    /// Work that following may cost: drive cycles of all orbits on the branches. What is left then is counted, not followed.
    pub budget: usize,
    /// Levels of quantities that are labelled where a branch passes them.
    pub levels: Vec<QuantityLevel>,
}

impl Default for BranchOptions {
    fn default() -> Self {
        Self {
            largest_step: StepControl::default().longest,
            budget: DEFAULT_BUDGET_CYCLES,
            levels: Vec::new(),
        }
    }
}
