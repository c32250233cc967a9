//! Detects features whose residuals at the optimum exceed any plausible measurement error: a
//! deviation estimated from residuals would read them as noise.

use std::f64::consts::TAU;

use jounce_model::structure::modes_holding;

use super::Deviation;
use super::measured::MeasuredNumber;
use super::problem::FitProblem;

/// Estimated deviation above which the model does not fit.
const MAX_FIT_DEVIATION: f64 = 0.05;

/// Returns one sentence for each group of features with a large deviation from residuals; `errors`
/// are relative to the deviations.
pub(super) fn discrepancies(problem: &FitProblem<'_>, errors: &[f64]) -> Vec<String> {
    let mut result = Vec::new();
    for (g, group) in problem.observations.groups.iter().enumerate() {
        if group.deviation != Deviation::Residuals || problem.deviation[g] <= MAX_FIT_DEVIATION {
            continue;
        }
        let of_group = || {
            problem
                .observations
                .measured
                .iter()
                .zip(errors)
                .filter(|(measured, _)| measured.group == g)
        };
        let Some((largest, error)) = of_group().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))
        else {
            continue;
        };
        // Errors of numbers without a scale are logarithms.
        let error = error * problem.deviation[g];
        let relative_error = if largest.scale.is_none() {
            error.exp_m1()
        } else {
            error
        };
        let hint = other_mode(problem, largest)
            .unwrap_or_else(|| "is the model missing something?".to_owned());
        result.push(format!(
            "the model misses {} by {:.0} % rms, {} by {:+.0} %: {hint} The intervals are \
            based on errors of the model",
            group.name,
            100.0 * problem.deviation[g],
            largest.name,
            100.0 * relative_error
        ));
    }
    result
}

/// Question about a frequency that is nearer to another mode of the initial model.
fn other_mode(problem: &FitProblem<'_>, measured: &MeasuredNumber) -> Option<String> {
    let number: usize = measured
        .name
        .strip_prefix("mode ")?
        .strip_suffix(" frequency")?
        .parse()
        .ok()?;
    let modes = modes_holding(problem.spec, problem.hold).ok()?;
    let hz: Vec<f64> = modes.frequency_rad_s.iter().map(|w| w / TAU).collect();
    let distance = |hz: &f64| (hz / measured.value).ln().abs();
    let (nearest, at_hz) = hz
        .iter()
        .enumerate()
        .min_by(|a, b| distance(a.1).total_cmp(&distance(b.1)))?;
    (nearest + 1 != number).then(|| {
        format!(
            "{} Hz is nearest to mode {} of the initial model, at {at_hz:.4} Hz; should a mass be \
            held (`hold`), or is a mode missing?",
            measured.value,
            nearest + 1
        )
    })
}
