//! Front of several goals: designs that no other design beats in all goals.

use crate::problem::Problem;
use crate::result::FrontPoint;
use crate::search::Candidate;
use std::collections::BTreeMap;

/// True where the first design is at least as good in all goals and better in one. A design beyond
/// its limits is beaten by one within them, or by a smaller violation.
pub fn dominates(one: &Candidate, other: &Candidate) -> bool {
    let (a, b) = (&one.evaluation, &other.evaluation);
    if !a.is_feasible() || !b.is_feasible() {
        return a.violation < b.violation;
    }
    let pairs = || a.goals.iter().zip(&b.goals);
    pairs().all(|(a, b)| a >= b) && pairs().any(|(a, b)| a > b)
}

/// Returns the rank of each design: 0 for the front, 1 for the front without these, and so on.
pub fn ranks(all: &[Candidate]) -> Vec<usize> {
    let mut ranks = vec![usize::MAX; all.len()];
    for rank in 0..all.len() {
        let open: Vec<usize> = (0..all.len()).filter(|k| ranks[*k] == usize::MAX).collect();
        if open.is_empty() {
            break;
        }
        let is_beaten = |k: usize| open.iter().any(|other| dominates(&all[*other], &all[k]));
        let front: Vec<usize> = open.iter().copied().filter(|k| !is_beaten(*k)).collect();
        front.iter().for_each(|k| ranks[*k] = rank);
    }
    ranks
}

/// Returns the distance of each design to its neighbours along the front of its rank, summed over
/// the goals; infinite at the ends.
///
/// Source: K. Deb et al., IEEE Trans. Evol. Comput. 6 (2002) 182, the crowding distance of NSGA-II.
pub fn crowding(all: &[Candidate], ranks: &[usize]) -> Vec<f64> {
    let mut distances = vec![0.0; all.len()];
    let goals = all.first().map_or(0, |one| one.evaluation.goals.len());
    let last = ranks.iter().copied().max().unwrap_or(0);
    for rank in 0..=last {
        let mut members: Vec<usize> = (0..all.len()).filter(|k| ranks[*k] == rank).collect();
        for goal in 0..goals {
            let value = |k: usize| all[k].evaluation.goals[goal];
            members.sort_by(|a, b| value(*a).total_cmp(&value(*b)));
            let (Some(first), Some(end)) = (members.first(), members.last()) else {
                continue;
            };
            let width = (value(*end) - value(*first)).max(f64::MIN_POSITIVE);
            distances[*first] = f64::INFINITY;
            distances[*end] = f64::INFINITY;
            for three in members.windows(3) {
                distances[three[1]] += (value(three[2]) - value(three[0])) / width;
            }
        }
    }
    distances
}

/// Returns the front of the designs that keep all limits, by the first goal.
pub fn front(problem: &Problem, full: &[Candidate]) -> Vec<FrontPoint> {
    let feasible: Vec<Candidate> = full
        .iter()
        .filter(|one| one.evaluation.is_feasible())
        .cloned()
        .collect();
    let mut points: Vec<&Candidate> = ranks(&feasible)
        .into_iter()
        .zip(&feasible)
        .filter(|(rank, _)| *rank == 0)
        .map(|(_, one)| one)
        .collect();
    points.sort_by(|a, b| a.evaluation.goals[0].total_cmp(&b.evaluation.goals[0]));
    points.dedup_by(|a, b| a.evaluation.goals == b.evaluation.goals);
    let point = |one: &Candidate| {
        let names = problem.goals.iter().map(|goal| goal.name().to_owned());
        FrontPoint {
            set: crate::examination::settings(problem, &one.place),
            goals: names
                .zip(one.evaluation.goals.iter().copied())
                .collect::<BTreeMap<_, _>>(),
        }
    };
    points.into_iter().map(point).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Evaluation;

    fn candidate(goals: [f64; 2], violation: f64) -> Candidate {
        Candidate {
            place: Vec::new(),
            evaluation: Evaluation {
                goals: goals.to_vec(),
                limits: Vec::new(),
                violation,
                unknown_share: 0.0,
                expected_power_w: [0.0; 3],
                basin_fraction: [0.0; 3],
                orbit: None,
                further_orbits: Vec::new(),
                failure: None,
            },
        }
    }

    #[test]
    fn ranks_and_distances_of_a_known_front() {
        let all = [
            candidate([1.0, 4.0], 0.0),
            candidate([2.0, 3.0], 0.0),
            candidate([4.0, 1.0], 0.0),
            candidate([1.5, 2.0], 0.0),
            candidate([9.0, 9.0], 0.2),
        ];
        let ranks = ranks(&all);
        assert_eq!(ranks, [0, 0, 0, 1, 2]);
        let distances = crowding(&all, &ranks);
        assert_eq!(distances[1], 3.0 / 3.0 + 3.0 / 3.0);
        assert!(distances[0].is_infinite() && distances[2].is_infinite());
    }
}
