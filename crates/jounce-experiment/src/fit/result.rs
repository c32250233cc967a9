//! Results of a fit.

use nalgebra::DMatrix;
use serde::Serialize;

use super::FitError;
use super::deviation::DeviationGroup;
use super::discrepancy::discrepancies;
use super::intervals::{curve, feature_results, fitted_keys};
use super::problem::FitProblem;
use super::solve::Minimum;
use super::warnings::warnings;
use jounce_signal::NORMAL_95;
use jounce_signal::spectral::student_95;

/// Key before and after the fit.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FittedKey {
    /// Path of the key.
    pub key: String,
    /// SI unit.
    pub unit: String,
    /// Value before, SI.
    pub before: f64,
    /// Value after, SI.
    pub after: f64,
    /// Lower end of the 95 % confidence interval by profile likelihood, SI; the interval may be
    /// asymmetric.
    pub low: f64,
    /// Upper end, SI.
    pub high: f64,
    /// Relative standard deviation of the prior.
    pub prior_deviation: f64,
    /// Relative standard deviation after the fit.
    pub deviation: f64,
}

/// Feature before and after the fit.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FittedFeature {
    /// Name, such as `mode 1 frequency`.
    pub name: String,
    /// Unit.
    pub unit: String,
    /// Measured value.
    pub measured: f64,
    /// Relative standard deviation of the measurement.
    pub deviation: f64,
    /// Value of the model before the fit.
    pub before: f64,
    /// Value of the model after the fit.
    pub after: f64,
    /// Relative standard deviation of the model's prediction after the fit, propagated from the
    /// keys.
    pub predicted_deviation: f64,
    /// Lower end of the 95 % prediction interval of a further measurement.
    pub low: f64,
    /// Upper end of that interval.
    pub high: f64,
}

/// Measured curve before and after the fit: a frequency response or a time history.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FittedCurve {
    /// Name, such as `mfc.voltage`.
    pub name: String,
    /// Unit.
    pub unit: String,
    /// Independent variable, `frequency_hz` or `time_s`.
    pub over: String,
    /// Values of the independent variable.
    pub at: Vec<f64>,
    /// Measured values.
    pub measured: Vec<f64>,
    /// Values of the model before the fit.
    pub before: Vec<f64>,
    /// Values of the model after the fit.
    pub after: Vec<f64>,
    /// Lower ends of the 95 % prediction intervals of further measurements.
    pub low: Vec<f64>,
    /// Upper ends of those intervals.
    pub high: Vec<f64>,
}

/// Standard deviation shared by several features.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FittedDeviation {
    /// Name of the features.
    pub name: String,
    /// Relative standard deviation.
    pub deviation: f64,
    /// Degrees of freedom if estimated from residuals; `None` if given.
    pub degrees_of_freedom: Option<f64>,
}

/// Keys, features, and their uncertainty.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FitResult {
    /// Fitted keys.
    pub keys: Vec<FittedKey>,
    /// Features that are single numbers.
    pub features: Vec<FittedFeature>,
    /// Features that are curves.
    pub curves: Vec<FittedCurve>,
    /// Standard deviations of the features.
    pub deviations: Vec<FittedDeviation>,
    /// Half-width of the 95 % intervals in standard deviations: the Student quantile where a
    /// deviation comes from residuals.
    pub quantile: f64,
    /// Correlation matrix of the keys.
    pub correlation: Vec<Vec<f64>>,
    /// Sum of the squared errors of the features over their variances.
    pub chi_square: f64,
    /// Minimised objective: chi square plus the prior terms of the keys.
    pub objective: f64,
    /// Warnings about undetermined quantities, one sentence each.
    pub warnings: Vec<String>,
    /// Evaluations of the model.
    pub evaluations: usize,
}

impl FittedFeature {
    /// Relative error before and after the fit.
    pub fn errors(&self) -> (f64, f64) {
        (
            self.before / self.measured - 1.0,
            self.after / self.measured - 1.0,
        )
    }
}

impl FittedCurve {
    /// RMS errors before and after, relative to the RMS of the measured curve.
    pub fn errors(&self) -> (f64, f64) {
        let rms = |value: &dyn Fn(usize) -> f64| {
            (0..self.at.len())
                .map(|k| value(k).powi(2))
                .sum::<f64>()
                .sqrt()
        };
        let measured_rms = rms(&|k| self.measured[k]);
        (
            rms(&|k| self.before[k] - self.measured[k]) / measured_rms,
            rms(&|k| self.after[k] - self.measured[k]) / measured_rms,
        )
    }
}

impl FitResult {
    pub(super) fn of(
        problem: &FitProblem<'_>,
        minimum: &Minimum,
        before: &[f64],
    ) -> Result<Self, FitError> {
        let (count, observations) = (problem.keys.len(), problem.observations);
        let estimated: Vec<f64> = minimum.freedom.iter().flatten().copied().collect();
        let quantile = if estimated.is_empty() {
            NORMAL_95
        } else {
            student_95(estimated.iter().sum())
        };
        let deviation: Vec<f64> = (0..count)
            .map(|k| minimum.covariance[(k, k)].sqrt())
            .collect();
        let correlation = correlation(&minimum.covariance, &deviation);
        let errors = problem.errors(&problem.unknowns)?;
        let chi_square = errors.rows(0, observations.measured.len()).norm_squared();
        let (keys, linear) = fitted_keys(problem, minimum, &errors, (&deviation, quantile))?;
        let results = feature_results(
            problem,
            minimum,
            (before, &problem.model(&problem.unknowns)?),
            quantile,
        );
        Ok(Self {
            keys,
            features: results
                .iter()
                .filter(|result| result.measured.on.is_none())
                .map(|result| result.feature.clone())
                .collect(),
            curves: (0..observations.curves.len())
                .map(|number| curve(problem, &results, number))
                .collect(),
            deviations: group_deviations(problem, minimum),
            warnings: [
                observations.warnings.clone(),
                discrepancies(problem, errors.as_slice()),
                warnings(
                    problem,
                    minimum,
                    &deviation,
                    (&correlation, &linear),
                    chi_square,
                ),
            ]
            .concat(),
            quantile,
            correlation,
            chi_square,
            objective: errors.norm_squared(),
            evaluations: problem.evaluations.get(),
        })
    }
}

/// Deviations shared by the features of each group.
fn group_deviations(problem: &FitProblem<'_>, minimum: &Minimum) -> Vec<FittedDeviation> {
    let of_group = |(g, group): (usize, &DeviationGroup)| FittedDeviation {
        name: group.name.clone(),
        deviation: problem.deviation[g],
        degrees_of_freedom: minimum.freedom[g],
    };
    problem
        .observations
        .groups
        .iter()
        .enumerate()
        .map(of_group)
        .collect()
}

/// Correlation matrix of the keys.
fn correlation(covariance: &DMatrix<f64>, deviation: &[f64]) -> Vec<Vec<f64>> {
    let keys = || 0..deviation.len();
    keys()
        .map(|a| {
            keys()
                .map(|b| covariance[(a, b)] / (deviation[a] * deviation[b]))
                .collect()
        })
        .collect()
}
