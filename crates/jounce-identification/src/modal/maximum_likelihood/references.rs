//! Fits the modal model to the responses to several references at once, with residues of rank one.
//!
//! ```text
//! H_oi(w) = sum_r a_or b_ri / (j w - p_r) + conj(a_or b_ri) / (j w - conj(p_r)) - L_oi / w^2 + U_oi0 + U_oi1 w^2 + ..
//! ```
//!
//! `a_r` is the shape of a mode at the outputs and `b_r` its participation in the references, 1 at
//! the reference with the largest. Two close modes differ in `b_r` where no single reference could
//! separate them. Gauss-Newton with step control over poles and participations; shapes and residual
//! terms are linear and are eliminated output by output, as in the fit to one reference.

use faer::linalg::solvers::Solve;
use faer::{Mat, c64};
use rayon::prelude::*;
use std::f64::consts::TAU;

use super::covariance::PoleCovariance;
use super::design_matrix::{DesignMatrix, LinearTerms};
use super::likelihood::{
    FitData, MAX_STEPS, MAX_UPPER_TERMS, ModalFit, STEP_TOLERANCE, damped_factor, fit_reweighted,
    residues,
};
use super::variable_projection::{LinearSolution, ProjectedProblem};
use crate::modal::{Band, Pole};

/// Fitted unknowns: poles, and the participation of every reference in each mode.
#[derive(Clone)]
struct ReferenceModel {
    poles: Vec<c64>,
    /// Mode, reference.
    participation: Vec<Vec<c64>>,
    /// Reference of each mode whose participation is fixed at 1.
    fixed: Vec<usize>,
}

/// Modes at the minimum, for a given number of terms for those above the band.
struct ConvergedModel {
    modal: ReferenceModel,
    upper: usize,
    error: f64,
}

/// Fits several references from initial poles.
pub(in crate::modal) fn fit_shared(band: &Band, start: &[Pole]) -> Option<ModalFit> {
    fit_reweighted(band, start, fit_weighted)
}

/// Fits with the weights of a band and as many terms for the modes above it as needed.
fn fit_weighted(band: &Band, start: &[Pole]) -> Option<ModalFit> {
    let data = FitData::of(band, start);
    let mut result = converge(&data, band, ReferenceModel::initial(band, &data, start)?, 1)?;
    for upper in 2..=MAX_UPPER_TERMS {
        let trial = converge(&data, band, result.modal.clone(), upper);
        let Some(trial) = trial.filter(|trial| data.justifies_terms(result.error, trial.error))
        else {
            break;
        };
        result = trial;
    }
    modal_fit(band, &data, &result)
}

fn converge(
    data: &FitData,
    band: &Band,
    mut modal: ReferenceModel,
    upper: usize,
) -> Option<ConvergedModel> {
    let (mut normal, mut rhs, mut error) = equations(data, band, &modal, upper)?;
    let mut damping = 1e-6;
    for _ in 0..MAX_STEPS {
        let trial = modal.with_step(&damped_factor(&normal, damping)?.solve(&rhs));
        let pole_changes = trial
            .poles
            .iter()
            .zip(&modal.poles)
            .map(|(a, b)| (a - b).norm() / b.norm());
        let participation_changes = trial
            .participation
            .iter()
            .flatten()
            .zip(modal.participation.iter().flatten())
            .map(|(a, b)| (a - b).norm());
        let step_size = pole_changes
            .chain(participation_changes)
            .fold(0.0, f64::max);
        let is_stable = trial.poles.iter().all(|p| p.re < 0.0 && p.im > 0.0);
        match equations(data, band, &trial, upper)
            .filter(|(.., new_error)| is_stable && *new_error <= error * (1.0 + 1e-12))
        {
            Some(accepted) => {
                modal = trial;
                (normal, rhs, error) = accepted;
                damping = f64::max(damping * 0.1, 1e-12);
                if step_size < STEP_TOLERANCE {
                    break;
                }
            }
            None if damping > 1e6 || step_size < STEP_TOLERANCE => break,
            None => damping *= 10.0,
        }
    }
    Some(ConvergedModel {
        modal,
        upper,
        error,
    })
}

