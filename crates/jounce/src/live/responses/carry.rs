//! Branches of a design from those of the previous one.

use super::draft::{Draft, DraftOrigin};
use super::shorter_period::without_shorter_periods;
use super::stored_response::{Origin, StoredResponse};
use crate::live::Design;
use jounce_analysis::{
    Branch, BranchUpdate, Extrapolation, KnownOrbit, Model, Parameter, WarmStart, settled_orbit,
};
use jounce_continuation::StepControl;
use std::sync::Arc;

/// Relative tolerance of the integration.
pub(super) const TOLERANCE: f64 = 1e-6;
/// Goal of Newton's method for settled orbits, relative to the state.
const SETTLED_CORRECTION_GOAL: f64 = 1e-6;
/// Relative corrections of updated points below this are omitted: curves are accurate to a
/// thousandth of their height.
const MIN_CORRECTION: f64 = 5e-4;
/// Largest deviation of the drawn curve due to omitted points, relative to its height.
const SIMPLIFY_SHARE: f64 = 1e-3;
/// Largest last step in the location of bifurcations, a two-hundredth of the range; the remaining
/// error is of second order in it.
const MAX_LAST_MOVE: f64 = 0.1;
/// Largest fraction of points that an update of branches may lose.
const MAX_LOST_SHARE: f64 = 0.3;

/// Long steps.
const LONG_STEPS: StepControl = StepControl {
    first: 0.1,
    longest: 1.2,
    shortest: 1e-6,
    turn: 0.45,
    stray: 0.25,
    most_evaluations: 6,
};

/// Branches of a design from those of the previous one.
pub(super) struct CarriedBranches {
    /// The branches.
    pub branches: Vec<Branch>,
    /// Design and branches from which these were updated, point by point.
    pub origin: Option<Origin>,
    /// How they were found.
    pub draft: Draft,
}

/// Problem of a draft.
pub(super) struct DraftProblem<'s> {
    pub design: &'s Design,
    pub base: &'s Model,
    pub parameter: &'s Parameter<'s>,
    pub range: (f64, f64),
    /// Longest period, in drive cycles.
    pub longest_period: u32,
}

impl DraftProblem<'_> {
    /// Returns the branches near those of the last response. They are updated point by point, or
    /// continued again if that loses points or the range has changed. Without known branches,
    /// continuation starts from settled orbits.
    pub(super) fn branches(&self, last: Option<Arc<StoredResponse>>) -> CarriedBranches {
        let (kernel, range) = (&self.base.kernel, self.range);
        if let Some(last) = last.as_ref().filter(|last| last.range == range)
            && let Some(carried) = self.updated(last)
        {
            return carried;
        }
        let warm_start = WarmStart {
            family: self.parameter,
            kernel,
            range,
            tolerance: TOLERANCE,
            control: LONG_STEPS,
            resolution: MAX_LAST_MOVE,
        };
        // Without branches the page draws no draft; the fine response follows, and reports its error.
        let from = |mut orbits: Vec<KnownOrbit>| {
            orbits.retain(|orbit| orbit.period_cycles <= self.longest_period);
            without_shorter_periods(warm_start.run(&orbits).unwrap_or_default())
        };
        let branches = last
            .map(|last| from(last.known_orbits.clone()))
            .unwrap_or_default();
        if !branches.is_empty() || kernel.control.is_stopped() {
            return CarriedBranches::continued(branches, DraftOrigin::Continued);
        }
        let branches = from(settled_orbits(self.parameter, self.base, range));
        CarriedBranches::continued(branches, DraftOrigin::Settled)
    }

    /// Returns the branches of the last response, updated point by point; `None` where too many
    /// points are lost.
    fn updated(&self, last: &StoredResponse) -> Option<CarriedBranches> {
        // A fine response has more points than a curve needs; an updated one retains its points, so
        // that their changes can be extrapolated.
        let is_shown = |branch: &&Branch| branch.period_cycles <= self.longest_period;
        let thinned = |branch: &Branch| branch.thinned(SIMPLIFY_SHARE);
        let known = match last.origin {
            Some(_) => Arc::clone(&last.branches),
            None => Arc::new(last.branches.iter().filter(is_shown).map(thinned).collect()),
        };
        let points: usize = known.iter().map(|branch| branch.points.len()).sum();
        if points == 0 {
            return None;
        }
        let trend = last.origin.as_ref().and_then(|(spec, branches)| {
            Some(Extrapolation {
                before: branches,
                reach: self.design.change_ratio(spec, &last.spec)?,
            })
        });
        let update = BranchUpdate {
            family: self.parameter,
            kernel: &self.base.kernel,
            range: last.range,
            tolerance: TOLERANCE,
            accuracy: MIN_CORRECTION,
            trend,
        };
        let updated = update.run(&known);
        let lost_share = updated.lost as f64 / points as f64;
        (lost_share <= MAX_LOST_SHARE).then(|| CarriedBranches {
            branches: without_shorter_periods(updated.branches),
            origin: Some((last.spec.clone(), known)),
            draft: Draft::updated(last.draft, lost_share),
        })
    }
}

impl CarriedBranches {
    fn continued(branches: Vec<Branch>, origin: DraftOrigin) -> Self {
        Self {
            branches,
            origin: None,
            draft: Draft::continued(origin),
        }
    }
}

/// Returns the orbits on which an integration from rest and from the steady state settles at both
/// ends of the range.
fn settled_orbits(family: &Parameter, base: &Model, range: (f64, f64)) -> Vec<KnownOrbit> {
    let plant = &base.kernel.plant;
    let rest = vec![0.0; plant.len()];
    let steady = plant.to_physical(&rest, 0.0);
    let (low, high) = range;
    let settle = |parameter: f64, start: &[f64]| {
        let orbit = settled_orbit(family, parameter, start, TOLERANCE, SETTLED_CORRECTION_GOAL)?;
        Some(KnownOrbit {
            period_cycles: orbit.period_cycles,
            state: orbit.start().to_vec(),
            parameter,
        })
    };
    let at_both_ends = |start: &[f64]| rayon::join(|| settle(low, start), || settle(high, start));
    let (first, second) = (at_both_ends(&steady), at_both_ends(&rest));
    [first.0, first.1, second.0, second.1]
        .into_iter()
        .flatten()
        .collect()
}
