//! Search for the largest power of an orbit, in rounds of places that fill the space.
//!
//! At each place a few starts lead to an orbit, which is refined. After each stage of a refinement,
//! more starts are integrated, and all of them where the result may be the best design so far. The
//! search ends when several refinements have led to as much power as the best design has: if as many
//! starts as those of this optimum lead to a better one, it is unlikely that none has been seen. Each
//! combination of choices is a search of its own, which must have found its own optimum as often.
//!
//! Where refinements lead to more power than any design has with its starts, the starts decide and not
//! the orbits. Then a differential evolution of the goal has as many evaluations as the refinements.
//!
//! Source of the method: A. H. G. Rinnooy Kan, G. T. Timmer, Math. Program. 39 (1987) 27, multistart.

use super::evolution::Evolution;
use super::found::{Budget, Found, evaluated};
use super::refine::{Refined, refine};
use super::sampling::Places;
use super::{BATCH, Candidate, GAIN, ROUND, rounds};
use crate::evaluation::{Effort, Evaluator, SCREENING_STARTS};
use crate::problem::{Goal, Limit, LimitedQuantity, Problem};
use crate::{DesignError, Evaluation};
use jounce_analysis::wilson;
use rayon::prelude::*;

/// Refinements that lead to the best power of a combination of choices, after which its search ends: another
/// optimum to which as many starts lead has been missed with a probability of 2^-5.
const ENOUGH: usize = 5;

/// Places after which a search may end: with an orbit, and where none has one.
const LEAST_PLACES: usize = ROUND;
const LEAST_WITHOUT_ORBIT: usize = 2 * ROUND;

/// Places of the first round; each further one doubles their number, up to a full [`ROUND`].
const FIRST_ROUND: usize = 4;

/// Expected power of the best design, relative to the power to which refinements lead, below which an
/// evolution of the goal follows.
const MEASURE: f64 = 0.9;

/// Relative difference of power below which two optima are the same.
const SAME_POWER: f64 = 1e-2;

/// Distance in the unit cube below which two designs of the same power are the same: along a ridge of
/// the power the share of the starts changes.
const SAME_PLACE: f64 = 0.02;

/// Part of the way from a design to its refined one to which a limit is approached.
const FINEST: f64 = 1.0 / 16.0;

/// End of a refinement.
struct Reached {
    /// Combination of choices.
    variant: usize,
    /// Power, W, or the negative of the violation.
    value: f64,
}

/// Search from many starts.
struct Multistart<'s, 'e> {
    evaluator: &'s Evaluator<'e>,
    budget: &'s Budget<'s>,
    evolution: &'s mut Evolution<'e>,
    found: &'s mut Found,
    reached: Vec<Reached>,
    /// Refined designs of this round that were evaluated.
    seen: Vec<Refined>,
}

/// Searches on from the first design.
pub fn search<'e>(
    evaluator: &Evaluator<'e>,
    budget: &Budget<'_>,
    evolution: &mut Evolution<'e>,
    found: &mut Found,
) -> Result<(), DesignError> {
    let problem = evaluator.problem;
    let mut places = Places::new(problem.free.len(), problem.seed);
    let mut search = Multistart {
        evaluator,
        budget,
        evolution,
        found,
        reached: Vec::new(),
        seen: Vec::new(),
    };
    let mut starts = search.found.full.clone();
    let mut count = 0;
    while !search.is_enough(count) {
        let round = places.take(count.clamp(FIRST_ROUND, ROUND));
        count += round.len();
        if !search.probed(round, &mut starts)? || !search.refined(&starts)? {
            return Ok(());
        }
        starts.clear();
    }
    match search.measures_goal() {
        true => Ok(()),
        false => rounds::search(evaluator, budget, search.evolution, search.found),
    }
}

impl Multistart<'_, '_> {
    /// Evaluates places with two starts, and orders all starts of refinements from the best one on;
    /// false where the search ends.
    fn probed(
        &mut self,
        places: Vec<Vec<f64>>,
        starts: &mut Vec<Candidate>,
    ) -> Result<bool, DesignError> {
        let count = places.len();
        if self.found.ends(self.evaluator, self.budget, count) {
            return Ok(false);
        }
        self.evaluator.add(count);
        let probed = evaluated(self.evaluator, places, Effort::Probe)?;
        let mut failures = probed.iter().map(|one| &one.evaluation.failure);
        if let (None, Some(Some(reason))) =
            (&self.found.failure, failures.find(|one| one.is_some()))
        {
            self.found.failure = Some(reason.clone());
        }
        starts.extend(probed);
        starts.sort_by(Candidate::rank);
        Ok(true)
    }