impl ReferenceModel {
    /// Initial participations: the first right singular vector of unconstrained residues.
    fn initial(band: &Band, data: &FitData, start: &[Pole]) -> Option<Self> {
        let poles: Vec<c64> = start.iter().map(|pole| pole.complex()).collect();
        let residue = residues(data, &poles);
        let initial_participation = |r: usize| {
            let residues_of_mode = Mat::from_fn(band.outputs(), band.inputs, |o, i| {
                residue[o * band.inputs + i][r]
            });
            let svd = residues_of_mode.thin_svd().ok()?;
            let row: Vec<c64> = (0..band.inputs).map(|i| svd.V()[(i, 0)].conj()).collect();
            let fixed = (0..row.len()).max_by(|a, b| row[*a].norm().total_cmp(&row[*b].norm()))?;
            Some((row.iter().map(|b| b / row[fixed]).collect(), fixed))
        };
        let (participation, fixed) = (0..start.len())
            .map(initial_participation)
            .collect::<Option<Vec<_>>>()?
            .into_iter()
            .unzip();
        Some(Self {
            poles,
            participation,
            fixed,
        })
    }

    /// Mode and reference of each fitted participation.
    fn free(&self) -> Vec<(usize, usize)> {
        let free_of_mode = |(r, row): (usize, &Vec<c64>)| {
            (0..row.len())
                .filter(|i| *i != self.fixed[r])
                .map(|i| (r, i))
                .collect::<Vec<_>>()
        };
        self.participation
            .iter()
            .enumerate()
            .flat_map(free_of_mode)
            .collect()
    }

    fn with_step(&self, step: &Mat<f64>) -> Self {
        let mut trial = self.clone();
        let step_of = |k: usize| c64::new(step[(2 * k, 0)], step[(2 * k + 1, 0)]);
        trial
            .poles
            .iter_mut()
            .enumerate()
            .for_each(|(r, pole)| *pole += step_of(r));
        for (k, (r, i)) in self.free().into_iter().enumerate() {
            trial.participation[r][i] += step_of(self.poles.len() + k);
        }
        trial
    }
}

/// Normal equations over all outputs, in parallel and summed in order, and the weighted squared
/// error.
fn equations(
    data: &FitData,
    band: &Band,
    modal: &ReferenceModel,
    upper: usize,
) -> Option<(Mat<f64>, Mat<f64>, f64)> {
    let unknown_count = 2 * (modal.poles.len() + modal.free().len());
    let (mut normal, mut rhs, mut error) = (
        Mat::zeros(unknown_count, unknown_count),
        Mat::zeros(unknown_count, 1),
        0.0,
    );
    let terms = DesignMatrix::of_kinds(
        data.window_bias,
        &data.powers,
        &data.angular,
        &modal.poles,
        upper,
    );
    let projected = (0..band.outputs())
        .into_par_iter()
        .map(|o| project_output(o, data, &terms, modal))
        .collect::<Vec<_>>();
    for problem in projected {
        normal += problem.projected.transpose() * &problem.projected;
        rhs += problem.projected.transpose() * &problem.residual;
        error += problem.residual.squared_norm_l2();
    }
    Some((normal, rhs, error))
}

