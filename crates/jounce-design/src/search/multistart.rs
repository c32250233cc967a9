//! Search for the largest power of an orbit, in rounds of places that fill the space.
//!
//! At each place a few starts lead to an orbit, which is refined. From the largest refined power on,
//! more starts are integrated, and all of them where the result may be the best design so far. The
//! search ends when several refinements have led to as much power as the best design has: if as many
//! starts as those of this optimum lead to a better one, it is unlikely that none has been seen. Each
//! combination of choices is a search of its own, which must have found its own optimum as often. Where
//! the expected power of the best design is far below the power of its orbit, a differential
//! evolution of the expected power follows.
//!
//! Source of the method: A. H. G. Rinnooy Kan, G. T. Timmer, Math. Program. 39 (1987) 27, multistart.

use super::refine::{MAX_FOLLOWED, Refined, refine};
use super::rounds::{self, keep, next_round, screened};
use super::sampling::Places;
use super::{Budget, Candidate, Found, GAIN};
use crate::evaluation::{Effort, Evaluator, SCREENING_STARTS};
use crate::problem::{Goal, Limit, LimitedQuantity, Problem};
use crate::{DesignError, Evaluation};
use jounce_analysis::wilson;
use rayon::prelude::*;

/// Refinements that lead to the best power of a combination of choices, after which its search ends: another
/// optimum to which as many starts lead has been missed with a probability of 2^-5.
const ENOUGH: usize = 5;

/// Rounds without an orbit after which the search ends.
const LAST_ROUNDS: usize = 2;

/// Designs that are refined before the best of them are evaluated with all starts.
const BATCH: usize = 8;

/// Evaluations that follow refinements: with few and with all starts, and of the spec as given.
const FOLLOWING: usize = 3;

/// Followed designs of a refinement, on average, below which fewer designs are refined.
const LEAST_FOLLOWED: usize = 10;

/// Expected power of the best design, relative to the power of its main orbit, below which an
/// evolution of the expected power follows.
const MEASURE: f64 = 0.9;

/// Relative difference of power below which two optima are the same.
const SAME_POWER: f64 = 1e-2;

/// Distance in the unit cube below which two designs of the same power are the same: along a ridge of
/// the power the share of the starts changes.
const SAME_PLACE: f64 = 0.02;

/// Part of the way from a design to its refined one to which a limit is approached.
const FINEST: f64 = 1.0 / 16.0;

/// A design with its refinement.
type Pair = (Candidate, Refined);

/// End of a refinement.
struct Reached {
    /// Combination of choices.
    variant: usize,
    /// Power, W, or the negative of the violation.
    value: f64,
}

/// Searches for the best design.
pub fn search(evaluator: &Evaluator<'_>, budget: &Budget<'_>) -> Result<Found, DesignError> {
    let mut places = Places::new(evaluator.problem.free.len(), evaluator.problem.seed);
    let mut found = Found::nothing();
    let (problem, mut powers, mut rounds) = (evaluator.problem, Vec::new(), 0);
    while !is_enough(problem, &powers, found.best.as_ref(), rounds) {
        let needed = if rounds == 0 { 1 } else { 2 };
        if let Some(end) = budget.end(evaluator.count(), needed) {
            found.end = end;
            break;
        }
        let round = next_round(evaluator, budget, &mut places, rounds == 0);
        let mut few = screened(evaluator, round, Effort::Probe)?;
        few.sort_by(Candidate::rank);
        if found.failure.is_none() {
            found.failure = few.iter().find_map(|one| one.evaluation.failure.clone());
        }
        let (first, rest) = few.split_at(BATCH.min(few.len()));
        let mut follow = |batch: &[Candidate], found: &mut Found| {
            let pairs = refined(evaluator, budget, batch);
            let searches = pairs.iter().filter(|(_, refined)| refined.designs > 0);
            powers.extend(searches.map(|(start, refined)| Reached {
                variant: problem.variant(&start.place),
                value: value(refined),
            }));
            evaluated(evaluator, budget, &pairs, found)
        };
        follow(first, &mut found)?;
        let is_due = rounds == 0 && (found.best.is_none() || budget.left(evaluator.count()) > 0);
        if let (true, Some(place)) = (is_due, evaluator.problem.given()) {
            keep(evaluator, place, &mut found)?;
        }
        for batch in rest.chunks(BATCH) {
            follow(batch, &mut found)?;
        }
        rounds += 1;
    }
    match measures_goal(evaluator.problem, found.best.as_ref()) {
        true => Ok(found),
        false => rounds::search(evaluator, budget, found),
    }
}

