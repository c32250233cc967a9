//! Search with several goals: an evolution of the front.
//!
//! Trials are added in batches. A design that no other one beats is evaluated with all starts before
//! it counts. Of all designs, those of the lower rank stay, and of one rank those with the wider
//! distance to their neighbours.
//!
//! Source: K. Deb et al., IEEE Trans. Evol. Comput. 6 (2002) 182, with trials by differences.

use super::evolution::mutant;
use super::found::{Budget, Found, evaluated};
use super::sampling::Places;
use super::{BATCH, Candidate};
use crate::DesignError;
use crate::evaluation::Evaluator;
use crate::front::{crowding, dominates, ranks};
use jounce_signal::RandomStream;

/// Members of the front.
const MEMBERS: usize = 40;

/// Trials without a new member after which the search ends.
const LAST_TRIALS: usize = 3 * MEMBERS;

/// Searches for the front.
pub fn search(
    evaluator: &Evaluator<'_>,
    budget: &Budget<'_>,
    found: &mut Found,
) -> Result<(), DesignError> {
    let problem = evaluator.problem;
    let mut places = Places::new(problem.free.len(), problem.seed);
    let mut members = found.full.clone();
    let (mut designs, mut without_change) = (0, 0);
    while without_change < LAST_TRIALS {
        if found.ends(evaluator, budget, 1) {
            break;
        }
        let mut next = match designs < MEMBERS {
            true => places.take(BATCH),
            false => trials(&members, problem.seed, designs),
        };
        designs += next.len();
        next.truncate(budget.left(evaluator.count()));
        let mut all = members.clone();
        for candidate in evaluated(evaluator, next, problem.screening())? {
            let is_in_front = |_: &Found, candidate: &Candidate| {
                !all.iter().any(|other| dominates(other, candidate))
            };
            match found.take(evaluator, budget, candidate, is_in_front)? {
                Some(candidate) => all.push(candidate),
                None => return Ok(()),
            }
        }
        let next = selected(all);
        match next == members {
            true => without_change += BATCH,
            false => without_change = 0,
        }
        members = next;
    }
    Ok(())
}

/// Returns trials for the next members in turn.
fn trials(members: &[Candidate], seed: u64, first: usize) -> Vec<Vec<f64>> {
    let trial = |number: usize| {
        let mut stream = RandomStream::new(seed, number as u64);
        let mut draw = || {
            let number = (stream.uniform() * members.len() as f64) as usize;
            &members[number.min(members.len() - 1)].place
        };
        let (guide, b, c) = (draw(), draw(), draw());
        mutant(
            &members[number % members.len()].place,
            guide,
            (b, c),
            &mut stream,
        )
    };
    (first..first + BATCH).map(trial).collect()
}

/// Returns the members of the next generation.
fn selected(all: Vec<Candidate>) -> Vec<Candidate> {
    let ranks = ranks(&all);
    let distances = crowding(&all, &ranks);
    let mut order: Vec<usize> = (0..all.len()).collect();
    order.sort_by(|a, b| {
        let wider = distances[*b].total_cmp(&distances[*a]);
        ranks[*a].cmp(&ranks[*b]).then(wider)
    });
    order.truncate(MEMBERS);
    order.sort_unstable();
    order.into_iter().map(|k| all[k].clone()).collect()
}
