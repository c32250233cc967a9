//! Fits the modal model to all lines of all responses, weighted by their variance.
//!
//! Gauss-Newton with step control over the poles. Residues and residual terms are linear and are
//! eliminated response by response, so the size of the normal equations is the number of poles.
//! Steps use products of columns, the final result orthogonal ones. Lines far from every pole are
//! thinned out first.

use jounce_linalg::{CholeskyFactor, Mat, c64};
use rayon::prelude::*;
use std::f64::consts::TAU;

use super::covariance::PoleCovariance;
use super::design_matrix::{DesignMatrix, LinearTerms};
use super::fit_data::{FitData, WeightedResponse};
use super::noise;
use super::semi_normal::NormalEquations;
use super::variable_projection::{LinearSolution, ProjectedProblem};
use crate::modal::{Band, Pole};

/// Poles, their covariance, and the residues of every response.
pub(in crate::modal) struct ModalFit {
    pub poles: Vec<Pole>,
    /// Standard deviations of frequency (Hz) and damping ratio.
    pub deviation: Vec<(f64, f64)>,
    /// Residues: response, mode. For several references those of each output to the one whose
    /// participation is 1.
    pub residue: Vec<Vec<c64>>,
    /// Participation of each reference in a mode: mode, reference; empty for one reference.
    pub participation: Vec<Vec<c64>>,
    /// Responses of the model: response, line.
    pub model: Vec<Vec<c64>>,
    /// Squared error over variance, per degree of freedom; the variances are multiplied by it where
    /// it is above 1. Relative to the mean square of the responses where no variance is known.
    pub misfit: f64,
    /// Degrees of freedom of the deviations of each pole; `None` where they are large.
    pub freedom: Vec<Option<f64>>,
    /// Leverage of each line: response, line.
    pub leverage: Vec<Vec<f64>>,
}

pub(super) const MAX_STEPS: usize = 30;
pub(super) const STEP_TOLERANCE: f64 = 1e-10;
/// Relative decrease of the error below which a step moves the poles by less than a ten-thousandth
/// of their deviations.
const MIN_ERROR_GAIN: f64 = 1e-12;

/// Maximum number of terms `w^0, w^2, ..` for the modes above the band.
pub(super) const MAX_UPPER_TERMS: usize = 8;

/// Contribution of a response to the normal equations, for nearly dependent columns.
pub(super) fn by_orthogonal_columns(
    response: &WeightedResponse,
    terms: &DesignMatrix,
) -> NormalEquations {
    let ProjectedProblem {
        projected,
        residual,
        ..
    } = project_response(response, terms);
    NormalEquations {
        normal: projected.transpose() * &projected,
        rhs: projected.transpose() * &residual,
        error: residual.norm_squared(),
    }
}

/// Fits one reference from initial poles.
pub(in crate::modal) fn fit(band: &Band, start: &[Pole]) -> Option<ModalFit> {
    fit_reweighted(band, start, fit_weighted)
}

/// Fits with the weights of a band. If the noise is unknown, it is estimated from the residuals of
/// each line, and the fit is repeated with new weights.
pub(super) fn fit_reweighted(
    band: &Band,
    start: &[Pole],
    fit_once: impl Fn(&Band, &[Pole]) -> Option<ModalFit>,
) -> Option<ModalFit> {
    let mut result = fit_once(band, start)?;
    if band.has_unknown_noise() {
        let misfit = result.misfit;
        for _ in 0..noise::RESIDUAL_FITS {
            let reweighted = band.with_variance(noise::residual_variance(
                band,
                &result.model,
                &result.leverage,
            ));
            result = fit_once(&reweighted, &result.poles)?;
        }
        result.misfit = misfit;
    }
    Some(result)
}

/// Fits with the weights of a band and as many terms for the modes above it as needed: one more is
/// kept where it lowers the error sufficiently (Akaike criterion).
fn fit_weighted(band: &Band, start: &[Pole]) -> Option<ModalFit> {
    let data = FitData::of(band, start);
    let mut result = converge(&data, start.iter().map(|pole| pole.complex()).collect(), 1)?;
    for upper in 2..=MAX_UPPER_TERMS {
        let Some(trial) = converge(&data, result.poles.clone(), upper)
            .filter(|trial| data.justifies_terms(result.error, trial.error))
        else {
            break;
        };
        result = trial;
    }
    modal_fit(band, &data, &result)
}

/// Poles at the minimum, for a given number of terms for the modes above the band.
struct ConvergedFit {
    poles: Vec<c64>,
    upper: usize,
    error: f64,
}

fn converge(data: &FitData, mut poles: Vec<c64>, upper: usize) -> Option<ConvergedFit> {
    let (mut normal, mut rhs, mut error) = equations(data, &poles, upper)?;
    let mut damping = 1e-6;
    for _ in 0..MAX_STEPS {
        let step = damped_factor(&normal, damping)?.solve(&rhs);
        let trial: Vec<c64> = poles
            .iter()
            .enumerate()
            .map(|(r, p)| p + c64::new(step[(2 * r, 0)], step[(2 * r + 1, 0)]))
            .collect();
        let step_size = trial
            .iter()
            .zip(&poles)
            .map(|(a, b)| (a - b).norm() / b.norm())
            .fold(0.0, f64::max);
        let gain = (step.transpose() * &rhs)[(0, 0)];
        let is_stable = trial.iter().all(|p| p.re < 0.0 && p.im > 0.0);
        let new_equations = if is_stable {
            equations(data, &trial, upper)
        } else {
            None
        };
        match new_equations.filter(|(.., new_error)| *new_error <= error * (1.0 + 1e-12)) {
            Some(accepted) => {
                let previous_error = error;
                poles = trial;
                (normal, rhs, error) = accepted;
                damping = f64::max(damping * 0.1, 1e-12);
                if step_size < STEP_TOLERANCE || gain < MIN_ERROR_GAIN * previous_error {
                    break;
                }
            }
            None if damping > 1e6 || step_size < STEP_TOLERANCE => break,
            None => damping *= 10.0,
        }
    }
    Some(ConvergedFit {
        poles,
        upper,
        error,
    })
}