/// True where the power of the main orbit is nearly the goal: it is not where other attractors have
/// a large share of the starts.
fn measures_goal(problem: &Problem, best: Option<&Candidate>) -> bool {
    let evaluation = best.map(|best| &best.evaluation);
    let pair = evaluation.and_then(|one| Some((one.goals[0], one.orbit.as_ref()?.mean_power_w)));
    problem.goals[0] != Goal::ExpectedPower
        || pair.is_none_or(|(goal_w, orbit_w)| goal_w >= MEASURE * orbit_w)
}

/// Returns the power of a refined design or, beyond its limits, the negative of the violation.
fn value(refined: &Refined) -> f64 {
    match refined.violation > 0.0 {
        true => -refined.violation,
        false => refined.mean_power_w,
    }
}

/// True where, with each combination of choices, enough refinements have led to as much as its best
/// design has. Where the power of the orbit is the goal, one that led to more than the best design of
/// all was beyond a limit that it does not see, and says nothing of designs within all limits.
fn is_enough(
    problem: &Problem,
    reached: &[Reached],
    best: Option<&Candidate>,
    rounds: usize,
) -> bool {
    let Some(best) = best else {
        return false;
    };
    let own = problem.variant(&best.place);
    (0..problem.variant_count()).all(|variant| {
        let values = reached.iter().filter(|one| one.variant == variant);
        let values: Vec<f64> = values.map(|one| one.value).collect();
        let [low, high] = match variant == own {
            true => range_of_best(problem, best),
            false => {
                let largest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                [largest - SAME_POWER * largest.abs(), largest]
            }
        };
        let near = values.iter().filter(|value| (low..=high).contains(*value));
        near.count() >= ENOUGH || (values.is_empty() && rounds >= LAST_ROUNDS)
    })
}

/// Returns the values of refinements that are those of the best design.
fn range_of_best(problem: &Problem, best: &Candidate) -> [f64; 2] {
    let evaluation = &best.evaluation;
    let low = match evaluation.is_feasible() {
        true => evaluation.goals[0] * (1.0 - SAME_POWER),
        false => -evaluation.violation * (1.0 + SAME_POWER),
    };
    let high = match evaluation.is_feasible() && measures_goal(problem, Some(best)) {
        true => evaluation.orbit.as_ref().map(|orbit| orbit.mean_power_w),
        false => None,
    };
    let high = high.map_or(f64::INFINITY, |power_w| power_w * (1.0 + SAME_POWER));
    [low, high]
}

/// Refines designs as far as the budget allows, and orders them from the largest power within the
/// limits on.
fn refined(evaluator: &Evaluator<'_>, budget: &Budget<'_>, batch: &[Candidate]) -> Vec<Pair> {
    let left = budget.left(evaluator.count()).saturating_sub(FOLLOWING);
    let open = BATCH.min(left.div_ceil(LEAST_FOLLOWED));
    let most = MAX_FOLLOWED.min(left / open.max(1));
    let pair = |(index, start): (usize, &Candidate)| {
        let refined = (index < open).then(|| refine(evaluator, start, most));
        let refined = refined.flatten().unwrap_or_else(|| Refined::at(start));
        (start.clone(), refined)
    };
    let mut pairs: Vec<Pair> = batch.par_iter().enumerate().map(pair).collect();
    for (_, refined) in &pairs {
        evaluator.add(refined.designs);
    }
    pairs.sort_by(|(_, a), (_, b)| value(b).total_cmp(&value(a)));
    pairs
}

