//! Solves the fit and estimates deviations from its residuals.

use std::cell::{Cell, RefCell};
use std::path::Path;

use jounce_control::Control;
use jounce_spec::{NumericKey, Spec, SpecFile};
use levenberg_marquardt::{LevenbergMarquardt, TerminationReason};
use nalgebra::{DMatrix, DVector};

use super::deviation::{Deviation, MIN_DEVIATION};
use super::model::FitSource;
use super::observations::Observations;
use super::problem::FitProblem;
use super::{Features, FitError, FitResult};

/// Maximum number of iterations for deviations from residuals.
const MAX_ROUNDS: usize = 40;
const DEVIATION_ROUNDOFF: f64 = 1e-6;
/// Relative change below which a deviation has converged.
const DEVIATION_TOLERANCE: f64 = 1e-3;

/// Minimum with its derivatives and covariance.
pub(super) struct Minimum {
    /// Derivatives of the errors relative to their deviations.
    pub derivatives: DMatrix<f64>,
    /// Covariance of the logarithms of the keys.
    pub covariance: DMatrix<f64>,
    /// Remaining degrees of freedom of each group with an estimated deviation.
    pub freedom: Vec<Option<f64>>,
}

/// Fits the free keys of a spec and returns the result with the fitted spec. Files named in the
/// spec are relative to `folder`; `control` counts the evaluations of the model and can cancel
/// them.
///
/// A deviation `"residuals"` is estimated such that the residuals of its group have their expected
/// size, `s^2 = sum e^2 / (n - g)`. Here `e` are the errors of its `n` features and `g` is the
/// number of keys that they determine (the trace of their part of the hat matrix). It includes the
/// errors of the model.
///
/// # Errors
/// A key that does not exist or is 0, features that cannot be read or are not in the model, no
/// convergence, deviations that the features cannot determine, cancellation.
///
/// # Limits
/// The covariance and the prediction intervals are those of the model linearised at the minimum;
/// the intervals of the keys are not (see the module `profile`). Modes are matched by number: where
/// two may change order, free fewer keys.
///
/// # Source
/// D. MacKay, Bayesian interpolation, Neural Computation 4 (1992) 415, for deviations from
/// residuals.
pub fn fit(
    file: &SpecFile,
    spec: &Spec,
    features: &Features,
    folder: &Path,
    control: &Control,
) -> Result<(FitResult, Spec), FitError> {
    let Unknowns { keys, start, prior } = Unknowns::of(file, spec, &features.free)?;
    let observations = Observations::of(FitSource { file, folder }, features)?;
    let problem = FitProblem {
        spec,
        folder,
        hold: &features.hold,
        unknowns: DVector::zeros(keys.len()),
        keys,
        start,
        prior,
        deviation: observations
            .groups
            .iter()
            .map(|group| group.deviation.first())
            .collect(),
        observations: &observations,
        evaluations: Cell::new(0),
        control,
        fault: RefCell::new(None),
    };
    let before = problem.model(&problem.unknowns)?;
    let (problem, minimum) = converged(problem)?;
    let result = FitResult::of(&problem, &minimum, &before)?;
    Ok((result, problem.changed(&problem.unknowns)?))
}

/// Free keys, with their values in the spec and their relative deviations.
#[derive(Default)]
struct Unknowns {
    keys: Vec<NumericKey>,
    start: Vec<f64>,
    prior: Vec<f64>,
}

impl Unknowns {
    /// Expands a free list into its numbers.
    fn of(file: &SpecFile, spec: &Spec, free: &[(String, f64)]) -> Result<Self, FitError> {
        let mut unknowns = Self::default();
        for (path, deviation) in free {
            for key in file.numeric_keys(path).map_err(|faults| FitError::Key {
                key: path.clone(),
                faults,
            })? {
                let (value, path) = (key.get(spec)?, key.path());
                if !(value != 0.0 && value.is_finite()) {
                    return Err(FitError::Start {
                        key: path.to_owned(),
                        value,
                    });
                }
                if unknowns.keys.iter().any(|known| known.path() == path) {
                    return Err(FitError::Twice {
                        key: path.to_owned(),
                    });
                }
                unknowns.keys.push(key);
                unknowns.start.push(value);
                unknowns.prior.push(*deviation);
            }
        }
        Ok(unknowns)
    }
}

/// Repeats the fit until the deviations from residuals have converged.
fn converged(mut problem: FitProblem<'_>) -> Result<(FitProblem<'_>, Minimum), FitError> {
    for _ in 0..MAX_ROUNDS {
        problem = minimised(problem)?;
        let minimum = minimum(&problem)?;
        let errors = problem.errors(&problem.unknowns)?;
        let mut max_change: f64 = 0.0;
        for (g, freedom) in minimum.freedom.iter().enumerate() {
            let Some(freedom) = freedom else { continue };
            let of_group = problem
                .observations
                .measured
                .iter()
                .enumerate()
                .filter(|(_, measured)| measured.group == g);
            let mean_square = of_group.map(|(i, _)| errors[i].powi(2)).sum::<f64>() / freedom;
            let previous = problem.deviation[g];
            problem.deviation[g] = (previous * mean_square.sqrt()).max(MIN_DEVIATION);
            max_change = max_change.max((problem.deviation[g] / previous - 1.0).abs());
        }
        if max_change < DEVIATION_TOLERANCE {
            return Ok((problem, minimum));
        }
    }
    Err(FitError::NotConverged {
        evaluations: problem.evaluations.get(),
    })
}

fn minimised(problem: FitProblem<'_>) -> Result<FitProblem<'_>, FitError> {
    let (problem, report) = LevenbergMarquardt::new()
        .with_ftol(1e-12)
        .with_xtol(1e-10)
        .with_patience(50)
        .minimize(problem);
    // If the remaining decrease is below the noise of the runs, accept the minimum.
    let is_successful = report.termination.was_successful()
        || matches!(
            report.termination,
            TerminationReason::NoImprovementPossible(_)
        );
    if is_successful {
        return Ok(problem);
    }
    let evaluations = problem.evaluations.get();
    Err(problem
        .fault
        .take()
        .unwrap_or(FitError::NotConverged { evaluations }))
}

fn minimum(problem: &FitProblem<'_>) -> Result<Minimum, FitError> {
    let derivatives = problem.derivatives()?;
    // The priors determine every unknown, so the matrix has an inverse.
    let evaluations = problem.evaluations.get();
    let covariance = (derivatives.transpose() * &derivatives)
        .try_inverse()
        .ok_or(FitError::NotConverged { evaluations })?;
    let freedom = |g: usize| {
        let group = &problem.observations.groups[g];
        if group.deviation != Deviation::Residuals {
            return Ok(None);
        }
        let of_group = || {
            problem
                .observations
                .measured
                .iter()
                .enumerate()
                .filter(|(_, measured)| measured.group == g)
                .map(|(i, _)| i)
        };
        let used: f64 = of_group()
            .map(|i| (derivatives.row(i) * &covariance * derivatives.row(i).transpose())[(0, 0)])
            .sum();
        let features = of_group().count();
        let remaining = features as f64 - used;
        if remaining < 1.0 - DEVIATION_ROUNDOFF {
            Err(FitError::NoResiduals {
                name: group.name.clone(),
                features,
                taken: used,
            })
        } else {
            Ok(Some(remaining.max(1.0)))
        }
    };
    let freedom = (0..problem.observations.groups.len())
        .map(freedom)
        .collect::<Result<_, FitError>>()?;
    Ok(Minimum {
        derivatives,
        covariance,
        freedom,
    })
}
