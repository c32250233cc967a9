//! Differential evolution: trials from differences of members.
//!
//! ```text
//! trial = a + F (best - a) + F (b - c),   some coordinates of it replace those of a
//! ```
//!
//! Source: R. Storn, K. Price, J. Global Optim. 11 (1997) 341, variant current-to-best/1/bin.

use super::Candidate;
use crate::problem::Problem;
use jounce_signal::RandomStream;

/// Members that are evaluated with all starts in the end.
pub const BEST: usize = 3;

/// Weight of the differences, and probability of a coordinate to be replaced.
const WEIGHT: f64 = 0.6;
const CROSSOVER: f64 = 0.9;

/// Smallest number of members, and members per free key.
const LEAST_MEMBERS: usize = 12;
const MEMBERS_PER_KEY: usize = 5;

/// Largest distance between a member and the best one, in the unit cube, of a converged population.
const CONVERGED: f64 = 1e-3;

/// Members of an evolution.
pub struct Population<'p> {
    problem: &'p Problem,
    members: Vec<Candidate>,
    generation: u64,
}

impl<'p> Population<'p> {
    /// Starts with the best of some designs.
    pub fn new(mut members: Vec<Candidate>, problem: &'p Problem) -> Self {
        members.sort_by(Candidate::rank);
        members.truncate(LEAST_MEMBERS.max(MEMBERS_PER_KEY * problem.free.len()));
        Self {
            problem,
            members,
            generation: 0,
        }
    }

    /// Returns the number of members.
    pub fn size(&self) -> usize {
        self.members.len()
    }

    /// Returns the members.
    pub fn into_members(self) -> Vec<Candidate> {
        self.members
    }

    /// True where all members are at one place.
    pub fn has_converged(&self) -> bool {
        let Some(best) = self.best() else { return true };
        self.members
            .iter()
            .all(|one| jounce_linalg::distance(&one.place, &best.place) < CONVERGED)
    }

    /// Returns one trial for each member.
    pub fn trials(&mut self) -> Vec<Vec<f64>> {
        self.generation += 1;
        let best = self
            .best()
            .map(|best| best.place.clone())
            .unwrap_or_default();
        let trial = |index| trial(self, &best, index);
        (0..self.members.len()).map(trial).collect()
    }

    /// Replaces each member by its trial where that is better.
    pub fn replace(&mut self, trials: Vec<Candidate>) {
        for (member, trial) in self.members.iter_mut().zip(trials) {
            if trial.is_better(Some(member)) {
                *member = trial;
            }
        }
    }

    fn best(&self) -> Option<&Candidate> {
        self.members.iter().min_by(|a, b| a.rank(b))
    }
}

fn trial(population: &Population<'_>, best: &[f64], index: usize) -> Vec<f64> {
    let members = &population.members;
    let stream_index = population.generation << 32 | index as u64;
    let mut stream = RandomStream::new(population.problem.seed, stream_index);
    let mut draw = || {
        let number = (stream.uniform() * members.len() as f64) as usize;
        &members[number.min(members.len() - 1)].place
    };
    let (b, c) = (draw(), draw());
    mutant(&members[index].place, best, (b, c), &mut stream)
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
