//! What a search has found, and what it may still spend.

use super::Candidate;
use crate::DesignError;
use crate::evaluation::{Effort, Evaluator};
use crate::examination::improvement;
use crate::problem::Problem;
use crate::result::{SearchEnd, TracePoint};
use jounce_control::Control;
use rayon::prelude::*;
use std::time::Instant;

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
    pub fn nothing() -> Self {
        Self {
            best: None,
            full: Vec::new(),
            trace: Vec::new(),
            failure: None,
            end: SearchEnd::Converged,
        }
    }

    /// Evaluates a design with all starts, counts it and keeps it.
    pub fn evaluate(
        &mut self,
        evaluator: &Evaluator<'_>,
        place: Vec<f64>,
    ) -> Result<Candidate, DesignError> {
        evaluator.add(1);
        let evaluation = evaluator.evaluate(&place, Effort::Full)?;
        let candidate = Candidate { place, evaluation };
        self.keep(evaluator, &candidate);
        Ok(candidate)
    }

    /// Keeps a design that has been evaluated with all starts.
    pub fn keep(&mut self, evaluator: &Evaluator<'_>, candidate: &Candidate) {
        if evaluator.control.is_stopped() {
            self.end = SearchEnd::Stopped;
            return;
        }
        if let Some(reason) = &candidate.evaluation.failure {
            self.failure.get_or_insert_with(|| reason.clone());
            return;
        }
        if candidate.is_better(self.best.as_ref()) {
            let point = TracePoint {
                evaluation: evaluator.count(),
                goal: candidate.evaluation.goals[0],
                violation: candidate.evaluation.violation,
            };
            self.trace.push(point);
            if let Some(improved) = evaluator.improved {
                improved(&improvement(evaluator.problem, candidate, point));
            }
            self.best = Some(candidate.clone());
        }
        self.full.push(candidate.clone());
    }

    /// Counts an evaluated design; false where the search ends before it.
    pub fn counted(
        &mut self,
        evaluator: &Evaluator<'_>,
        budget: &Budget<'_>,
        candidate: &Candidate,
    ) -> bool {
        if self.ends(evaluator, budget, 1) {
            return false;
        }
        evaluator.add(1);
        if let Some(reason) = &candidate.evaluation.failure {
            self.failure.get_or_insert_with(|| reason.clone());
        }
        true
    }

    /// Counts a screened design and, where the design deserves it, evaluates it with all starts;
    /// `None` where the search ends.
    pub fn take(
        &mut self,
        evaluator: &Evaluator<'_>,
        budget: &Budget<'_>,
        candidate: Candidate,
        deserves: impl FnOnce(&Self, &Candidate) -> bool,
    ) -> Result<Option<Candidate>, DesignError> {
        if !self.counted(evaluator, budget, &candidate) {
            return Ok(None);
        }
        if let Some(known) = self.full.iter().find(|one| one.place == candidate.place) {
            return Ok(Some(known.clone()));
        }
        if !deserves(self, &candidate) {
            return Ok(Some(candidate));
        }
        if evaluator.problem.screening() == Effort::Full {
            self.keep(evaluator, &candidate);
            return Ok(Some(candidate));
        }
        match self.ends(evaluator, budget, 1) {
            true => Ok(None),
            false => self.evaluate(evaluator, candidate.place).map(Some),
        }
    }

    /// True where a place has been evaluated with all starts.
    pub fn has(&self, place: &[f64]) -> bool {
        self.full.iter().any(|one| one.place == place)
    }

    /// True where a step of some evaluations has to be left out, so that the search ends.
    pub fn ends(&mut self, evaluator: &Evaluator<'_>, budget: &Budget<'_>, step: usize) -> bool {
        let end = budget.end(evaluator.count(), step);
        self.end = end.unwrap_or(self.end);
        end.is_some()
    }
}

/// Budget of a search. It only cuts the search: no step depends on what is left, so that the
/// evaluations of a small budget are the first ones of a large budget.
pub struct Budget<'b> {
    pub begin: Instant,
    pub problem: &'b Problem,
    pub control: &'b Control,
}

impl Budget<'_> {
    /// Returns the number of evaluations that are left after some.
    pub fn left(&self, evaluations: usize) -> usize {
        self.problem.evaluations.saturating_sub(evaluations)
    }

    /// Returns the reason to end before a step of some evaluations.
    fn end(&self, evaluations: usize, step: usize) -> Option<SearchEnd> {
        let seconds = self.begin.elapsed().as_secs_f64();
        if self.control.is_stopped() {
            Some(SearchEnd::Stopped)
        } else if self.left(evaluations) < step {
            Some(SearchEnd::Evaluations)
        } else {
            // The first design is evaluated in any case.
            let is_late = self.problem.seconds.is_some_and(|most| seconds >= most);
            (is_late && evaluations > 0).then_some(SearchEnd::Seconds)
        }
    }
}

/// Evaluates places at the same time; the caller counts those that it takes.
pub fn evaluated(
    evaluator: &Evaluator<'_>,
    places: Vec<Vec<f64>>,
    effort: Effort,
) -> Result<Vec<Candidate>, DesignError> {
    let candidate = |place: Vec<f64>| {
        let evaluation = evaluator.evaluate(&place, effort)?;
        Ok(Candidate { place, evaluation })
    };
    places.into_par_iter().map(candidate).collect()
}
