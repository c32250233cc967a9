//! The fit, and the deviations that its residuals tell.

use std::cell::{Cell, RefCell};
use std::path::Path;

use jounce::integrate::Control;
use jounce::spec::{NumericKey, Spec, SpecFile};
use levenberg_marquardt::{LevenbergMarquardt, TerminationReason};
use nalgebra::{DMatrix, DVector};

use super::deviation::{Deviation, MIN_DEVIATION};
use super::model::FitSource;
use super::observations::Observations;
use super::problem::FitProblem;
use super::{Features, FitError, FitResult};

/// Rounds in which deviations are taken from residuals.
const MAX_ROUNDS: usize = 40;
const DEVIATION_ROUNDOFF: f64 = 1e-6;
/// A deviation that changes by less than this share is found.
const DEVIATION_TOLERANCE: f64 = 1e-3;

/// A minimum and what surrounds it.
pub(super) struct Minimum {
    /// Derivatives of the errors over their deviations.
    pub derivatives: DMatrix<f64>,
    /// Covariance of the logarithms of the keys.
    pub covariance: DMatrix<f64>,
    /// Degrees of freedom that are left to each group whose deviation is estimated.
    pub freedom: Vec<Option<f64>>,
}

/// Fits the free keys of a spec, and gives the spec as fitted. Files that the spec names lie in `folder`; `control` counts the evaluations of
/// the model and ends them early.
///
/// A deviation `"residuals"` is that at which the residuals of its group have the size that is expected of them,
/// `s^2 = sum e^2 / (n - g)`, with `e` the errors of its `n` features and `g` the number of keys that they determine (the trace of their part of
/// the hat matrix); it holds the errors of the model too.
///
/// # Errors
/// A key that is not there or is 0, features that cannot be read or that the model does not have, no convergence, deviations that the features
/// cannot tell, the wish to stop.
///
/// # Limits
/// Covariance, and with it intervals of predictions, are those of the model linearised at the minimum; intervals of the keys are not (see
/// the module `profile`). Modes are matched by their number: where two may change places, free less.
///
/// # Source
/// D. MacKay, Bayesian interpolation, Neural Computation 4 (1992) 415, for deviations from residuals.
pub fn fit(
    file: &SpecFile,
    spec: &Spec,
    features: &Features,
    folder: &Path,
    control: &Control,
) -> Result<(FitResult, Spec), FitError> {
    let Unknowns { keys, start, prior } = Unknowns::of(file, spec, &features.free)?;
    let asked = Observations::of(FitSource { file, folder }, features)?;
    let problem = FitProblem {
        spec,
        folder,
        hold: &features.hold,
        unknowns: DVector::zeros(keys.len()),
        keys,
        start,
        prior,
        deviation: asked
            .groups
            .iter()
            .map(|group| group.deviation.first())
            .collect(),
        asked: &asked,
        evaluations: Cell::new(0),
        control,
        fault: RefCell::new(None),
    };
    let before = problem.model(&problem.unknowns)?;
    let (problem, minimum) = settled(problem)?;
    let answer = FitResult::of(&problem, &minimum, &before)?;
    Ok((answer, problem.changed(&problem.unknowns)?))
}

/// The free keys one by one, their values in the spec, and their relative deviations.
#[derive(Default)]
struct Unknowns {
    keys: Vec<NumericKey>,
    start: Vec<f64>,
    prior: Vec<f64>,
}

impl Unknowns {
    /// A list is free in each of its numbers.
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

/// Fits, and again until the deviations that come from residuals stay.
fn settled(mut problem: FitProblem<'_>) -> Result<(FitProblem<'_>, Minimum), FitError> {
    for _ in 0..MAX_ROUNDS {
        problem = minimised(problem)?;
        let minimum = minimum(&problem)?;
        let errors = problem.errors(&problem.unknowns)?;
        let mut moved: f64 = 0.0;
        for (g, freedom) in minimum.freedom.iter().enumerate() {
            let Some(freedom) = freedom else { continue };
            let of_group = problem
                .asked
                .measured
                .iter()
                .enumerate()
                .filter(|(_, measured)| measured.group == g);
            let size = of_group.map(|(i, _)| errors[i].powi(2)).sum::<f64>() / freedom;
            let before = problem.deviation[g];
            problem.deviation[g] = (before * size.sqrt()).max(MIN_DEVIATION);
            moved = moved.max((problem.deviation[g] / before - 1.0).abs());
        }
        if moved < DEVIATION_TOLERANCE {
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
    // Where the noise of a march hides what is left to gain, the minimum is as good as found.
    let found = report.termination.was_successful()
        || matches!(
            report.termination,
            TerminationReason::NoImprovementPossible(_)
        );
    if found {
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
    // The priors make every unknown determined, so that the matrix has an inverse.
    let evaluations = problem.evaluations.get();
    let covariance = (derivatives.transpose() * &derivatives)
        .try_inverse()
        .ok_or(FitError::NotConverged { evaluations })?;
    let freedom = |g: usize| {
        let group = &problem.asked.groups[g];
        if group.deviation != Deviation::Residuals {
            return Ok(None);
        }
        let of_group = || {
            problem
                .asked
                .measured
                .iter()
                .enumerate()
                .filter(|(_, measured)| measured.group == g)
                .map(|(i, _)| i)
        };
        let taken: f64 = of_group()
            .map(|i| (derivatives.row(i) * &covariance * derivatives.row(i).transpose())[(0, 0)])
            .sum();
        let features = of_group().count();
        let left = features as f64 - taken;
        if left < 1.0 - DEVIATION_ROUNDOFF {
            Err(FitError::NoResiduals {
                name: group.name.clone(),
                features,
                taken,
            })
        } else {
            Ok(Some(left.max(1.0)))
        }
    };
    let freedom = (0..problem.asked.groups.len())
        .map(freedom)
        .collect::<Result<_, FitError>>()?;
    Ok(Minimum {
        derivatives,
        covariance,
        freedom,
    })
}
