//! Search for the best design.

mod candidate;
mod evolution;
mod follow;
mod found;
mod front_search;
mod multistart;
mod refine;
mod rounds;
mod sampling;

pub use candidate::Candidate;
use candidate::exceeds;
pub use follow::Followed;
pub use sampling::Places;

use crate::evaluation::{Evaluator, OnImprovement};
use crate::examination::examine;
use crate::front::front;
use crate::problem::Problem;
use crate::result::{DesignOutcome, SearchEnd};
use crate::{DesignError, Journaled};
use evolution::Evolution;
use found::{Budget, Found};
use jounce_analysis::Journal;
use jounce_control::Control;
use std::time::Instant;

/// Places of a round.
const ROUND: usize = 32;

/// Relative gain of the goal below which a design is no better.
const GAIN: f64 = 1e-3;

/// Designs that are evaluated at the same time.
const BATCH: usize = 8;

/// Searches for the best design of a problem, and examines it. After a stop by the control, the
/// best design so far is the result. `journal` keeps the evaluations, from which an interrupted
/// search resumes. The progress of the control is the number of evaluated designs, of at most
/// `evaluations`. `improved` is called with each better design; the result does not depend on it.
///
/// # Errors
/// No model can be built, no design can be evaluated, the journal cannot be written, or the search is
/// stopped before the first design.
pub fn design(
    problem: &Problem,
    control: &Control,
    journal: Option<&Journal<Journaled>>,
    improved: Option<OnImprovement<'_>>,
) -> Result<DesignOutcome, DesignError> {
    let begin = Instant::now();
    control.expect(problem.evaluations);
    let mut evaluator = Evaluator::new(problem, control, journal)?;
    evaluator.improved = improved;
    let budget = Budget {
        begin,
        problem,
        control,
    };
    let mut found = Found::nothing();
    if !found.ends(&evaluator, &budget, 1) {
        let mut places = Places::new(problem.free.len(), problem.seed);
        let first = problem.given().unwrap_or_else(|| places.take(1).remove(0));
        found.evaluate(&evaluator, first)?;
        search(&evaluator, &budget, &mut found)?;
    }
    let Some(best) = found.best else {
        return Err(match found.end {
            SearchEnd::Stopped => DesignError::Stopped,
            _ => DesignError::NothingEvaluated {
                evaluations: evaluator.count(),
                reason: found.failure.unwrap_or_default(),
            },
        });
    };
    let evaluations = evaluator.count();
    let mut result = examine(&evaluator, &best, found.end)?;
    if problem.goals.len() > 1 {
        result.front = front(problem, &found.full);
    }
    result.trace = found.trace;
    result.evaluations = evaluations;
    result.wall_time_s = begin.elapsed().as_secs_f64();
    Ok(result)
}

/// Searches on from the first design.
fn search(
    evaluator: &Evaluator<'_>,
    budget: &Budget<'_>,
    found: &mut Found,
) -> Result<(), DesignError> {
    let mut evolution = Evolution::new(evaluator);
    match evaluator.problem.goals.len() {
        1 if evaluator.problem.follows_orbit() => {
            multistart::search(evaluator, budget, &mut evolution, found)
        }
        1 => rounds::search(evaluator, budget, &mut evolution, found),
        _ => front_search::search(evaluator, budget, found),
    }
}
