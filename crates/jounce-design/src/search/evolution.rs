//! Differential evolution: trials from differences of members.
//!
//! ```text
//! trial = a + F (best - a) + F (b - c),   some coordinates of it replace those of a
//! ```
//!
//! The members are the best of places that fill the space. What looks better than the best design
//! with few starts is evaluated with all of them before it enters, so that no lucky start guides the
//! evolution.
//!
//! Source: R. Storn, K. Price, J. Global Optim. 11 (1997) 341, variant current-to-best/1/bin.

use super::found::{Budget, Found, evaluated};
use super::sampling::Places;
use super::{BATCH, Candidate, ROUND};
use crate::DesignError;
use crate::evaluation::Evaluator;
use jounce_signal::RandomStream;

/// Weight of the differences, and probability of a coordinate to be replaced.
const WEIGHT: f64 = 0.6;
const CROSSOVER: f64 = 0.9;

/// Smallest number of members, and members per free key.
const LEAST_MEMBERS: usize = 12;
const MEMBERS_PER_KEY: usize = 5;

/// Largest distance between a member and the best one, in the unit cube, of a converged population.
const CONVERGED: f64 = 1e-3;

/// Evolution of the goal.
pub struct Evolution<'e> {
    evaluator: &'e Evaluator<'e>,
    places: Places,
    /// Places of the round that are still to be evaluated.
    open: usize,
    members: Vec<Candidate>,
    trials: usize,
    /// Number of its evaluations.
    pub used: usize,
}

impl<'e> Evolution<'e> {
    /// Starts with a round of places.
    pub fn new(evaluator: &'e Evaluator<'e>) -> Self {
        let problem = evaluator.problem;
        Self {
            evaluator,
            places: Places::new(problem.free.len(), problem.seed),
            open: ROUND,
            members: Vec::new(),
            trials: 0,
            used: 0,
        }
    }

    /// Adds a round of new places.
    pub fn begin_round(&mut self) {
        self.open = ROUND;
    }

    /// True where all members are at one place.
    pub fn has_converged(&self) -> bool {
        let best = self.members.iter().min_by(|a, b| a.rank(b));
        let is_near = |best: &Candidate| {
            let mut members = self.members.iter();
            members.all(|one| jounce_linalg::distance(&one.place, &best.place) < CONVERGED)
        };
        self.open == 0 && best.is_none_or(is_near)
    }

    /// Evaluates the next places or trials; false where the search ends.
    pub fn advance(&mut self, budget: &Budget<'_>, found: &mut Found) -> Result<bool, DesignError> {
        let is_round = self.open > 0;
        let mut places = match is_round {
            true => self.places.take(self.open.min(BATCH)),
            false => self.trials(found),
        };
        let before = self.evaluator.count();
        // Those that the budget would cut need no evaluation.
        places.truncate(budget.left(before).max(1));
        let count = places.len();
        let effort = self.evaluator.problem.screening();
        let screened = evaluated(self.evaluator, places, effort)?;
        for (index, candidate) in screened.into_iter().enumerate() {
            let is_better =
                |found: &Found, candidate: &Candidate| candidate.is_better(found.best.as_ref());
            let taken = found.take(self.evaluator, budget, candidate, is_better)?;
            let Some(candidate) = taken else {
                return Ok(false);
            };
            match is_round {
                true => self.members.push(candidate),
                false => self.replace(self.trials + index, candidate),
            }
        }
        match is_round {
            true => self.placed(count, found),
            false => self.trials += count,
        }
        self.used += self.evaluator.count() - before;
        Ok(true)
    }

    /// Ends a round of places: the best of all designs are the members.
    fn placed(&mut self, count: usize, found: &Found) {
        self.open -= count;
        if self.open > 0 {
            return;
        }
        for one in &found.full {
            if self.members.iter().all(|member| member.place != one.place) {
                self.members.push(one.clone());
            }
        }
        self.members.sort_by(Candidate::rank);
        self.members
            .truncate(population(self.evaluator.problem.free.len()));
    }

    /// Returns trials for the next members in turn.
    fn trials(&self, found: &Found) -> Vec<Vec<f64>> {
        let members = &self.members;
        let best = found.best.as_ref().or(members.first());
        let trial = |number: usize| {
            let mut stream = RandomStream::new(self.evaluator.problem.seed, number as u64);
            let mut draw = || {
                let number = (stream.uniform() * members.len() as f64) as usize;
                &members[number.min(members.len() - 1)].place
            };
            let (b, c) = (draw(), draw());
            let member = &members[number % members.len()].place;
            let guide = best.map_or(member, |best| &best.place);
            mutant(member, guide, (b, c), &mut stream)
        };
        let next = self.trials..self.trials + BATCH.min(members.len());
        next.map(trial).collect()
    }

    /// Replaces a member by its trial where that is better.
    fn replace(&mut self, number: usize, trial: Candidate) {
        let index = number % self.members.len();
        if trial.is_better(Some(&self.members[index])) {
            self.members[index] = trial;
        }
    }
}

/// Returns the number of members of a population.
pub fn population(keys: usize) -> usize {
    LEAST_MEMBERS.max(MEMBERS_PER_KEY * keys)
}

/// Returns a trial from a member, a guide and two others.
pub fn mutant(
    member: &[f64],
    guide: &[f64],
    (b, c): (&[f64], &[f64]),
    stream: &mut RandomStream,
) -> Vec<f64> {
    let always = (stream.uniform() * member.len() as f64) as usize;
    (0..member.len())
        .map(|k| {
            let is_replaced = stream.uniform() < CROSSOVER || k == always;
            let moved = member[k] + WEIGHT * (guide[k] - member[k]) + WEIGHT * (b[k] - c[k]);
            match is_replaced {
                true => inside(moved),
                false => member[k],
            }
        })
        .collect()
}

/// Reflects a coordinate into [0, 1].
fn inside(coordinate: f64) -> f64 {
    let turned = coordinate.rem_euclid(2.0);
    if turned > 1.0 { 2.0 - turned } else { turned }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_are_reflected_at_both_ends() {
        for (given, expected) in [(0.3, 0.3), (-0.2, 0.2), (1.25, 0.75), (2.5, 0.5)] {
            assert!((inside(given) - expected).abs() < 1e-15);
        }
    }
}
