//! Search with several goals: an evolution of the front.
//!
//! Where a goal is the power of an orbit, the search first follows the orbit of the best of a few places
//! to its largest power. Then places fill the space, and trials follow in batches. One half of them are
//! those of differential evolution. The other half fill gaps of the front: a value of a goal is drawn
//! evenly between the ends of the front, and the trial lies between the two designs next to it. A design that no
//! other one beats is evaluated with all starts before it counts. Of all designs, those of the lower
//! rank stay, and of one rank those with the wider distance to their neighbours.
//!
//! Sources: K. Deb et al., IEEE Trans. Evol. Comput. 6 (2002) 182, ranks and distances;
//! H. Mühlenbein, D. Schlierkamp-Voosen, Evol. Comput. 1 (1993) 25, line recombination.

use super::evolution::{mutant, population};
use super::found::{Budget, Found, evaluated};
use super::refine::refine;
use super::sampling::Places;
use super::{BATCH, Candidate};
use crate::DesignError;
use crate::evaluation::{Effort, Evaluator};
use crate::front::{crowding, dominates, ranks};
use jounce_signal::RandomStream;

/// Members of the front.
const MEMBERS: usize = 40;

/// Trials without a new member after which the search ends.
const LAST_TRIALS: usize = 3 * MEMBERS;

/// Evolution of the front.
struct FrontSearch<'s, 'e> {
    evaluator: &'s Evaluator<'e>,
    budget: &'s Budget<'s>,
    found: &'s mut Found,
    members: Vec<Candidate>,
}

/// Searches for the front.
pub fn search(
    evaluator: &Evaluator<'_>,
    budget: &Budget<'_>,
    found: &mut Found,
) -> Result<(), DesignError> {
    let problem = evaluator.problem;
    let keys = problem.free.len();
    let mut places = Places::new(keys, problem.seed);
    let members = found.full.clone();
    let mut search = FrontSearch {
        evaluator,
        budget,
        found,
        members,
    };
    if problem.follows_orbit() && !search.begun(places.take(BATCH))? {
        return Ok(());
    }
    let (mut designs, mut without_change) = (0, 0);
    while without_change < LAST_TRIALS {
        let next = match designs < population(keys) {
            true => places.take(BATCH),
            false => trials(&search.members, problem.seed, designs),
        };
        designs += next.len();
        let before = search.members.clone();
        if !search.taken(next)? {
            return Ok(());
        }
        match search.members == before {
            true => without_change += BATCH,
            false => without_change = 0,
        }
    }
    Ok(())
}

impl FrontSearch<'_, '_> {
    /// Follows an orbit to its largest power: that of the best of some places and the first design.
    /// Returns false where the search ends.
    fn begun(&mut self, places: Vec<Vec<f64>>) -> Result<bool, DesignError> {
        if self.found.ends(self.evaluator, self.budget, places.len()) {
            return Ok(false);
        }
        self.evaluator.add(places.len());
        let mut starts = evaluated(self.evaluator, places, Effort::Probe)?;
        starts.extend(self.members.iter().cloned());
        let power_w = |one: &Candidate| {
            let orbit = one.evaluation.orbit.as_ref();
            orbit.map_or(0.0, |orbit| orbit.mean_power_w)
        };
        starts.sort_by(|a, b| {
            let more = power_w(b).total_cmp(&power_w(a));
            let (a, b) = (&a.evaluation, &b.evaluation);
            a.violation.total_cmp(&b.violation).then(more)
        });
        let mut stages = starts.iter().filter_map(|one| refine(self.evaluator, one));
        let (mut designs, mut ends) = (0, Vec::new());
        for stage in stages.next().unwrap_or_default() {
            let step = stage.designs - designs;
            if self.found.ends(self.evaluator, self.budget, step) {
                break;
            }
            self.evaluator.add(step);
            designs = stage.designs;
            ends.push(stage.place);
        }
        ends.dedup();
        self.taken(ends)
    }

