//! Options of a search for branches.

use super::events::QuantityLevel;
use super::warm_start::KnownOrbit;
use jounce_continuation::StepControl;

/// Default budget, drive cycles: about thirteen times the need of the harvester of the paper over
/// its full range.
const DEFAULT_BUDGET_CYCLES: usize = 10_000;

/// Options of the continuation of branches, in addition to those of every search.
#[derive(Debug, Clone, PartialEq)]
pub struct BranchOptions {
    /// Largest step along a branch, in the metric of continuation: a relative change of the state,
    /// or 1/20 of the range of the key.
    pub largest_step: f64,
    /// Budget in drive cycles of all orbits on the branches. Further branches are counted, not
    /// followed.
    pub budget: usize,
    /// Levels of quantities that are labelled where a branch crosses them.
    pub levels: Vec<QuantityLevel>,
    /// Orbits of a neighbouring model, in addition to those on which integrations settle.
    pub known_orbits: Vec<KnownOrbit>,
}

impl Default for BranchOptions {
    fn default() -> Self {
        Self {
            largest_step: StepControl::default().longest,
            budget: DEFAULT_BUDGET_CYCLES,
            levels: Vec::new(),
            known_orbits: Vec::new(),
        }
    }
}
