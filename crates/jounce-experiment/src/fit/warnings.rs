//! Warnings about quantities that the data of a fit do not determine.

use nalgebra::DMatrix;

use super::Deviation;
use super::problem::FitProblem;
use super::solve::Minimum;

/// Ratio of posterior to prior deviation above which the test contains no information on the key.
const MAX_POSTERIOR_RATIO: f64 = 0.8;
/// Correlation above which two keys cannot be distinguished.
const MAX_CORRELATION: f64 = 0.95;

/// Returns one sentence for each undetermined quantity; `linear` names the keys whose interval
/// could not be profiled.
pub(super) fn warnings(
    problem: &FitProblem<'_>,
    minimum: &Minimum,
    deviation: &[f64],
    (correlation, linear): (&[Vec<f64>], &[&str]),
    chi_square: f64,
) -> Vec<String> {
    let (count, features) = (problem.keys.len(), problem.observations.measured.len());
    let path = |k: usize| problem.keys[k].path();
    let mut result = Vec::new();
    // Directions of the keys, each relative to its prior, that the features determine better than
    // the priors do.
    let scaled = DMatrix::from_fn(features, count, |i, k| {
        minimum.derivatives[(i, k)] * problem.prior[k]
    });
    let sensitivity = scaled
        .singular_values()
        .iter()
        .filter(|s| **s > 1.0)
        .count();
    if sensitivity < count {
        result.push(format!(
            "{features} features determine {sensitivity} combinations of the {count} \
            keys; the others remain at the priors"
        ));
    }
    for k in 0..count {
        let deviation_ratio = deviation[k] / problem.prior[k];
        if deviation_ratio > MAX_POSTERIOR_RATIO {
            result.push(format!(
                "the features contain almost no information on {}: its deviation is {:.0} % of \
                the prior's",
                path(k),
                100.0 * deviation_ratio
            ));
        }
        let shift_ratio = problem.unknowns[k] / problem.prior[k];
        if shift_ratio.abs() > 2.0 {
            result.push(format!(
                "{} moved by {:.1} standard deviations of its prior: is the model missing \
                something?",
                path(k),
                shift_ratio.abs()
            ));
        }
        for other in (0..k).filter(|other| correlation[k][*other].abs() > MAX_CORRELATION) {
            result.push(format!(
                "{} and {} cannot be distinguished: correlation {:.3}",
                path(other),
                path(k),
                correlation[k][other]
            ));
        }
    }
    for key in linear {
        result.push(format!(
            "the model cannot be evaluated at both ends of the interval of {key}: the interval is \
            from the linearised model there"
        ));
    }
    for (group, freedom) in problem
        .observations
        .groups
        .iter()
        .zip(&minimum.freedom)
        .filter_map(|(group, freedom)| Some((group, (*freedom)?)))
    {
        if freedom < 3.0 {
            result.push(format!(
                "the deviation of {} is estimated from residuals with {freedom:.1} degrees of \
                freedom: it is very uncertain, and so are the intervals",
                group.name
            ));
        }
    }
    // Mean plus three deviations of chi square if the deviations are given; an estimated deviation
    // always fits.
    let freedom = features.saturating_sub(sensitivity) as f64;
    let are_deviations_fixed = problem
        .observations
        .groups
        .iter()
        .all(|group| group.deviation != Deviation::Residuals);
    if are_deviations_fixed && chi_square > freedom + 3.0 * (2.0 * freedom).sqrt() + 1.0 {
        result.push(format!(
            "the model misses the features by more than their deviations (chi square {chi_square:.1} for {freedom} degrees of freedom): the intervals are too narrow"
        ));
    }
    result
}
