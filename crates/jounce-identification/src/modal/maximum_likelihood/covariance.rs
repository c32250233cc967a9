//! Covariance of the poles: from the scatter of the blocks, the variance of the lines, or the
//! residuals of the lines.
use jounce_linalg::{Mat, c64};
use rayon::prelude::*;
use std::f64::consts::TAU;

use super::fit_data::FitData;
use super::noise::MIN_FREE_SHARE;
use super::scatter::Scatter;
use super::variable_projection::ProjectedProblem;
use crate::modal::Band;
use crate::modal::band::BandNoise;
use crate::modal::band_lines::LeaveOneOutChange;

/// Covariance of the unknowns of a fit. The first unknowns are the real and imaginary parts of the
/// poles.
pub(super) struct PoleCovariance {
    /// Inverse of the normal matrix.
    inverse: Mat<f64>,
    /// Effect of parts of the data on the unknowns; `None` where the variances of the lines
    /// suffice.
    scatter: Option<Scatter>,
    /// Factor on the variances.
    factor: f64,
}

impl PoleCovariance {
    /// Computes the covariance from the rows of each output: those of its responses in order, two
    /// per line. `None` where the rows leave an unknown undetermined.
    pub fn of(
        band: &Band,
        data: &FitData,
        outputs: &[ProjectedProblem],
        misfit: f64,
    ) -> Option<Self> {
        let unknown_count = outputs.first()?.projected.ncols();
        let mut normal = Mat::<f64>::zeros(unknown_count, unknown_count);
        outputs
            .iter()
            .for_each(|output| normal += output.projected.transpose() * &output.projected);
        let inverse = jounce_linalg::positive_inverse(&normal)?;
        // Without variances only the misfit is known.
        let factor = if band.variance.is_empty() {
            misfit
        } else {
            misfit.max(1.0)
        };
        let base = Self {
            inverse,
            scatter: None,
            factor,
        };
        if !band.leave_one_out.is_empty() {
            let rotations = Scatter::rotations(band.leave_one_out.len(), band.window_bias);
            let effect =
                |part: &LeaveOneOutChange| &base.inverse * score(data, outputs, part, rotations);
            let scatter = Scatter::from_parts(
                band.leave_one_out.par_iter().map(effect).collect(),
                &band.leave_one_out,
                band.window_bias,
            );
            return Some(Self {
                scatter: Some(scatter),
                ..base
            });
        }
        if band.noise == BandNoise::FromResiduals {
            let effect = |line: usize| &base.inverse * base.score_of_line(data, outputs, line);
            let scatter =
                Scatter::from_lines((0..data.lines.len()).into_par_iter().map(effect).collect());
            return Some(Self {
                scatter: Some(scatter),
                factor: 1.0,
                ..base
            });
        }
        Some(base)
    }

    /// Standard deviations of frequency (Hz) and damping ratio of each pole.
    pub fn deviations(&self, poles: &[c64]) -> Vec<(f64, f64)> {
        let pole_deviations = |(r, p): (usize, &c64)| {
            let (a, b, magnitude) = (p.re, p.im, p.norm());
            let deviation =
                |slopes: [f64; 2]| (self.variance(r, slopes) * self.factor).max(0.0).sqrt();
            // |p| and -re p / |p|.
            (
                deviation([a / magnitude, b / magnitude]) / TAU,
                deviation([-b * b / magnitude.powi(3), a * b / magnitude.powi(3)]),
            )
        };
        poles.iter().enumerate().map(pole_deviations).collect()
    }

    /// Variance of a quantity with derivatives `slope` by the real and the imaginary part of pole
    /// `r`.
    fn variance(&self, r: usize, slope: [f64; 2]) -> f64 {
        let covariance = &self.inverse;
        let residual_variance = || {
            let (vr, vi, c) = (
                covariance[(2 * r, 2 * r)],
                covariance[(2 * r + 1, 2 * r + 1)],
                covariance[(2 * r, 2 * r + 1)],
            );
            slope[0].powi(2) * vr + slope[1].powi(2) * vi + 2.0 * slope[0] * slope[1] * c
        };
        self.scatter
            .as_ref()
            .map_or_else(residual_variance, |scatter| scatter.variance(r, slope))
    }

