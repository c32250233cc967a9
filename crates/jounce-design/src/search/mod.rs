//! Search for the best design.

mod candidate;
mod evolution;
mod follow;
mod front_search;
mod multistart;
mod refine;
mod rounds;
mod sampling;

pub use candidate::Candidate;
pub use follow::Followed;
pub use sampling::Places;

use crate::evaluation::{Evaluator, OnImprovement};
use crate::examination::examine;
use crate::front::front;
use crate::problem::Problem;
use crate::result::{DesignOutcome, SearchEnd, TracePoint};
use crate::{DesignError, Journaled};
use jounce_analysis::Journal;
use jounce_control::Control;
use std::time::Instant;

/// Places of a round.
const ROUND: usize = 32;

/// Relative gain of the goal below which a design is no better.
const GAIN: f64 = 1e-3;

/// What a search found.
pub struct Found {
    /// Best design, evaluated with all starts.
    pub best: Option<Candidate>,
    /// Designs evaluated with all starts.
    pub full: Vec<Candidate>,
    /// Best value of the first goal so far, by evaluations.
    pub trace: Vec<TracePoint>,
    /// Reason of a design that could not be evaluated.
    pub failure: Option<String>,
    /// Reason of the end.
    pub end: SearchEnd,
}

impl Found {
    /// Returns the start of a search.
    fn nothing() -> Self {
        Self {
            best: None,
            full: Vec::new(),
            trace: Vec::new(),
            failure: None,
            end: SearchEnd::Converged,
        }
    }
}

/// Budget of a search.
pub struct Budget<'b> {
    begin: Instant,
    problem: &'b Problem,
    control: &'b Control,
}

impl Budget<'_> {
    /// Returns the number of evaluations that are left after some.
    pub fn left(&self, evaluations: usize) -> usize {
        self.problem.evaluations.saturating_sub(evaluations)
    }

    /// Returns the reason to end where a step needs some of the evaluations that are left.
    pub fn end(&self, evaluations: usize, needed: usize) -> Option<SearchEnd> {
        let seconds = self.begin.elapsed().as_secs_f64();
        if self.control.is_stopped() {
            Some(SearchEnd::Stopped)
        } else if self.left(evaluations) < needed {
            Some(SearchEnd::Evaluations)
        } else {
            // The first design is evaluated in any case.
            let is_late = self.problem.seconds.is_some_and(|most| seconds >= most);
            (is_late && evaluations > 0).then_some(SearchEnd::Seconds)
        }
    }
}

/// Searches for the best design of a problem, and examines it. After a stop by the control, the
/// best design so far is the result. `journal` keeps the evaluations, from which an interrupted
/// search resumes. `improved` is called with each better design; the result does not depend on it.
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
    let mut evaluator = Evaluator::new(problem, control, journal)?;
    evaluator.improved = improved;
    let budget = Budget {
        begin,
        problem,
        control,
    };
    let found = match problem.goals.len() {
        1 if problem.follows_orbit() => multistart::search(&evaluator, &budget)?,
        1 => rounds::search(&evaluator, &budget, Found::nothing())?,
        _ => front_search::search(&evaluator, &budget)?,
    };
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
