//! The fit and what can be said of it.

use std::cell::{Cell, RefCell};

use jounce::spec::{Spec, SpecFile};
use levenberg_marquardt::LevenbergMarquardt;
use nalgebra::{DMatrix, DVector};

use super::problem::{Measured, Problem, measured};
use super::{Features, FitAnswer, FitError, FittedFeature, FittedKey};
use crate::modal::Mode;

/// A deviation after the test of more than this share of the one before: the test says nothing of the key.
const LEARNT: f64 = 0.8;
/// Two keys correlated beyond this cannot be told apart.
const APART: f64 = 0.95;

/// Fits the free keys of a spec, and gives the spec as fitted.
///
/// # Errors
/// A key that is not there or is 0, a mode that the model does not have, a structure without modes, no convergence.
///
/// # Limits
/// Covariance is that of the model linearised at the minimum. Modes are matched by their number: where two may change places, free less.
pub fn fit(file: &SpecFile, spec: &Spec, features: &Features) -> Result<(FitAnswer, Spec), FitError> {
    let (mut keys, mut start) = (Vec::new(), Vec::new());
    for (path, _) in &features.free {
        let key = file.numeric_key(path).map_err(|faults| FitError::Key { key: path.clone(), faults })?;
        let value = key.get(spec)?;
        if !(value != 0.0 && value.is_finite()) {
            return Err(FitError::Start { key: path.clone(), value });
        }
        keys.push(key);
        start.push(value);
    }
    let unknowns = DVector::zeros(keys.len());
    let prior = features.free.iter().map(|(_, deviation)| *deviation).collect();
    let problem = Problem {
        spec,
        hold: &features.hold,
        keys,
        start,
        prior,
        measured: measured(features),
        unknowns,
        evaluations: Cell::new(0),
        fault: RefCell::new(None),
    };
    let before = problem.model(&problem.unknowns)?;
    let (problem, report) = LevenbergMarquardt::new().with_ftol(1e-12).with_xtol(1e-10).with_patience(50).minimize(problem);
    if !report.termination.was_successful() {
        let evaluations = problem.evaluations.get();
        return Err(problem.fault.take().unwrap_or(FitError::NotConverged { evaluations }));
    }
    let answer = answer(&problem, &before)?;
    Ok((answer, problem.changed(&problem.unknowns)?))
}

fn answer(problem: &Problem<'_>, before: &[f64]) -> Result<FitAnswer, FitError> {
    let (count, features) = (problem.keys.len(), problem.measured.len());
    let errors = problem.errors(&problem.unknowns)?;
    let j = problem.derivatives()?;
    // The priors make every unknown determined, so that the matrix has an inverse.
    let evaluations = problem.evaluations.get();
    let covariance = (j.transpose() * &j).try_inverse().ok_or(FitError::NotConverged { evaluations })?;
    let deviation: Vec<f64> = (0..count).map(|k| covariance[(k, k)].sqrt()).collect();
    let key = |k: usize| {
        let after = problem.start[k] * problem.unknowns[k].exp();
        let end = |sign: f64| after * (sign * Mode::QUANTILE_95 * deviation[k]).exp();
        FittedKey {
            key: problem.keys[k].path().to_owned(),
            unit: problem.keys[k].unit(),
            before: problem.start[k],
            after,
            low: end(-1.0),
            high: end(1.0),
            prior_deviation: problem.prior[k],
            deviation: deviation[k],
        }
    };
    let after = problem.model(&problem.unknowns)?;
    let feature = |(i, measured): (usize, &Measured)| {
        let row = j.row(i) * measured.deviation;
        FittedFeature {
            name: format!("mode {} {}", measured.mode + 1, if measured.is_frequency { "frequency" } else { "damping ratio" }),
            unit: if measured.is_frequency { "Hz".to_owned() } else { String::new() },
            measured: measured.value,
            deviation: measured.deviation,
            before: before[i],
            after: after[i],
            predicted_deviation: (&row * &covariance * row.transpose())[(0, 0)].max(0.0).sqrt(),
        }
    };
    let correlation: Vec<Vec<f64>> =
        (0..count).map(|a| (0..count).map(|b| covariance[(a, b)] / (deviation[a] * deviation[b])).collect()).collect();
    let chi_square = errors.rows(0, features).norm_squared();
    Ok(FitAnswer {
        keys: (0..count).map(key).collect(),
        features: problem.measured.iter().enumerate().map(feature).collect(),
        warnings: warnings(problem, &j, &deviation, &correlation, chi_square),
        correlation,
        chi_square,
        objective: errors.norm_squared(),
        evaluations: problem.evaluations.get(),
    })
}

/// What the data cannot tell.
fn warnings(problem: &Problem<'_>, j: &DMatrix<f64>, deviation: &[f64], correlation: &[Vec<f64>], chi_square: f64) -> Vec<String> {
    let (count, features) = (problem.keys.len(), problem.measured.len());
    let path = |k: usize| problem.keys[k].path();
    let mut found = Vec::new();
    // Directions of the keys, each over its prior, that the features see better than the priors do.
    let scaled = DMatrix::from_fn(features, count, |i, k| j[(i, k)] * problem.prior[k]);
    let seen = scaled.singular_values().iter().filter(|s| **s > 1.0).count();
    if seen < count {
        found.push(format!("{features} features tell {seen} combinations of the {count} keys; the rest stays with the priors"));
    }
    for k in 0..count {
        let share = deviation[k] / problem.prior[k];
        if share > LEARNT {
            found.push(format!("the features say next to nothing of {}: its deviation is {:.0} % of the prior's", path(k), 100.0 * share));
        }
        let moved = problem.unknowns[k] / problem.prior[k];
        if moved.abs() > 2.0 {
            found.push(format!("{} went {:.1} deviations of its prior away: is the model missing something?", path(k), moved.abs()));
        }
        for other in (0..k).filter(|other| correlation[k][*other].abs() > APART) {
            found.push(format!("{} and {} cannot be told apart: correlation {:.3}", path(other), path(k), correlation[k][other]));
        }
    }
    // Mean plus three deviations of chi square where the features alone count.
    let freedom = features.saturating_sub(seen) as f64;
    if chi_square > freedom + 3.0 * (2.0 * freedom).sqrt() + 1.0 {
        found.push(format!(
            "the model misses the features by more than their deviations (chi square {chi_square:.1} for {freedom} degrees of freedom): the intervals are too narrow"
        ));
    }
    found
}
