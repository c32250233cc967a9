//! Mean power of the best design under other realisations of the noise than that of the search.

use crate::DesignError;
use crate::evaluation::Evaluator;
use crate::problem::Goal;
use crate::result::NoisePower;
use jounce_analysis::{AnalysisError, Ensemble, Estimate};

/// Returns the mean power of a design under fresh realisations of the noise, as the weighted mean over
/// the conditions; `None` without a goal `mean-power`, without noise, or where the search was stopped.
pub fn noise_power(
    evaluator: &Evaluator<'_>,
    place: &[f64],
) -> Result<Option<NoisePower>, DesignError> {
    let problem = evaluator.problem;
    if !problem.goals.contains(&Goal::MeanPower) {
        return Ok(None);
    }
    let total: f64 = problem.conditions.iter().map(|one| one.weight).sum();
    let (mut mean_power_w, mut half_width_squared) = (0.0_f64, 0.0_f64);
    for (number, condition) in problem.conditions.iter().enumerate() {
        let model = evaluator.model(place, condition)?;
        let ensemble = Ensemble {
            base: &model,
            start: model.start(&problem.folder)?,
            members: Ensemble::DEFAULT_MEMBERS,
            seed: problem.seed.wrapping_add(number as u64),
            relative_width: None,
            most_rounds: 1,
            with_spectrum: false,
        };
        let power_w: Estimate = match ensemble.run() {
            Ok(found) if found.members.len() == Ensemble::DEFAULT_MEMBERS => found.power_w,
            Ok(_) | Err(AnalysisError::NoNoise) => return Ok(None),
            Err(error) => return Err(error.into()),
        };
        let share = condition.weight / total;
        mean_power_w += share * power_w.mean;
        half_width_squared += (share * power_w.half_width).powi(2);
    }
    let half_width_w = half_width_squared.sqrt();
    Ok(Some(NoisePower {
        realisations: Ensemble::DEFAULT_MEMBERS,
        mean_power_w,
        mean_power_low_w: mean_power_w - half_width_w,
        mean_power_high_w: mean_power_w + half_width_w,
    }))
}
