//! Search with several goals: an evolution of the front.
//!
//! Each generation adds one trial per member; of both, those of the lower rank stay, and of one
//! rank those with the wider distance to their neighbours.
//!
//! Source: K. Deb et al., IEEE Trans. Evol. Comput. 6 (2002) 182, with trials by differences.

use super::evolution::mutant;
use super::rounds::{keep, screened};
use super::sampling::Places;
use super::{Budget, Candidate, Found};
use crate::DesignError;
use crate::evaluation::{Effort, Evaluator};
use crate::front::{crowding, ranks};
use crate::result::SearchEnd;
use jounce_signal::RandomStream;

/// Members of the front.
const MEMBERS: usize = 40;

/// Generations without a new member after which the search ends.
const LAST_GENERATIONS: usize = 3;

/// Searches for the front.
pub fn search(evaluator: &Evaluator<'_>, budget: &Budget<'_>) -> Result<Found, DesignError> {
    let problem = evaluator.problem;
    let mut places = Places::new(problem.free.len(), problem.seed);
    let mut found = Found::nothing();
    let mut members = screened(
        evaluator,
        places.take(MEMBERS.min(problem.evaluations.div_ceil(2))),
        Effort::Screening,
    )?;
    let (mut generation, mut without_change) = (0, 0);
    while without_change < LAST_GENERATIONS {
        // The members of the front are evaluated with all starts in the end.
        if let Some(end) = budget.end(evaluator.count(), 2 * MEMBERS) {
            found.end = end;
            break;
        }
        generation += 1;
        let trials = screened(
            evaluator,
            trials(&members, problem.seed, generation),
            Effort::Screening,
        )?;
        let next = selected(members.iter().cloned().chain(trials).collect());
        match next == members {
            true => without_change += 1,
            false => without_change = 0,
        }
        members = next;
    }
    let ranks = ranks(&members);
    for (member, _) in members.iter().zip(&ranks).filter(|(_, rank)| **rank == 0) {
        if evaluator.control.is_stopped() {
            found.end = SearchEnd::Stopped;
            break;
        }
        keep(evaluator, member.place.clone(), &mut found)?;
    }
    Ok(found)
}

fn trials(members: &[Candidate], seed: u64, generation: u64) -> Vec<Vec<f64>> {
    let trial = |index: usize| {
        let mut stream = RandomStream::new(seed, generation << 32 | index as u64);
        let mut draw = || {
            let number = (stream.uniform() * members.len() as f64) as usize;
            &members[number.min(members.len() - 1)].place
        };
        let (guide, b, c) = (draw(), draw(), draw());
        mutant(&members[index].place, guide, (b, c), &mut stream)
    };
    (0..members.len()).map(trial).collect()
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
