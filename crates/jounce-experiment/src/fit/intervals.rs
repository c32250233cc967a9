//! Keys, features and curves of a fit with their 95 % intervals.

use nalgebra::DVector;

use super::measured::MeasuredNumber;
use super::problem::FitProblem;
use super::profile::Profile;
use super::solve::Minimum;
use super::{FitError, FittedCurve, FittedFeature, FittedKey};

/// Keys with their intervals by profile likelihood, and the paths of those whose profile has no
/// end.
pub(super) fn fitted_keys<'p>(
    problem: &'p FitProblem<'_>,
    minimum: &Minimum,
    errors: &DVector<f64>,
    (deviation, quantile): (&[f64], f64),
) -> Result<(Vec<FittedKey>, Vec<&'p str>), FitError> {
    let profile = Profile {
        errors: &|unknowns| problem.errors(unknowns),
        least: &problem.unknowns,
        at_least: errors,
        objective: errors.norm_squared(),
        derivatives: &minimum.derivatives,
        covariance: &minimum.covariance,
    };
    let (mut keys, mut linear) = (Vec::with_capacity(deviation.len()), Vec::new());
    for (k, deviation) in deviation.iter().enumerate() {
        let ends = [profile.end(k, -quantile)?, profile.end(k, quantile)?];
        if ends.contains(&None) {
            linear.push(problem.keys[k].path());
        }
        keys.push(key(problem, k, (*deviation, quantile), ends));
    }
    Ok((keys, linear))
}

/// Where the profile has no end, the interval of the covariance is used.
fn key(
    problem: &FitProblem<'_>,
    k: usize,
    (deviation, quantile): (f64, f64),
    profile: [Option<f64>; 2],
) -> FittedKey {
    let (least, start) = (problem.unknowns[k], problem.start[k]);
    let after = start * least.exp();
    let end = |(profile, sign): (Option<f64>, f64)| {
        start * profile.unwrap_or(least + sign * quantile * deviation).exp()
    };
    let ends = [(profile[0], -1.0), (profile[1], 1.0)].map(end);
    FittedKey {
        key: problem.keys[k].path().to_owned(),
        unit: problem.keys[k].unit(),
        before: problem.start[k],
        after,
        low: ends[0].min(ends[1]),
        high: ends[0].max(ends[1]),
        prior_deviation: problem.prior[k],
        deviation,
    }
}

/// Measured number with its results.
pub(super) struct FeatureResult<'m> {
    pub measured: &'m MeasuredNumber,
    pub feature: FittedFeature,
}

/// Values and prediction intervals of all measured numbers.
pub(super) fn feature_results<'m>(
    problem: &'m FitProblem<'_>,
    minimum: &Minimum,
    (before, after): (&[f64], &[f64]),
    quantile: f64,
) -> Vec<FeatureResult<'m>> {
    let feature_result = |(i, measured): (usize, &'m MeasuredNumber)| {
        let deviation = problem.deviation_of(measured);
        let row = minimum.derivatives.row(i) * deviation;
        let predicted_deviation = (&row * &minimum.covariance * row.transpose())[(0, 0)]
            .max(0.0)
            .sqrt();
        let half_width = quantile * deviation.hypot(predicted_deviation);
        let ends = [-half_width, half_width].map(|error| measured.shifted(after[i], error));
        let feature = FittedFeature {
            name: measured.name.clone(),
            unit: measured.unit.clone(),
            measured: measured.value,
            deviation,
            before: before[i],
            after: after[i],
            predicted_deviation,
            low: ends[0].min(ends[1]),
            high: ends[0].max(ends[1]),
        };
        FeatureResult { measured, feature }
    };
    problem
        .observations
        .measured
        .iter()
        .enumerate()
        .map(feature_result)
        .collect()
}

/// Curve of all results on it.
pub(super) fn curve(
    problem: &FitProblem<'_>,
    results: &[FeatureResult<'_>],
    number: usize,
) -> FittedCurve {
    let on: Vec<(&FittedFeature, f64)> = results
        .iter()
        .filter_map(|result| {
            result
                .measured
                .on
                .filter(|(curve, _)| *curve == number)
                .map(|(_, at)| (&result.feature, at))
        })
        .collect();
    let values = |value: fn(&FittedFeature) -> f64| {
        on.iter()
            .map(|(feature, _)| value(feature))
            .collect::<Vec<f64>>()
    };
    let curve = &problem.observations.curves[number];
    FittedCurve {
        name: curve.name.clone(),
        unit: curve.unit.clone(),
        over: curve.over.to_owned(),
        at: on.iter().map(|(_, at)| *at).collect(),
        measured: values(|feature| feature.measured),
        before: values(|feature| feature.before),
        after: values(|feature| feature.after),
        low: values(|feature| feature.low),
        high: values(|feature| feature.high),
    }
}