/// Factorises the normal matrix with an enlarged diagonal.
pub(super) fn damped_factor(normal: &Mat<f64>, damping: f64) -> Option<CholeskyFactor> {
    let damped_normal = Mat::from_fn(normal.nrows(), normal.ncols(), |a, b| {
        normal[(a, b)] * if a == b { 1.0 + damping } else { 1.0 }
    });
    CholeskyFactor::of(damped_normal)
}

/// Normal equations of the poles over all responses, and the weighted squared error.
fn equations(data: &FitData, poles: &[c64], upper: usize) -> Option<(Mat<f64>, Mat<f64>, f64)> {
    let unknown_count = 2 * poles.len();
    let (mut normal, mut rhs, mut error) = (
        Mat::zeros(unknown_count, unknown_count),
        Mat::zeros(unknown_count, 1),
        0.0,
    );
    // Responses in parallel, summed in order: bitwise equal results for any number of threads.
    let terms = DesignMatrix::of_kinds(data.window_bias, &data.powers, &data.angular, poles, upper);
    let equations_of = |response: &WeightedResponse| {
        let terms = &terms[response.kind];
        NormalEquations::of(response, terms)
            .unwrap_or_else(|| by_orthogonal_columns(response, terms))
    };
    let contributions = data
        .responses
        .par_iter()
        .map(equations_of)
        .collect::<Vec<_>>();
    for contribution in contributions {
        normal += &contribution.normal;
        rhs += &contribution.rhs;
        error += contribution.error;
    }
    Some((normal, rhs, error))
}

fn project_response(response: &WeightedResponse, terms: &DesignMatrix) -> ProjectedProblem {
    let (rows, width) = (terms.linear.nrows(), terms.linear.ncols());
    let weight = &response.weight;
    let a = Mat::from_fn(rows, width, |r, c| weight[r / 2] * terms.linear[(r, c)]);
    let b = Mat::from_fn(rows, 1, |r, _| {
        if r % 2 == 0 {
            response.value[r / 2].re
        } else {
            response.value[r / 2].im
        }
    });
    let solution = LinearSolution::new(a, &b);
    let linear = &solution.linear;
    // Derivatives by the real and imaginary part x + j y of each pole's residue times u, and its
    // conjugate.
    let by_poles = Mat::from_fn(rows, terms.derivatives.ncols(), |row, c| {
        let (r, derivatives) = (2 * (c / 2), &terms.derivatives);
        let (x, y) = (linear[(r, 0)], linear[(r + 1, 0)]);
        let (real_part, imaginary_part) = (derivatives[(row, r)], derivatives[(row, r + 1)]);
        weight[row / 2]
            * if c % 2 == 0 {
                x * real_part + y * imaginary_part
            } else {
                x * imaginary_part - y * real_part
            }
    });
    solution.project(&by_poles)
}

fn modal_fit(band: &Band, data: &FitData, result: &ConvergedFit) -> Option<ModalFit> {
    let (poles, upper) = (&result.poles, result.upper);
    let linear = band.response.len() * (2 * poles.len() + 2 + 2 * upper);
    let misfit = result.error
        / ((2 * data.angular.len() * band.response.len()) as f64
            - (2 * poles.len() + linear) as f64)
            .max(1.0);
    let terms = DesignMatrix::of_kinds(data.window_bias, &data.powers, &data.angular, poles, upper);
    let projected = data
        .responses
        .par_iter()
        .map(|response| project_response(response, &terms[response.kind]))
        .collect::<Vec<ProjectedProblem>>();
    let covariance = PoleCovariance::of(band, data, &projected, misfit)?;
    let (mut residue, mut model) = (Vec::new(), Vec::new());
    for (problem, response) in projected.iter().zip(&data.responses) {
        let (linear, power) = (&problem.linear, data.powers[response.kind]);
        residue.push(
            (0..poles.len())
                .map(|r| c64::new(linear[(2 * r, 0)], linear[(2 * r + 1, 0)]))
                .collect(),
        );
        let terms = LinearTerms::of((data.window_bias, power, upper), poles);
        let at = |f: &f64| terms.sum(TAU * f, linear.column(0).iter().copied());
        model.push(band.frequency_hz.iter().map(at).collect());
    }
    Some(ModalFit {
        poles: poles.iter().map(|p| Pole::of(*p)).collect(),
        deviation: covariance.deviations(poles),
        residue,
        participation: Vec::new(),
        model,
        misfit,
        freedom: covariance.freedoms(poles.len()),
        leverage: covariance.leverages(data, &projected, band),
    })
}

/// Residues at given poles, with one term for the modes above the band: response, mode.
pub(super) fn residues(data: &FitData, poles: &[c64]) -> Vec<Vec<c64>> {
    let terms = DesignMatrix::of_kinds(data.window_bias, &data.powers, &data.angular, poles, 1);
    let residue_row = |response: &WeightedResponse| {
        let linear = project_response(response, &terms[response.kind]).linear;
        (0..poles.len())
            .map(|r| c64::new(linear[(2 * r, 0)], linear[(2 * r + 1, 0)]))
            .collect()
    };
    data.responses.par_iter().map(residue_row).collect()
}