/// Evaluates the best of the refined designs with all starts; of those with the same power at the same
/// place, one.
fn evaluated(
    evaluator: &Evaluator<'_>,
    budget: &Budget<'_>,
    pairs: &[Pair],
    found: &mut Found,
) -> Result<(), DesignError> {
    let mut seen: Vec<&Refined> = Vec::new();
    for (start, refined) in pairs {
        if is_beaten(found, refined) {
            break;
        }
        if !seen.iter().any(|one| is_same(one, refined)) {
            on_the_way(evaluator, budget, (start, refined), found)?;
            seen.push(refined);
        }
    }
    Ok(())
}

/// True where two refined designs are the same.
fn is_same(a: &Refined, b: &Refined) -> bool {
    (value(a) - value(b)).abs() <= SAME_POWER * value(b).abs()
        && jounce_linalg::distance(&a.place, &b.place) < SAME_PLACE
}

/// True where a refined design is no better than the best one.
fn is_beaten(found: &Found, refined: &Refined) -> bool {
    let best = found.best.as_ref().map(|best| &best.evaluation);
    best.is_some_and(|best| {
        let gains = refined.mean_power_w > best.goals[0] * (1.0 + GAIN);
        best.is_feasible() && (refined.violation > 0.0 || !gains)
    })
}

/// Evaluates a refined design with all starts or, where it is beyond a limit that a refinement does
/// not see, designs on the way to it: the nearest within the limits to a [`FINEST`] part of the way.
fn on_the_way(
    evaluator: &Evaluator<'_>,
    budget: &Budget<'_>,
    (start, refined): (&Candidate, &Refined),
    found: &mut Found,
) -> Result<(), DesignError> {
    let at = |part: f64| -> Vec<f64> {
        let pairs = start.place.iter().zip(&refined.place);
        pairs.map(|(a, b)| a + part * (b - a)).collect()
    };
    let (mut part, mut step) = (1.0, 0.5);
    loop {
        let place = at(part);
        let needed = if found.best.is_some() { 2 } else { 0 };
        if budget.end(evaluator.count(), needed).is_some()
            || found.full.iter().any(|one| one.place == place)
        {
            break;
        }
        let few = evaluator.evaluate(&place, Effort::Screening)?;
        let is_kept = can_be_better(evaluator.problem, &few, found.best.as_ref())
            && keep(evaluator, place, found)?.evaluation.is_feasible();
        // Beyond the limits everywhere on the way, the refined design is the best of it.
        let ends = refined.violation > 0.0 || refined.designs == 0 || step < FINEST;
        if ends || (is_kept && part == 1.0) {
            break;
        }
        part += if is_kept { step } else { -step };
        step *= 0.5;
    }
    Ok(())
}

/// True where the evaluation of a few starts does not exclude, at 95 %, that a design within its
/// limits is better than the best one.
fn can_be_better(problem: &Problem, few: &Evaluation, best: Option<&Candidate>) -> bool {
    let Some(best) = best.map(|best| &best.evaluation) else {
        return true;
    };
    let starts = SCREENING_STARTS.min(problem.starts);
    // A start that has not settled yet may still reach the main orbit.
    let possible = (few.basin_fraction[0] + few.unknown_share) * starts as f64;
    let possible = wilson((possible.round() as usize).min(starts), starts);
    let is_kept = |(limit, value): (&Limit, &f64)| match limit.quantity {
        LimitedQuantity::BasinFraction => limit.violation(possible.high) == 0.0,
        // Without an orbit yet, nothing is known.
        _ => value.is_nan() || limit.violation(*value) == 0.0,
    };
    let is_above =
        problem.goals[0] != Goal::ExpectedPower || few.expected_power_w[2] > best.goals[0];
    !best.is_feasible() || (is_above && problem.limits.iter().zip(&few.limits).all(is_kept))
}
