//! Search with one goal that is not the power of one orbit: rounds of places that fill the space, each
//! followed by a differential evolution of all places so far. The search ends when two rounds in a
//! row have found nothing better.

use super::evolution::Evolution;
use super::found::{Budget, Found};
use super::{Candidate, GAIN, exceeds};
use crate::DesignError;
use crate::evaluation::Evaluator;

/// Rounds without a better design after which the search ends.
const LAST_ROUNDS: usize = 2;

/// Searches for a better design than what has been found.
pub fn search(
    evaluator: &Evaluator<'_>,
    budget: &Budget<'_>,
    evolution: &mut Evolution<'_>,
    found: &mut Found,
) -> Result<(), DesignError> {
    let mut without_gain = 0;
    while without_gain < LAST_ROUNDS {
        let before = found.best.clone();
        while !evolution.has_converged() {
            if found.ends(evaluator, budget, 1) || !evolution.advance(budget, found)? {
                return Ok(());
            }
        }
        match has_gained(before.as_ref(), found.best.as_ref()) {
            true => without_gain = 0,
            false => without_gain += 1,
        }
        evolution.begin_round();
    }
    Ok(())
}

/// True where the best design has changed by more than the resolution of the search.
fn has_gained(before: Option<&Candidate>, after: Option<&Candidate>) -> bool {
    let (Some(before), Some(after)) = (before, after) else {
        return after.is_some();
    };
    let (a, b) = (&before.evaluation, &after.evaluation);
    match a.is_feasible() {
        true => exceeds(b.goals[0], a.goals[0], GAIN),
        false => b.violation < a.violation * (1.0 - GAIN),
    }
}
