//! The best design under other realisations of the noise than that of the search: its mean power and
//! its limits.

use crate::DesignError;
use crate::evaluation::{Evaluator, REALISATIONS, RealisedRun, realised};
use crate::problem::{Goal, Problem};
use crate::result::{NoiseLimit, NoisePower};
use jounce_analysis::{Estimate, IntervalOver, wilson};

/// Runs of a design under other realisations of its noise: of each condition, those of all
/// realisations.
pub struct Noise<'p> {
    problem: &'p Problem,
    runs: Vec<Vec<RealisedRun>>,
}

impl<'p> Noise<'p> {
    /// Runs a design under the realisations; `None` where no goal is one of a run, without noise, or
    /// where the search was stopped.
    pub fn of(evaluator: &Evaluator<'p>, place: &[f64]) -> Result<Option<Self>, DesignError> {
        let problem = evaluator.problem;
        if !problem.realises_noise() {
            return Ok(None);
        }
        let mut all = Vec::with_capacity(problem.conditions.len());
        for (number, condition) in problem.conditions.iter().enumerate() {
            let model = evaluator.model(place, condition)?;
            match realised(problem, &model, problem.noise_seed(number)) {
                Ok(runs) => all.push(runs),
                Err(_) if evaluator.control.is_stopped() => return Ok(None),
                Err(error) => return Err(error.into()),
            }
        }
        Ok(Some(Self { problem, runs: all }))
    }

    /// Returns the mean power, as the weighted mean over the conditions; `None` without a goal
    /// `mean-power`.
    pub fn power(&self) -> Option<NoisePower> {
        if !self.problem.goals.contains(&Goal::MeanPower) {
            return None;
        }
        let weights = self.problem.conditions.iter().map(|one| one.weight);
        let total: f64 = weights.clone().sum();
        let (mut mean_power_w, mut half_width_squared) = (0.0_f64, 0.0_f64);
        for (runs, weight) in self.runs.iter().zip(weights) {
            let powers_w: Vec<f64> = runs.iter().map(|run| run.mean_power_w).collect();
            let power_w = Estimate::of(&powers_w, IntervalOver::Members);
            let share = weight / total;
            mean_power_w += share * power_w.mean;
            half_width_squared += (share * power_w.half_width).powi(2);
        }
        let half_width_w = half_width_squared.sqrt();
        Some(NoisePower {
            realisations: REALISATIONS,
            mean_power_w,
            mean_power_low_w: mean_power_w - half_width_w,
            mean_power_high_w: mean_power_w + half_width_w,
        })
    }

    /// Returns a limit in the realisations; `None` for one that does not depend on a run.
    pub fn limit(&self, index: usize) -> Option<NoiseLimit> {
        let limit = &self.problem.limits[index];
        if !limit.depends_on_run() {
            return None;
        }
        let is_exceeded = |member: &usize| {
            let conditions = self.runs.iter().map(|runs| runs[*member].limits[index]);
            limit.violation(limit.worst(conditions)) > 0.0
        };
        let exceeded = (0..REALISATIONS).filter(is_exceeded).count();
        let fraction = wilson(exceeded, REALISATIONS);
        Some(NoiseLimit {
            realisations: REALISATIONS,
            exceeded,
            exceeded_fraction_low: fraction.low,
            exceeded_fraction_high: fraction.high,
        })
    }
}
