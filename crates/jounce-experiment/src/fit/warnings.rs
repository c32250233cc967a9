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
    let mut result = Vec::new();
    let sensitivity = determined_combinations(problem, minimum);
    if sensitivity < count {
        result.push(format!(
            "{features} features determine {sensitivity} combinations of the {count} \
            keys; the others remain at the priors"
        ));
    }
    for k in 0..count {
        result.extend(key_warnings(problem, k, deviation[k]));
        result.extend(indistinguishable(problem, k, &correlation[k]));
    }
    for key in linear {
        result.push(format!(
            "the model cannot be evaluated at both ends of the interval of {key}: the interval is \
            from the linearised model there"
        ));
    }
    result.extend(uncertain_deviations(problem, minimum));
    result.extend(large_errors(
        problem,
        chi_square,
        features.saturating_sub(sensitivity) as f64,
    ));
    result
}

/// Number of directions of the keys, each relative to its prior, that the features determine better
/// than the priors do.
fn determined_combinations(problem: &FitProblem<'_>, minimum: &Minimum) -> usize {
    let (count, features) = (problem.keys.len(), problem.observations.measured.len());
    let scaled = DMatrix::from_fn(features, count, |i, k| {
        minimum.derivatives[(i, k)] * problem.prior[k]
    });
    scaled
        .singular_values()
        .iter()
        .filter(|s| **s > 1.0)
        .count()
}

/// Warnings about a key relative to its prior.
fn key_warnings(problem: &FitProblem<'_>, k: usize, deviation: f64) -> Vec<String> {
    let (path, prior) = (problem.keys[k].path(), problem.prior[k]);
    let mut result = Vec::new();
    let deviation_ratio = deviation / prior;
    if deviation_ratio > MAX_POSTERIOR_RATIO {
        result.push(format!(
            "the features contain almost no information on {path}: its deviation is {:.0} % of \
            the prior's",
            100.0 * deviation_ratio
        ));
    }
    let shift_ratio = problem.unknowns[k] / prior;
    if shift_ratio.abs() > 2.0 {
        result.push(format!(
            "{path} moved by {:.1} standard deviations of its prior: is the model missing \
            something?",
            shift_ratio.abs()
        ));
    }
    result
}

/// Warnings about earlier keys that cannot be distinguished from a key.
fn indistinguishable<'p>(
    problem: &'p FitProblem<'_>,
    k: usize,
    correlation: &'p [f64],
) -> impl Iterator<Item = String> + 'p {
    (0..k)
        .filter(|other| correlation[*other].abs() > MAX_CORRELATION)
        .map(move |other| {
            format!(
                "{} and {} cannot be distinguished: correlation {:.3}",
                problem.keys[other].path(),
                problem.keys[k].path(),
                correlation[other]
            )
        })
}

/// Warnings about deviations from few residuals.
fn uncertain_deviations(problem: &FitProblem<'_>, minimum: &Minimum) -> Vec<String> {
    let groups = problem.observations.groups.iter().zip(&minimum.freedom);
    groups
        .filter_map(|(group, freedom)| Some((group, (*freedom)?)))
        .filter(|(_, freedom)| *freedom < 3.0)
        .map(|(group, freedom)| {
            format!(
                "the deviation of {} is estimated from residuals with {freedom:.1} degrees of \
                freedom: it is very uncertain, and so are the intervals",
                group.name
            )
        })
        .collect()
}

/// Warning about errors beyond the mean plus three deviations of chi square, if the deviations are
/// given; an estimated deviation always fits.
fn large_errors(problem: &FitProblem<'_>, chi_square: f64, freedom: f64) -> Option<String> {
    let are_deviations_fixed = problem
        .observations
        .groups
        .iter()
        .all(|group| group.deviation != Deviation::Residuals);
    (are_deviations_fixed && chi_square > freedom + 3.0 * (2.0 * freedom).sqrt() + 1.0).then(|| {
        format!(
            "the model misses the features by more than their deviations (chi square {chi_square:.1} for {freedom} degrees of freedom): the intervals are too narrow"
        )
    })
}
