//! The evaluations of a small budget are the first ones of a large budget.

use super::bistable::two_variables_spec;
use super::{LINEAR, LOAD, problem_of};
use jounce_control::Control;
use jounce_design::{DesignOutcome, SearchEnd, design};
use rayon::prelude::*;

/// Budgets that end a search in its rounds, its refinements and its evolutions.
const BUDGETS: [usize; 9] = [1, 3, 10, 17, 25, 40, 60, 75, 90];

fn with_budget(spec: &str, text: &str, seed: u64, evaluations: usize) -> DesignOutcome {
    let mut problem = problem_of(spec, text).unwrap();
    (problem.seed, problem.evaluations) = (seed, evaluations);
    design(&problem, &Control::default(), None, None).unwrap()
}

/// Checks that the search of each budget begins with that of the next smaller one, so that no budget
/// ends with a worse design than a smaller one.
fn check(spec: &str, text: &str, seeds: u64) {
    (1..=seeds).into_par_iter().for_each(|seed| {
        let outcomes = BUDGETS.map(|budget| with_budget(spec, text, seed, budget));
        for (pair, budgets) in outcomes.windows(2).zip(BUDGETS.windows(2)) {
            let [small, large] = pair else { unreachable!() };
            let about = format!("seed {seed}, {budgets:?}: {small:?} {large:?}");
            assert!(large.trace.starts_with(&small.trace), "{about}");
            assert!(small.evaluations <= budgets[0], "{about}");
            if small.ended_by == SearchEnd::Converged {
                assert_eq!(small.best, large.best, "{about}");
            }
            assert!(
                (large.feasible, -large.violation) >= (small.feasible, -small.violation),
                "{about}"
            );
        }
    });
}

#[test]
fn a_search_along_orbits_begins_as_one_of_a_smaller_budget() {
    let limit = format!("{LOAD}[limits]\n\"patch.m.p.voltage\" = \"5 V\"\n");
    check(LINEAR, LOAD, 3);
    check(LINEAR, &limit, 3);
}

/// Half of its starts reach another attractor or chaos, so that an evolution goes with the refinements.
#[test]
#[ignore = "long: runs with ./test --long"]
fn a_search_with_several_attractors_begins_as_one_of_a_smaller_budget() {
    let (spec, free) = two_variables_spec();
    for goal in ["expected-power", "stable-power"] {
        let text = format!("{free}[goal]\nmaximise = \"{goal}\"\nstarts = 10\n");
        check(&spec, &text, 2);
    }
}

#[test]
fn a_search_over_runs_begins_as_one_of_a_smaller_budget() {
    let text = LOAD.replace("expected-power", "mean-power");
    check(LINEAR, &text, 3);
}

#[test]
fn a_search_for_a_front_begins_as_one_of_a_smaller_budget() {
    let text = LOAD.replace("\"expected-power\"", "[\"expected-power\", \"bandwidth\"]");
    check(LINEAR, &text, 2);
}