    /// Refines designs, and evaluates the best ones; false where the search ends.
    fn refined(&mut self, starts: &[Candidate]) -> Result<bool, DesignError> {
        let problem = self.evaluator.problem;
        self.seen.clear();
        let mut largest: Option<(Candidate, Refined)> = None;
        for batch in starts.chunks(BATCH) {
            let pair = |start: &Candidate| {
                let stages = refine(self.evaluator, start);
                stages.unwrap_or_else(|| vec![Refined::at(start)])
            };
            let refined: Vec<Vec<Refined>> = batch.par_iter().map(pair).collect();
            for (start, stages) in batch.iter().zip(refined) {
                let mut designs = 0;
                for stage in &stages {
                    let step = stage.designs - designs;
                    if self.found.ends(self.evaluator, self.budget, step) {
                        return Ok(false);
                    }
                    self.evaluator.add(step);
                    designs = stage.designs;
                    if !self.evaluated(start, stage)? {
                        return Ok(false);
                    }
                }
                let last = stages.last().filter(|last| last.designs > 0);
                let is_larger = |last: &&Refined| {
                    let largest = largest.as_ref();
                    largest.is_none_or(|(_, largest)| value(last) > value(largest))
                };
                if let Some(last) = last.filter(is_larger) {
                    largest = Some((start.clone(), last.clone()));
                }
                self.reached.extend(last.map(|last| Reached {
                    variant: problem.variant(&start.place),
                    value: value(last),
                }));
                if !self.evolved()? {
                    return Ok(false);
                }
            }
        }
        // At the end of a round the smallest gain counts.
        match largest {
            Some((start, last)) if !is_beaten(self.found, &last, 0.0) => {
                self.on_the_way(&start, &last)
            }
            _ => Ok(true),
        }
    }

