//! What the data of a fit cannot tell.

use nalgebra::DMatrix;

use super::Deviation;
use super::problem::FitProblem;
use super::solve::Minimum;

/// A deviation after the test of more than this share of the one before: the test says nothing of the key.
const MAX_POSTERIOR_RATIO: f64 = 0.8;
/// Two keys correlated beyond this cannot be told apart.
const MAX_CORRELATION: f64 = 0.95;

/// One sentence for each thing that the features cannot tell; `linear` names the keys whose interval could not be followed.
pub(super) fn warnings(
    problem: &FitProblem<'_>,
    minimum: &Minimum,
    deviation: &[f64],
    (correlation, linear): (&[Vec<f64>], &[&str]),
    chi_square: f64,
) -> Vec<String> {
    let (count, features) = (problem.keys.len(), problem.asked.measured.len());
    let path = |k: usize| problem.keys[k].path();
    let mut found = Vec::new();
    // Directions of the keys, each over its prior, that the features see better than the priors do.
    let scaled = DMatrix::from_fn(features, count, |i, k| {
        minimum.derivatives[(i, k)] * problem.prior[k]
    });
    let seen = scaled
        .singular_values()
        .iter()
        .filter(|s| **s > 1.0)
        .count();
    if seen < count {
        found.push(format!("{features} features tell {seen} combinations of the {count} keys; the rest stays with the priors"));
    }
    for k in 0..count {
        let share = deviation[k] / problem.prior[k];
        if share > MAX_POSTERIOR_RATIO {
            found.push(format!(
                "the features say next to nothing of {}: its deviation is {:.0} % of the prior's",
                path(k),
                100.0 * share
            ));
        }
        let moved = problem.unknowns[k] / problem.prior[k];
        if moved.abs() > 2.0 {
            found.push(format!(
                "{} went {:.1} deviations of its prior away: is the model missing something?",
                path(k),
                moved.abs()
            ));
        }
        for other in (0..k).filter(|other| correlation[k][*other].abs() > MAX_CORRELATION) {
            found.push(format!(
                "{} and {} cannot be told apart: correlation {:.3}",
                path(other),
                path(k),
                correlation[k][other]
            ));
        }
    }
    for key in linear {
        found.push(format!("the model cannot be followed to both ends of the interval of {key}: it is that of the linearised model there"));
    }
    for (group, freedom) in problem
        .asked
        .groups
        .iter()
        .zip(&minimum.freedom)
        .filter_map(|(group, freedom)| Some((group, (*freedom)?)))
    {
        if freedom < 3.0 {
            found.push(format!(
                "the deviation of {} comes from residuals of {freedom:.1} degrees of freedom: it is hardly known, and so are the intervals",
                group.name
            ));
        }
    }
    // Mean plus three deviations of chi square where the features alone count; a deviation from residuals makes it fit.
    let freedom = features.saturating_sub(seen) as f64;
    let given = problem
        .asked
        .groups
        .iter()
        .all(|group| group.deviation != Deviation::Residuals);
    if given && chi_square > freedom + 3.0 * (2.0 * freedom).sqrt() + 1.0 {
        found.push(format!(
            "the model misses the features by more than their deviations (chi square {chi_square:.1} for {freedom} degrees of freedom): the intervals are too narrow"
        ));
    }
    found
}
