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

use jounce_linalg::{Mat, c64};
use rayon::prelude::*;
use std::f64::consts::TAU;

use super::covariance::PoleCovariance;
use super::design_matrix::{DesignMatrix, LinearTerms};
use super::fit_data::{FitData, WeightedResponse};
use super::likelihood::{
    MAX_STEPS, MAX_UPPER_TERMS, ModalFit, STEP_TOLERANCE, damped_factor, fit_reweighted,
};
use super::reference_model::ReferenceModel;
use super::variable_projection::{LinearSolution, ProjectedProblem};
use crate::modal::{Band, Pole};

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
        error += problem.residual.norm_squared();
    }
    Some((normal, rhs, error))
}

/// Eliminates the linear unknowns of an output.
fn project_output(
    o: usize,
    data: &FitData,
    terms: &[DesignMatrix],
    modal: &ReferenceModel,
) -> ProjectedProblem {
    let output = OutputRows {
        responses: &data.responses[o * modal.participation[0].len()..],
        terms,
        modal,
    };
    let (rows, width) = (output.count(), output.width());
    let a = Mat::from_fn(rows, width, |row, c| output.column(row, c));
    let b = Mat::from_fn(rows, 1, |row, _| {
        let value = output.response(row).value[output.part(row) / 2];
        if row % 2 == 0 { value.re } else { value.im }
    });
    let solution = LinearSolution::new(a, &b);
    let linear = &solution.linear;
    let shape = |r: usize| c64::new(linear[(2 * r, 0)], linear[(2 * r + 1, 0)]);
    let (modes, free) = (modal.poles.len(), modal.free());
    let derivative = |row: usize, c: usize| {
        let k = c / 2;
        let rotation = if c.is_multiple_of(2) {
            c64::new(1.0, 0.0)
        } else {
            c64::new(0.0, 1.0)
        };
        if k < modes {
            return output.by_pole(row, k, shape(k), rotation);
        }
        let (r, reference) = free[k - modes];
        if reference == output.reference(row) {
            output.combined_column(row, r, shape(r) * rotation)
        } else {
            0.0
        }
    };
    let by_modes = Mat::from_fn(rows, 2 * (modes + free.len()), derivative);
    solution.project(&by_modes)
}

/// Equations of one output. Rows: the lines of one reference after those of the other.
struct OutputRows<'a> {
    /// Responses of the output to each reference, then those of further outputs.
    responses: &'a [WeightedResponse],
    terms: &'a [DesignMatrix],
    modal: &'a ReferenceModel,
}

impl OutputRows<'_> {
    /// Rows of one reference.
    fn per_reference(&self) -> usize {
        self.terms[0].linear.nrows()
    }

    fn count(&self) -> usize {
        self.modal.participation[0].len() * self.per_reference()
    }

    /// Terms of each response for the modes outside the band.
    fn residual_terms(&self) -> usize {
        self.terms[0].linear.ncols() - 2 * self.modal.poles.len()
    }

    /// Linear unknowns: and the residual terms of each reference.
    fn width(&self) -> usize {
        2 * self.modal.poles.len() + self.residual_terms() * self.modal.participation[0].len()
    }

    fn reference(&self, row: usize) -> usize {
        row / self.per_reference()
    }

    /// Index of a row among those of its reference.
    fn part(&self, row: usize) -> usize {
        row % self.per_reference()
    }

    fn response(&self, row: usize) -> &WeightedResponse {
        &self.responses[self.reference(row)]
    }

    fn weight(&self, row: usize) -> f64 {
        self.response(row).weight[self.part(row) / 2]
    }

    fn terms_of(&self, row: usize) -> &DesignMatrix {
        &self.terms[self.response(row).kind]
    }

    fn base(&self, row: usize, c: usize) -> f64 {
        self.weight(row) * self.terms_of(row).linear[(self.part(row), c)]
    }

    /// Column of a mode. A residue `x + j y` has the terms `x E + y O`; here it is the shape times
    /// the participation.
    fn combined_column(&self, row: usize, r: usize, residue: c64) -> f64 {
        residue.re * self.base(row, 2 * r) + residue.im * self.base(row, 2 * r + 1)
    }

    /// Column of a linear unknown.
    fn column(&self, row: usize, c: usize) -> f64 {
        let (modes, residual_terms) = (self.modal.poles.len(), self.residual_terms());
        let i = self.reference(row);
        let participation = |r: usize| self.modal.participation[r][i];
        match c.checked_sub(2 * modes) {
            None if c.is_multiple_of(2) => self.combined_column(row, c / 2, participation(c / 2)),
            None => self.combined_column(row, c / 2, participation(c / 2) * c64::new(0.0, 1.0)),
            Some(k) if k / residual_terms == i => self.base(row, 2 * modes + k % residual_terms),
            Some(_) => 0.0,
        }
    }

    /// Derivative by the real (rotation 1) or imaginary part (rotation j) of a pole.
    fn by_pole(&self, row: usize, r: usize, shape: c64, rotation: c64) -> f64 {
        let residue = shape * self.modal.participation[r][self.reference(row)] * rotation;
        let derivatives =
            |c: usize| self.weight(row) * self.terms_of(row).derivatives[(self.part(row), c)];
        residue.re * derivatives(2 * r) + residue.im * derivatives(2 * r + 1)
    }
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