    /// Lets the evolution have as many evaluations as the refinements where these do not measure the
    /// goal; false where the search ends.
    fn evolved(&mut self) -> Result<bool, DesignError> {
        while !self.measures_goal()
            && 2 * self.evolution.used < self.evaluator.count()
            && !self.evolution.has_converged()
        {
            if self.found.ends(self.evaluator, self.budget, 1)
                || !self.evolution.advance(self.budget, self.found)?
            {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// True where the best design has nearly the largest power to which a refinement within the limits
    /// has led: it has not where other attractors have a large share of the starts.
    fn measures_goal(&self) -> bool {
        let best = self.found.best.as_ref().map(|best| &best.evaluation);
        let orbit_w = best.and_then(|best| Some(best.orbit.as_ref()?.mean_power_w));
        let powers = self.reached.iter().map(|one| one.value).chain(orbit_w);
        let largest_w = powers.fold(0.0, f64::max);
        best.is_some_and(|best| best.is_feasible() && best.goals[0] >= MEASURE * largest_w)
    }

    /// True where, with each combination of choices, enough refinements have led to as much as its
    /// best design has. Where the power of the orbit is the goal, one that led to more than the best
    /// design of all was beyond a limit that it does not see, and says nothing of designs within all
    /// limits.
    fn is_enough(&self, places: usize) -> bool {
        let problem = self.evaluator.problem;
        let Some(best) = self.found.best.as_ref() else {
            return false;
        };
        let own = problem.variant(&best.place);
        let is_known = |variant| {
            let values = self.reached.iter().filter(|one| one.variant == variant);
            let values: Vec<f64> = values.map(|one| one.value).collect();
            let [low, high] = match variant == own {
                true => range_of_best(problem, best),
                false => {
                    let largest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                    [largest - SAME_POWER * largest.abs(), largest]
                }
            };
            let near = values.iter().filter(|value| (low..=high).contains(*value));
            near.count() >= ENOUGH || (values.is_empty() && places >= LEAST_WITHOUT_ORBIT)
        };
        places >= LEAST_PLACES && (0..problem.variant_count()).all(is_known)
    }

    /// Evaluates a refined design with all starts unless the best one is as good; of those with the
    /// same power at the same place, one. False where the search ends.
    fn evaluated(&mut self, start: &Candidate, refined: &Refined) -> Result<bool, DesignError> {
        let is_seen = || self.seen.iter().any(|one| is_same(one, refined));
        if is_beaten(self.found, refined, GAIN) || is_seen() {
            return Ok(true);
        }
        self.seen.push(refined.clone());
        self.on_the_way(start, refined)
    }

    /// Evaluates a refined design with all starts or, where it is beyond a limit that a refinement
    /// does not see, designs on the way to it: the nearest within the limits to a [`FINEST`] part of
    /// the way.
    fn on_the_way(&mut self, start: &Candidate, refined: &Refined) -> Result<bool, DesignError> {
        let problem = self.evaluator.problem;
        let at = |part: f64| -> Vec<f64> {
            let pairs = start.place.iter().zip(&refined.place);
            pairs.map(|(a, b)| (1.0 - part) * a + part * b).collect()
        };
        let deserves = |found: &Found, few: &Candidate| {
            can_be_better(problem, &few.evaluation, found.best.as_ref())
        };
        let (mut part, mut step) = (1.0, 0.5);
        loop {
            let place = at(part);
            if self.found.has(&place) {
                return Ok(true);
            }
            let evaluation = self.evaluator.evaluate(&place, Effort::Screening)?;
            let few = Candidate { place, evaluation };
            let taken = self
                .found
                .take(self.evaluator, self.budget, few, deserves)?;
            let Some(design) = taken else {
                return Ok(false);
            };
            let is_kept = design.evaluation.is_feasible() && self.found.has(&design.place);
            // Beyond the limits everywhere on the way, the refined design is the best of it.
            let ends = refined.violation > 0.0 || refined.designs == 0 || step < FINEST;
            if ends || (is_kept && part == 1.0) {
                return Ok(true);
            }
            part += if is_kept { step } else { -step };
            step *= 0.5;
        }
    }
}

/// Returns the power of a refined design or, beyond its limits, the negative of the violation.
fn value(refined: &Refined) -> f64 {
    match refined.violation > 0.0 {
        true => -refined.violation,
        false => refined.mean_power_w,
    }
}

/// Returns the values of refinements that are those of the best design.
fn range_of_best(problem: &Problem, best: &Candidate) -> [f64; 2] {
    let evaluation = &best.evaluation;
    let goal = evaluation.goals[0];
    if !evaluation.is_feasible() {
        return [-evaluation.violation * (1.0 + SAME_POWER), f64::INFINITY];
    }
    let orbit_w = evaluation.orbit.as_ref().map(|orbit| orbit.mean_power_w);
    let is_measure =
        |orbit_w: &f64| problem.goals[0] != Goal::ExpectedPower || goal >= MEASURE * orbit_w;
    let high = orbit_w.filter(is_measure).unwrap_or(f64::INFINITY);
    [goal * (1.0 - SAME_POWER), high * (1.0 + SAME_POWER)]
}

/// True where two refined designs are the same.
fn is_same(a: &Refined, b: &Refined) -> bool {
    (value(a) - value(b)).abs() <= SAME_POWER * value(b).abs()
        && jounce_linalg::distance(&a.place, &b.place) < SAME_PLACE
}

/// True where a refined design is no better than the best one, by a relative gain.
fn is_beaten(found: &Found, refined: &Refined, gain: f64) -> bool {
    let best = found.best.as_ref().map(|best| &best.evaluation);
    best.is_some_and(|best| {
        let gains = refined.mean_power_w > best.goals[0] * (1.0 + gain);
        best.is_feasible() && (refined.violation > 0.0 || !gains)
    })
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
        LimitedQuantity::MeanPower => limit.violation(few.expected_power_w[2]) == 0.0,
        // Without an orbit yet, nothing is known.
        _ => value.is_nan() || limit.violation(*value) == 0.0,
    };
    let is_above =
        problem.goals[0] != Goal::ExpectedPower || few.expected_power_w[2] > best.goals[0];
    !best.is_feasible() || (is_above && problem.limits.iter().zip(&few.limits).all(is_kept))
}
