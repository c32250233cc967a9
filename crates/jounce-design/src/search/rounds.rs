//! Search with one goal: rounds of places that fill the space, each followed by the refinement of
//! the best of them. The search ends when two rounds in a row have found nothing better.

use super::evolution::{self, Population};
use super::refine::{Refined, refine};
use super::sampling::Places;
use super::{Budget, Candidate, Found};
use crate::DesignError;
use crate::evaluation::{Effort, Evaluator};
use crate::result::{SearchEnd, TracePoint};
use rayon::prelude::*;

/// Places of a round.
const ROUND: usize = 32;

/// Designs of a round that are refined.
const REFINED: usize = 4;

/// Rounds without a better design after which the search ends.
const LAST_ROUNDS: usize = 2;

/// Relative gain of the goal below which a design is no better.
const GAIN: f64 = 1e-3;

/// Distance in the unit cube below which two designs are the same.
const SAME_PLACE: f64 = 1e-3;

/// Parts of the way from a screened to a refined design at which all starts are integrated, where
/// fewer starts reach the refined one.
const PARTS: [f64; 4] = [0.25, 0.5, 0.75, 0.9];

/// Searches for the best design.
pub fn search(evaluator: &Evaluator<'_>, budget: &Budget<'_>) -> Result<Found, DesignError> {
    let problem = evaluator.problem;
    let mut places = Places::new(problem.free.len(), problem.seed);
    let mut found = Found::nothing();
    let (mut without_gain, mut population) = (0, Vec::new());
    while without_gain < LAST_ROUNDS {
        if let Some(end) = budget.end(evaluator.count()) {
            found.end = end;
            break;
        }
        let left = problem.evaluations.saturating_sub(evaluator.count());
        let mut round = places.take(ROUND.min(left));
        if found.full.is_empty() {
            round.extend(given(evaluator));
        }
        let mut screened = screened(evaluator, round)?;
        screened.sort_by(Candidate::rank);
        let before = found.best.clone();
        if problem.follows_orbit() {
            refined(evaluator, &screened, &mut found)?;
        } else {
            population.append(&mut screened);
            evolved(evaluator, budget, &mut population, &mut found)?;
        }
        match has_gained(before.as_ref(), found.best.as_ref()) {
            true => without_gain = 0,
            false => without_gain += 1,
        }
    }
    Ok(found)
}

/// Returns the place of the spec as given, if it is within all ranges.
fn given(evaluator: &Evaluator<'_>) -> Option<Vec<f64>> {
    let problem = evaluator.problem;
    let places = problem.free.iter().map(|free| free.place(&problem.spec));
    places.collect()
}

/// Evaluates places with a few starts.
pub fn screened(
    evaluator: &Evaluator<'_>,
    places: Vec<Vec<f64>>,
) -> Result<Vec<Candidate>, DesignError> {
    let screen = |place: Vec<f64>| {
        let evaluation = evaluator.evaluate(&place, Effort::Screening)?;
        Ok(Candidate { place, evaluation })
    };
    places.into_par_iter().map(screen).collect()
}

/// Refines the best of some screened designs.
fn refined(
    evaluator: &Evaluator<'_>,
    screened: &[Candidate],
    found: &mut Found,
) -> Result<(), DesignError> {
    let starts = &screened[..REFINED.min(screened.len())];
    let refined: Vec<_> = starts
        .par_iter()
        .map(|start| refine(evaluator, start))
        .collect();
    for (start, refined) in starts.iter().zip(refined) {
        let Refined {
            place,
            mean_power_w,
            designs,
        } = refined.unwrap_or_else(|| Refined {
            place: start.place.clone(),
            mean_power_w: f64::INFINITY,
            designs: 0,
        });
        evaluator.add(designs);
        // An orbit with less power than the best design is not worth the integration of all starts.
        let best = found.best.as_ref().map(|best| &best.evaluation);
        let is_beaten = |mean_power_w: f64| {
            best.is_some_and(|best| best.is_feasible() && mean_power_w <= best.goals[0])
        };
        if is_beaten(mean_power_w) {
            continue;
        }
        let is_known = |one: &Candidate| jounce_linalg::distance(&one.place, &place) < SAME_PLACE;
        if found.full.iter().any(is_known) || evaluator.control.is_stopped() {
            continue;
        }
        let end = keep(evaluator, place, found)?;
        let shares = [&start.evaluation, &end.evaluation].map(|one| one.basin_fraction[0]);
        if shares[1] < shares[0] {
            let at = |part: f64| {
                let pairs = start.place.iter().zip(&end.place);
                pairs.map(|(a, b)| a + part * (b - a)).collect::<Vec<f64>>()
            };
            for part in PARTS {
                keep(evaluator, at(part), found)?;
            }
        }
    }
    Ok(())
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
    while !evolution.has_converged() && budget.end(evaluator.count()).is_none() {
        let trials = screened(evaluator, evolution.trials())?;
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
        if !found.full.iter().any(|one| one.place == place) && !evaluator.control.is_stopped() {
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
            found.trace.push(TracePoint {
                evaluation: evaluator.count(),
                goal: candidate.evaluation.goals[0],
                violation: candidate.evaluation.violation,
            });
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
