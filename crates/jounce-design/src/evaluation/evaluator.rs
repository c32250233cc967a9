//! Evaluates designs.

use super::{Effort, Evaluation, InCondition, Journaled, attractors, bandwidth, run_goals};
use crate::DesignError;
use crate::problem::{Condition, Goal, LimitedQuantity, Problem};
use crate::result::Improvement;
use jounce_analysis::{AnalysisError, Journal, Model};
use jounce_control::Control;
use jounce_spec::NumericKey;
use std::collections::HashMap;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Function that is called with each better design.
pub type OnImprovement<'f> = &'f (dyn Fn(&Improvement) + Sync);

/// Evaluates designs; the evaluations of a journal are not repeated.
pub struct Evaluator<'p> {
    pub problem: &'p Problem,
    /// Models of each change by a condition, for each combination of choices.
    models: Vec<Vec<Model>>,
    pub control: Control,
    /// Evaluations of the journal.
    known: HashMap<(Vec<u64>, Effort), Evaluation>,
    journal: Option<&'p Journal<Journaled>>,
    pub improved: Option<OnImprovement<'p>>,
    count: AtomicUsize,
}

impl<'p> Evaluator<'p> {
    pub fn new(
        problem: &'p Problem,
        control: &Control,
        journal: Option<&'p Journal<Journaled>>,
    ) -> Result<Self, DesignError> {
        let entries = journal.map_or(&[][..], Journal::found);
        let known = entries.iter().map(|entry| {
            let key = (bits(&entry.place), entry.effort);
            (key, entry.evaluation.clone())
        });
        Ok(Self {
            problem,
            models: problem.models(&control.apart())?,
            control: control.clone(),
            known: known.collect(),
            journal,
            improved: None,
            count: AtomicUsize::new(0),
        })
    }

    /// Returns the number of designs that the search has taken so far.
    pub fn count(&self) -> usize {
        self.count.load(Ordering::Relaxed)
    }

    /// Counts designs that a search takes.
    pub fn add(&self, designs: usize) {
        self.count.fetch_add(designs, Ordering::Relaxed);
        (0..designs).for_each(|_| self.control.count());
    }

    /// Returns the model of a design in a condition.
    pub fn model(&self, place: &[f64], condition: &Condition) -> Result<Model, AnalysisError> {
        let base = &self.models[condition.change][self.problem.variant(place)];
        let mut values = self.problem.numbers(place);
        values.extend(condition.values.iter().map(|(key, value)| (key, *value)));
        let mut spec = base.spec.clone();
        NumericKey::set_all(&mut spec, &values)?;
        base.changed(spec)
    }

    /// Evaluates a design at a place of the unit cube; the search counts it where it takes it.
    ///
    /// # Errors
    /// The journal cannot be written. A design that cannot be computed is an evaluation with its
    /// reason.
    pub fn evaluate(&self, place: &[f64], effort: Effort) -> Result<Evaluation, DesignError> {
        if let Some(known) = self.known.get(&(bits(place), effort)) {
            return Ok(known.clone());
        }
        let variant = self.problem.variant(place);
        let bases: Vec<&Model> = self.models.iter().map(|models| &models[variant]).collect();
        let evaluation = self
            .at(&bases, &self.problem.numbers(place), effort)
            .unwrap_or_else(|error| Evaluation::failed(self.problem, error.to_string()));
        // JSON has no infinity and no NaN; such a design is cheap to evaluate again.
        let is_finite = evaluation.violation.is_finite()
            && evaluation.limits.iter().all(|value| value.is_finite());
        let journal = self
            .journal
            .filter(|_| is_finite && !self.control.is_stopped());
        if let Some(journal) = journal {
            journal.keep(&Journaled {
                place: place.to_vec(),
                effort,
                evaluation: evaluation.clone(),
            })?;
        }
        Ok(evaluation)
    }

    /// Evaluates the spec as given, with all starts.
    pub fn given(&self) -> Evaluation {
        let (problem, control) = (self.problem, self.control.apart());
        let model = |change| problem.changed_model(&problem.file, change, &control);
        let models: Result<Vec<Model>, DesignError> =
            (0..problem.changes.len()).map(model).collect();
        let evaluated = models.and_then(|models| {
            let bases: Vec<&Model> = models.iter().collect();
            let evaluation = self.at(&bases, &[], Effort::Full)?;
            match control.is_stopped() {
                true => Err(DesignError::Stopped),
                false => Ok(evaluation),
            }
        });
        evaluated.unwrap_or_else(|error| Evaluation::failed(self.problem, error.to_string()))
    }

    /// Evaluates the models of each change by a condition, with other values of some keys, in all
    /// conditions.
    ///
    /// # Errors
    /// A value that the spec does not allow, or a model that cannot be built.
    fn at(
        &self,
        bases: &[&Model],
        values: &[(&NumericKey, f64)],
        effort: Effort,
    ) -> Result<Evaluation, AnalysisError> {
        let mut all = Vec::with_capacity(self.problem.conditions.len());
        for (number, condition) in self.problem.conditions.iter().enumerate() {
            let own = condition.values.iter().map(|(key, value)| (key, *value));
            let values: Vec<(&NumericKey, f64)> = values.iter().copied().chain(own).collect();
            let base = bases[condition.change];
            let mut spec = base.spec.clone();
            NumericKey::set_all(&mut spec, &values)?;
            let model = base.changed(spec)?;
            let mut found = self.in_condition(&model, effort)?;
            if effort == Effort::Full && self.problem.limits_noise() {
                self.raise_by_noise(&model, number, &mut found.limits)?;
            }
            all.push(found);
        }
        Ok(self.together(&all))
    }

