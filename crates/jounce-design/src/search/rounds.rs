//! Search with one goal that is not the power of one orbit: rounds of places that fill the space, each
//! followed by a differential evolution of all places so far. The search ends when two rounds in a
//! row have found nothing better.

use super::evolution::{self, Population};
use super::sampling::Places;
use super::{Budget, Candidate, Found, GAIN, ROUND};
use crate::DesignError;
use crate::evaluation::{Effort, Evaluator};
use crate::examination::improvement;
use crate::result::{SearchEnd, TracePoint};
use rayon::prelude::*;

/// Rounds without a better design after which the search ends.
const LAST_ROUNDS: usize = 2;

/// Searches for a better design than what has been found.
pub fn search(
    evaluator: &Evaluator<'_>,
    budget: &Budget<'_>,
    mut found: Found,
) -> Result<Found, DesignError> {
    let mut places = Places::new(evaluator.problem.free.len(), evaluator.problem.seed);
    let (mut without_gain, mut population) = (0, found.full.clone());
    while without_gain < LAST_ROUNDS {
        let is_first = found.best.is_none();
        let needed = if is_first { 1 } else { 1 + evolution::BEST };
        if let Some(end) = budget.end(evaluator.count(), needed) {
            found.end = end;
            break;
        }
        let round = next_round(evaluator, budget, &mut places, is_first);
        population.extend(screened(evaluator, round, Effort::Screening)?);
        let before = found.best.clone();
        evolved(evaluator, budget, &mut population, &mut found)?;
        match has_gained(before.as_ref(), found.best.as_ref()) {
            true => without_gain = 0,
            false => without_gain += 1,
        }
    }
    Ok(found)
}

/// Returns the places of the next round, which takes half of the evaluations that are left at most;
/// the first one has the spec as given.
pub fn next_round(
    evaluator: &Evaluator<'_>,
    budget: &Budget<'_>,
    places: &mut Places,
    is_first: bool,
) -> Vec<Vec<f64>> {
    let given = is_first.then(|| evaluator.problem.given()).flatten();
    let left = budget.left(evaluator.count());
    let mut round = places.take(ROUND.min(left.saturating_sub(1).div_ceil(2)));
    round.extend(given);
    round
}

/// Evaluates places with few starts.
pub fn screened(
    evaluator: &Evaluator<'_>,
    places: Vec<Vec<f64>>,
    effort: Effort,
) -> Result<Vec<Candidate>, DesignError> {
    let screen = |place: Vec<f64>| {
        let evaluation = evaluator.evaluate(&place, effort)?;
        Ok(Candidate { place, evaluation })
    };
    places.into_par_iter().map(screen).collect()
}

/// Improves a population by differential evolution, and evaluates its best with all starts.
fn evolved(
    evaluator: &Evaluator<'_>,
    budget: &Budget<'_>,
    population: &mut Vec<Candidate>,
    found: &mut Found,
) -> Result<(), DesignError> {
    let members = std::mem::take(population);
    let mut evolution = Population::new(members, evaluator.problem);
    while !evolution.has_converged()
        && budget
            .end(evaluator.count(), evolution.size() + evolution::BEST)
            .is_none()
    {
        let trials = screened(evaluator, evolution.trials(), Effort::Screening)?;
        evolution.replace(trials);
    }
    *population = evolution.into_members();
    population.sort_by(Candidate::rank);
    let best: Vec<Vec<f64>> = population
        .iter()
        .take(evolution::BEST)
        .map(|one| one.place.clone())
        .collect();
    for place in best {
        let needed = usize::from(found.best.is_some());
        if !found.full.iter().any(|one| one.place == place)
            && budget.end(evaluator.count(), needed).is_none()
        {
            keep(evaluator, place, found)?;
        }
    }
    Ok(())
}

/// Evaluates a design with all starts, and keeps it.
pub fn keep(
    evaluator: &Evaluator<'_>,
    place: Vec<f64>,
    found: &mut Found,
) -> Result<Candidate, DesignError> {
    let evaluation = evaluator.evaluate(&place, Effort::Full)?;
    let candidate = Candidate { place, evaluation };
    let stopped = evaluator.control.is_stopped();
    if stopped {
        found.end = SearchEnd::Stopped;
    } else if let Some(reason) = &candidate.evaluation.failure {
        found.failure.get_or_insert_with(|| reason.clone());
    } else {
        if candidate.is_better(found.best.as_ref()) {
            let point = TracePoint {
                evaluation: evaluator.count(),
                goal: candidate.evaluation.goals[0],
                violation: candidate.evaluation.violation,
            };
            found.trace.push(point);
            if let Some(improved) = evaluator.improved {
                improved(&improvement(evaluator.problem, &candidate, point));
            }
            found.best = Some(candidate.clone());
        }
        found.full.push(candidate.clone());
    }
    Ok(candidate)
}

/// True where the best design has changed by more than the resolution of the search.
fn has_gained(before: Option<&Candidate>, after: Option<&Candidate>) -> bool {
    let (Some(before), Some(after)) = (before, after) else {
        return after.is_some();
    };
    let (a, b) = (&before.evaluation, &after.evaluation);
    match a.is_feasible() {
        true => b.goals[0] > a.goals[0] * (1.0 + GAIN),
        false => b.violation < a.violation * (1.0 - GAIN),
    }
}