    /// Degrees of freedom of the deviations of each pole; `None` where they are large.
    pub fn freedoms(&self, poles: usize) -> Vec<Option<f64>> {
        (0..poles)
            .map(|r| self.scatter.as_ref().map(|scatter| scatter.freedom(r)))
            .collect()
    }

    /// Leverage of a row by linear and nonlinear unknowns.
    fn row_leverage(&self, output: &ProjectedProblem, row: usize) -> f64 {
        let row_vector = output.projected.row(row);
        output.leverage[row] + (row_vector * &self.inverse).dot(&row_vector)
    }

    /// Leverage of each line of each response of a band; 0 for lines that the fit leaves out.
    pub fn leverages(
        &self,
        data: &FitData,
        outputs: &[ProjectedProblem],
        band: &Band,
    ) -> Vec<Vec<f64>> {
        let (rows, inputs) = (2 * data.lines.len(), responses_per_output(data, outputs));
        let response_leverages = |response: usize| {
            let (output, from) = (&outputs[response / inputs], response % inputs * rows);
            let mut leverages = vec![0.0; band.frequency_hz.len()];
            for (k, line) in data.lines.iter().enumerate() {
                leverages[*line] = 0.5
                    * (self.row_leverage(output, from + 2 * k)
                        + self.row_leverage(output, from + 2 * k + 1));
            }
            leverages
        };
        (0..band.response.len())
            .into_par_iter()
            .map(response_leverages)
            .collect()
    }

    /// Contribution of the residual of a line to `J^T P e` over all responses, and the same turned
    /// by 90 degrees, because noise has no preferred phase. The residual is enlarged to correct for
    /// its leverage.
    fn score_of_line(&self, data: &FitData, outputs: &[ProjectedProblem], line: usize) -> Mat<f64> {
        let mut sum = Mat::<f64>::zeros(self.inverse.nrows(), 2);
        for output in outputs {
            for re in (2 * line..output.residual.nrows()).step_by(2 * data.lines.len()) {
                let leverage =
                    0.5 * (self.row_leverage(output, re) + self.row_leverage(output, re + 1));
                let scale = (1.0 - leverage).max(MIN_FREE_SHARE).sqrt().recip() / 2f64.sqrt();
                let (x, y) = (
                    output.residual[(re, 0)] * scale,
                    output.residual[(re + 1, 0)] * scale,
                );
                for c in 0..sum.nrows() {
                    let (slope_re, slope_im) =
                        (output.projected[(re, c)], output.projected[(re + 1, c)]);
                    sum[(c, 0)] += slope_re * x + slope_im * y;
                    sum[(c, 1)] += slope_im * x - slope_re * y;
                }
            }
        }
        sum
    }
}

/// Number of responses whose rows form one part: all of an output where its responses share a
/// shape, else one, for any number of references.
fn responses_per_output(data: &FitData, outputs: &[ProjectedProblem]) -> usize {
    data.responses.len() / outputs.len().max(1)
}

/// Contribution of a left-out part to `J^T P e` over all responses, and the same turned by 90
/// degrees.
fn score(
    data: &FitData,
    outputs: &[ProjectedProblem],
    left_out: &LeaveOneOutChange,
    rotations: usize,
) -> Mat<f64> {
    let unknown_count = outputs.first().map_or(0, |output| output.projected.ncols());
    let inputs = responses_per_output(data, outputs);
    let rows = 2 * data.lines.len();
    let mut sums = Mat::<f64>::zeros(unknown_count, rotations);
    for (o, output) in outputs.iter().enumerate() {
        let rotated = Mat::from_fn(output.projected.nrows(), rotations, |row, rotation| {
            let (response, k) = (o * inputs + row / rows, row % rows / 2);
            let change = left_out.change[response]
                .get(data.lines[k])
                .map_or(c64::new(0.0, 0.0), |line_change| {
                    line_change * data.responses[response].weight[k]
                });
            match (row % 2, rotation) {
                (0, 0) | (1, 1) => change.re,
                (0, _) => -change.im,
                _ => change.im,
            }
        });
        sums += output.projected.transpose() * rotated;
    }
    sums
}