    /// Evaluates places with few starts, and with all starts where no design beats them. Then selects
    /// the next members. Returns false where the search ends.
    fn taken(&mut self, mut places: Vec<Vec<f64>>) -> Result<bool, DesignError> {
        let (evaluator, budget) = (self.evaluator, self.budget);
        if self.found.ends(evaluator, budget, 1) {
            return Ok(false);
        }
        // Those that the budget would cut need no evaluation.
        places.truncate(budget.left(evaluator.count()));
        places.retain(|place| !self.found.has(place));
        let screening = evaluator.problem.screening();
        let screened = evaluated(evaluator, places, screening)?;
        let is_open: Vec<bool> = (0..screened.len())
            .map(|k| {
                let mut others = self.members.iter().chain(&screened[..k]);
                !others.any(|other| dominates(other, &screened[k]))
            })
            .collect();
        let open = screened.iter().zip(&is_open).filter(|(_, open)| **open);
        let mut full = match screening {
            Effort::Full => open.map(|(one, _)| one.clone()).collect(),
            _ => {
                let places = open.map(|(one, _)| one.place.clone()).collect();
                evaluated(evaluator, places, Effort::Full)?
            }
        }
        .into_iter();
        for (few, is_open) in screened.into_iter().zip(is_open) {
            if !self.found.counted(evaluator, budget, &few) {
                return Ok(false);
            }
            let Some(all) = is_open.then(|| full.next()).flatten() else {
                self.members.push(few);
                continue;
            };
            if screening != Effort::Full && !self.found.counted(evaluator, budget, &all) {
                return Ok(false);
            }
            self.found.keep(evaluator, &all);
            self.members.push(all);
        }
        self.members = selected(std::mem::take(&mut self.members));
        Ok(true)
    }
}

/// Returns trials: alternately a place between neighbours of the front and a mutant of a member.
fn trials(members: &[Candidate], seed: u64, first: usize) -> Vec<Vec<f64>> {
    let trial = |number: usize| {
        let mut stream = RandomStream::new(seed, number as u64);
        let filling = number
            .is_multiple_of(2)
            .then(|| filling(members, &mut stream));
        if let Some(place) = filling.flatten() {
            return place;
        }
        let mut draw = || &members[drawn(&mut stream, members.len())].place;
        let (guide, b, c) = (draw(), draw(), draw());
        let member = &members[(number / 2) % members.len()].place;
        mutant(member, guide, (b, c), &mut stream)
    };
    (first..first + BATCH).map(trial).collect()
}

/// Returns a place between two neighbours of the front, at a drawn value of a drawn goal; `None` where
/// the front has no two values of it.
fn filling(members: &[Candidate], stream: &mut RandomStream) -> Option<Vec<f64>> {
    let goals = members.first()?.evaluation.goals.len();
    let goal = drawn(stream, goals);
    let value = |one: &Candidate| one.evaluation.goals[goal];
    let ranked = ranks(members).into_iter().zip(members);
    let mut front: Vec<&Candidate> = ranked
        .filter(|(rank, _)| *rank == 0)
        .map(|(_, one)| one)
        .collect();
    front.sort_by(|a, b| value(a).total_cmp(&value(b)));
    let (low, high) = (value(front.first()?), value(front.last()?));
    let wanted = low + stream.uniform() * (high - low);
    let next = front.partition_point(|one| value(one) <= wanted);
    let (a, b) = (front.get(next.checked_sub(1)?)?, front.get(next)?);
    let part = (wanted - value(a)) / (value(b) - value(a));
    let pairs = a.place.iter().zip(&b.place);
    Some(pairs.map(|(a, b)| a + part * (b - a)).collect())
}

/// Draws one of some numbers from 0.
fn drawn(stream: &mut RandomStream, count: usize) -> usize {
    ((stream.uniform() * count as f64) as usize).min(count - 1)
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
