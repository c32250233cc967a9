//! A design with its evaluation, and the order of designs.

use crate::Evaluation;
use std::cmp::Ordering;

/// A design with its evaluation.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidate {
    /// Place in the unit cube of the free keys.
    pub place: Vec<f64>,
    /// Evaluation.
    pub evaluation: Evaluation,
}

impl Candidate {
    /// Orders the better one first: a design within the limits before one beyond them, then the
    /// larger first goal, or the smaller violation.
    ///
    /// Source: K. Deb, Comput. Methods Appl. Mech. Eng. 186 (2000) 311.
    pub fn rank(&self, other: &Self) -> Ordering {
        let (one, two) = (&self.evaluation, &other.evaluation);
        match (one.is_feasible(), two.is_feasible()) {
            (true, true) => goal(two).total_cmp(&goal(one)),
            (true, false) => Ordering::Less,
            (false, true) => Ordering::Greater,
            (false, false) => one
                .violation
                .total_cmp(&two.violation)
                .then(goal(two).total_cmp(&goal(one))),
        }
    }

    /// True where the design is better than another one, or where there is no other.
    pub fn is_better(&self, other: Option<&Self>) -> bool {
        other.is_none_or(|other| self.rank(other) == Ordering::Less)
    }
}

/// True where a value exceeds another one by more than a fraction of the larger magnitude of both, whatever
/// their signs are.
pub fn exceeds(value: f64, other: f64, fraction: f64) -> bool {
    value - other > fraction * value.abs().max(other.abs())
}

fn goal(evaluation: &Evaluation) -> f64 {
    evaluation.goals.first().copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn candidate(goal: f64, violation: f64) -> Candidate {
        let evaluation = Evaluation {
            goals: vec![goal],
            limits: Vec::new(),
            violation,
            unknown_share: 0.0,
            expected_power_w: [0.0; 3],
            basin_fraction: [0.0; 3],
            orbit: None,
            further_orbits: Vec::new(),
            failure: None,
        };
        Candidate {
            place: Vec::new(),
            evaluation,
        }
    }

    #[test]
    fn a_gain_is_relative_to_the_larger_magnitude() {
        for (value, other) in [
            (2.0, 1.0),
            (1.0, -1.0),
            (-1.0, -2.0),
            (0.0, -1.0),
            (1.0, 0.0),
        ] {
            assert!(exceeds(value, other, 0.1) && !exceeds(other, value, 0.1));
        }
        for (value, other) in [(1.05, 1.0), (-1.0, -1.05), (0.0, 0.0), (-1.0, -1.0)] {
            assert!(!exceeds(value, other, 0.1), "{value} {other}");
        }
    }

    #[test]
    fn limits_come_before_goals() {
        let mut all = [
            candidate(9.0, 0.5),
            candidate(1.0, 0.0),
            candidate(8.0, 0.1),
            candidate(2.0, 0.0),
        ];
        all.sort_by(Candidate::rank);
        let goals: Vec<f64> = all.iter().map(|one| one.evaluation.goals[0]).collect();
        assert_eq!(goals, [2.0, 1.0, 8.0, 9.0]);
        assert!(all[0].is_better(None) && !all[1].is_better(Some(&all[0])));
    }
}