/// Rows: the lines of one reference after those of the other.
fn project_output(
    o: usize,
    data: &FitData,
    terms: &[DesignMatrix],
    modal: &ReferenceModel,
) -> ProjectedProblem {
    let (modes, inputs, lines) = (
        modal.poles.len(),
        modal.participation[0].len(),
        terms[0].linear.nrows(),
    );
    let residual_terms = terms[0].linear.ncols() - 2 * modes;
    let (rows, width) = (inputs * lines, 2 * modes + residual_terms * inputs);
    let response = |row: usize| &data.responses[o * inputs + row / lines];
    let weight = |row: usize| response(row).weight[row % lines / 2];
    let of_kind = |row: usize| &terms[response(row).kind];
    let base = |row: usize, c: usize| weight(row) * of_kind(row).linear[(row % lines, c)];
    // A residue x + j y has the terms x E + y O; here it is the shape times the participation.
    let combined_column = |row: usize, r: usize, residue: c64| {
        residue.re * base(row, 2 * r) + residue.im * base(row, 2 * r + 1)
    };
    let j = c64::new(0.0, 1.0);
    let column = |row: usize, c: usize| {
        let i = row / lines;
        match c.checked_sub(2 * modes) {
            None if c.is_multiple_of(2) => {
                combined_column(row, c / 2, modal.participation[c / 2][i])
            }
            None => combined_column(row, c / 2, modal.participation[c / 2][i] * j),
            Some(k) if k / residual_terms == i => base(row, 2 * modes + k % residual_terms),
            Some(_) => 0.0,
        }
    };
    let a = Mat::from_fn(rows, width, column);
    let value = |row: usize| response(row).value[row % lines / 2];
    let b = Mat::from_fn(rows, 1, |row, _| {
        if row % 2 == 0 {
            value(row).re
        } else {
            value(row).im
        }
    });
    let solution = LinearSolution::new(a, &b);
    let linear = &solution.linear;
    let shape = |r: usize| c64::new(linear[(2 * r, 0)], linear[(2 * r + 1, 0)]);
    let free = modal.free();
    let derivative = |row: usize, c: usize| {
        let (i, k, rotation) = (
            row / lines,
            c / 2,
            if c.is_multiple_of(2) {
                c64::new(1.0, 0.0)
            } else {
                j
            },
        );
        if k < modes {
            let residue = shape(k) * modal.participation[k][i] * rotation;
            let derivatives = |c: usize| weight(row) * of_kind(row).derivatives[(row % lines, c)];
            return residue.re * derivatives(2 * k) + residue.im * derivatives(2 * k + 1);
        }
        let (r, reference) = free[k - modes];
        if reference == i {
            combined_column(row, r, shape(r) * rotation)
        } else {
            0.0
        }
    };
    let by_modes = Mat::from_fn(rows, 2 * (modes + free.len()), derivative);
    solution.project(&by_modes)
}

fn modal_fit(
    band: &Band,
    data: &FitData,
    ConvergedModel {
        modal,
        upper,
        error,
    }: &ConvergedModel,
) -> Option<ModalFit> {
    let (modes, inputs, outputs) = (modal.poles.len(), band.inputs, band.outputs());
    let residual_terms = 2 + 2 * upper;
    let unknowns =
        2 * (modes + modal.free().len()) + outputs * (2 * modes + residual_terms * inputs);
    let misfit =
        error / ((2 * data.angular.len() * band.response.len()) as f64 - unknowns as f64).max(1.0);
    let terms = DesignMatrix::of_kinds(
        data.window_bias,
        &data.powers,
        &data.angular,
        &modal.poles,
        *upper,
    );
    let projected = (0..outputs)
        .into_par_iter()
        .map(|o| project_output(o, data, &terms, modal))
        .collect::<Vec<_>>();
    let covariance = PoleCovariance::of(band, data, &projected, misfit)?;
    let (mut residue, mut model) = (Vec::new(), Vec::new());
    for (o, ProjectedProblem { linear, .. }) in projected.iter().enumerate() {
        let shape: Vec<c64> = (0..modes)
            .map(|r| c64::new(linear[(2 * r, 0)], linear[(2 * r + 1, 0)]))
            .collect();
        for i in 0..inputs {
            let residues = (0..modes)
                .map(|r| shape[r] * modal.participation[r][i])
                .flat_map(|x| [x.re, x.im]);
            let unknown: Vec<f64> = residues
                .chain((0..residual_terms).map(|k| linear[(2 * modes + residual_terms * i + k, 0)]))
                .collect();
            let power = data.powers[data.responses[o * inputs + i].kind];
            let terms = LinearTerms::of((data.window_bias, power, *upper), &modal.poles);
            let at = |hz: &f64| terms.sum(TAU * hz, unknown.iter().copied());
            model.push(band.frequency_hz.iter().map(at).collect());
        }
        residue.push(shape);
    }
    Some(ModalFit {
        poles: modal.poles.iter().map(|p| Pole::of(*p)).collect(),
        deviation: covariance.deviations(&modal.poles),
        residue,
        participation: modal.participation.clone(),
        model,
        misfit,
        freedom: covariance.freedoms(modes),
        leverage: covariance.leverages(data, &projected, band),
    })
}