    /// Returns the expected power of a start with other values of some keys of a model, W; 0 where it
    /// cannot be computed.
    pub fn expected_power_w(&self, base: &Model, values: &[(&NumericKey, f64)]) -> f64 {
        let mut spec = base.spec.clone();
        let set = NumericKey::set_all(&mut spec, values).map_err(AnalysisError::from);
        let found = set
            .and_then(|()| base.changed(spec))
            .and_then(|model| self.in_condition(&model, Effort::Screening));
        found.map_or(0.0, |found| found.expected_power_w[0])
    }

    fn in_condition(&self, model: &Model, effort: Effort) -> Result<InCondition, AnalysisError> {
        let goals = &self.problem.goals;
        let has_starts = self.problem.needs_starts();
        let mut found = match has_starts {
            true => attractors::evaluate(self.problem, model, effort)?,
            false => InCondition {
                goals: vec![f64::NAN; goals.len()],
                limits: vec![f64::NAN; self.problem.limits.len()],
                unknown_share: 0.0,
                expected_power_w: [0.0; 3],
                basin_fraction: [0.0; 3],
                orbits: Vec::new(),
            },
        };
        for (index, size) in self.problem.sizes() {
            found.limits[index] = size.of(&model.spec);
        }
        let needs_run = goals.iter().any(|goal| goal.needs_run());
        let run = match needs_run {
            true => Some(run_goals::run(self.problem, model, &mut found.limits)?),
            false => None,
        };
        // Branches cost most of an evaluation. A first evaluation omits them where the goals do not
        // matter: where it only looks for an orbit, or beyond a limit.
        let mut limits = self.problem.limits.iter().zip(&found.limits);
        let is_ranked = match effort {
            Effort::Probe => false,
            Effort::Screening => limits.all(|(limit, value)| limit.violation(*value) == 0.0),
            Effort::Full => true,
        };
        for (goal, value) in goals.iter().zip(&mut found.goals) {
            match goal {
                Goal::Bandwidth => {
                    let known = has_starts.then_some(&found.orbits[..]);
                    *value = match is_ranked {
                        true => bandwidth::half_power_hz(model, known)?,
                        false => 0.0,
                    };
                }
                Goal::MeanPower | Goal::TimeOn | Goal::PowerMargin => {
                    *value = run
                        .as_ref()
                        .map_or(f64::NAN, |run| run_goals::value(*goal, run));
                }
                Goal::ExpectedPower | Goal::StablePower => {}
            }
        }
        Ok(found)
    }

    /// Replaces the limited quantities of a run by the worst of all realisations of the noise in a
    /// condition.
    fn raise_by_noise(
        &self,
        model: &Model,
        number: usize,
        values: &mut [f64],
    ) -> Result<(), AnalysisError> {
        let seed = self.problem.noise_seed(number);
        let runs = run_goals::realised(self.problem, model, seed)?;
        let limits = self.problem.limits.iter().zip(values).enumerate();
        for (index, (limit, value)) in limits.filter(|(_, (limit, _))| limit.depends_on_run()) {
            let others = runs.iter().map(|run| run.limits[index]);
            *value = limit.worst(others.chain([*value]));
        }
        Ok(())
    }

    /// Combines the conditions: weighted means of the goals, the worst of the limits.
    fn together(&self, all: &[InCondition]) -> Evaluation {
        let problem = self.problem;
        let weights = || problem.conditions.iter().map(|condition| condition.weight);
        let total: f64 = weights().sum();
        let mean = |value: &dyn Fn(&InCondition) -> f64| {
            let terms = all.iter().zip(weights());
            terms.map(|(one, weight)| weight * value(one)).sum::<f64>() / total
        };
        let worst = |index: usize| {
            let values = all.iter().map(|one| one.limits[index]);
            problem.limits[index].worst(values)
        };
        let limits: Vec<f64> = (0..problem.limits.len()).map(worst).collect();
        let pairs = problem.limits.iter().zip(&limits);
        let violated: f64 = pairs.map(|(limit, value)| limit.violation(*value)).sum();
        let has_peaks = problem
            .limits
            .iter()
            .any(|limit| matches!(limit.quantity, LimitedQuantity::Peak(_)));
        let unknown = all.iter().map(|one| one.unknown_share).fold(0.0, f64::max);
        let least = all.iter().min_by(|a, b| {
            let share = |one: &InCondition| one.basin_fraction[0];
            share(a).total_cmp(&share(b))
        });
        Evaluation {
            goals: (0..problem.goals.len())
                .map(|goal| mean(&|one| one.goals[goal]))
                .collect(),
            limits,
            violation: violated + if has_peaks { unknown } else { 0.0 },
            unknown_share: unknown,
            expected_power_w: [0, 1, 2].map(|end| mean(&|one| one.expected_power_w[end])),
            basin_fraction: least.map_or([0.0; 3], |one| one.basin_fraction),
            orbit: all.first().and_then(|one| one.orbits.first().cloned()),
            further_orbits: all[1..]
                .iter()
                .map(|one| one.orbits.first().cloned())
                .collect(),
            failure: None,
        }
    }
}

fn bits(place: &[f64]) -> Vec<u64> {
    place.iter().map(|place| place.to_bits()).collect()
}
