//! Covariance of the poles: from the scatter of the blocks, the variance of the lines, or the
//! residuals of the lines.

use faer::linalg::solvers::DenseSolveCore;
use faer::{Mat, Side, c64};
use rayon::prelude::*;
use std::f64::consts::TAU;

use super::Band;
use super::band::{BandNoise, LeaveOneOutChange};
use super::likelihood::FitData;
use super::noise::MIN_FREE_SHARE;
use super::scatter::Scatter;
use super::variable_projection::ProjectedProblem;

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
        let size = outputs.first()?.projected.ncols();
        let mut normal = Mat::<f64>::zeros(size, size);
        outputs
            .iter()
            .for_each(|left| normal += left.projected.transpose() * &left.projected);
        let inverse = normal.llt(Side::Lower).ok()?.inverse();
        // Without variances only the misfit is known.
        let factor = if band.variance.is_empty() {
            misfit
        } else {
            misfit.max(1.0)
        };
        let told = Self {
            inverse,
            scatter: None,
            factor,
        };
        if !band.parts.is_empty() {
            let turns = Scatter::turns(band.parts.len(), band.sight);
            let change =
                |left: &LeaveOneOutChange| &told.inverse * score(data, outputs, left, turns);
            let scatter = Scatter::of_parts(
                band.parts.par_iter().map(change).collect(),
                &band.parts,
                band.sight,
            );
            return Some(Self {
                scatter: Some(scatter),
                ..told
            });
        }
        if band.noise == BandNoise::ByRest {
            let change = |line: usize| &told.inverse * told.score_of_line(data, outputs, line);
            let scatter =
                Scatter::of_lines((0..data.lines.len()).into_par_iter().map(change).collect());
            return Some(Self {
                scatter: Some(scatter),
                factor: 1.0,
                ..told
            });
        }
        Some(told)
    }

    /// Standard deviations of frequency (Hz) and damping ratio of each pole.
    pub fn deviations(&self, poles: &[c64]) -> Vec<(f64, f64)> {
        let of = |(r, p): (usize, &c64)| {
            let (a, b, size) = (p.re, p.im, p.norm());
            let deviation =
                |slopes: [f64; 2]| (self.variance(r, slopes) * self.factor).max(0.0).sqrt();
            // |p| and -re p / |p|.
            (
                deviation([a / size, b / size]) / TAU,
                deviation([-b * b / size.powi(3), a * b / size.powi(3)]),
            )
        };
        poles.iter().enumerate().map(of).collect()
    }

    /// Variance of a quantity with derivatives `slope` by the real and the imaginary part of pole
    /// `r`.
    fn variance(&self, r: usize, slope: [f64; 2]) -> f64 {
        let covariance = &self.inverse;
        let told = || {
            let (vr, vi, c) = (
                covariance[(2 * r, 2 * r)],
                covariance[(2 * r + 1, 2 * r + 1)],
                covariance[(2 * r, 2 * r + 1)],
            );
            slope[0].powi(2) * vr + slope[1].powi(2) * vi + 2.0 * slope[0] * slope[1] * c
        };
        self.scatter
            .as_ref()
            .map_or_else(told, |scatter| scatter.variance(r, slope))
    }

    /// Degrees of freedom of the deviations of each pole; `None` where they are large.
    pub fn freedoms(&self, poles: usize) -> Vec<Option<f64>> {
        (0..poles)
            .map(|r| self.scatter.as_ref().map(|scatter| scatter.freedom(r)))
            .collect()
    }

    /// Leverage of a row by linear and nonlinear unknowns.
    fn share(&self, left: &ProjectedProblem, row: usize) -> f64 {
        let of = left.projected.row(row);
        left.taken[row] + of * &self.inverse * of.transpose()
    }

    /// Leverage of each line of each response of a band; 0 for lines that the fit leaves out.
    pub fn taken(
        &self,
        data: &FitData,
        outputs: &[ProjectedProblem],
        band: &Band,
    ) -> Vec<Vec<f64>> {
        let (rows, inputs) = (2 * data.lines.len(), responses_of_part(data, outputs));
        let of = |response: usize| {
            let (left, from) = (&outputs[response / inputs], response % inputs * rows);
            let mut shares = vec![0.0; band.frequency_hz.len()];
            for (k, line) in data.lines.iter().enumerate() {
                shares[*line] =
                    0.5 * (self.share(left, from + 2 * k) + self.share(left, from + 2 * k + 1));
            }
            shares
        };
        (0..band.response.len()).into_par_iter().map(of).collect()
    }

    /// Contribution of the residual of a line to `J^T P e` over all responses, and the same turned
    /// by 90 degrees, because noise has no preferred phase. The residual is enlarged to correct for
    /// its leverage.
    fn score_of_line(&self, data: &FitData, outputs: &[ProjectedProblem], line: usize) -> Mat<f64> {
        let mut sum = Mat::<f64>::zeros(self.inverse.nrows(), 2);
        for left in outputs {
            for re in (2 * line..left.rest.nrows()).step_by(2 * data.lines.len()) {
                let taken = 0.5 * (self.share(left, re) + self.share(left, re + 1));
                let widened = (1.0 - taken).max(MIN_FREE_SHARE).sqrt().recip() / 2f64.sqrt();
                let (x, y) = (
                    left.rest[(re, 0)] * widened,
                    left.rest[(re + 1, 0)] * widened,
                );
                for c in 0..sum.nrows() {
                    let (by_re, by_im) = (left.projected[(re, c)], left.projected[(re + 1, c)]);
                    sum[(c, 0)] += by_re * x + by_im * y;
                    sum[(c, 1)] += by_im * x - by_re * y;
                }
            }
        }
        sum
    }
}

/// Number of responses whose rows form one part: all of an output where its responses share a
/// shape, else one, for any number of references.
fn responses_of_part(data: &FitData, outputs: &[ProjectedProblem]) -> usize {
    data.responses.len() / outputs.len().max(1)
}

/// Contribution of a left-out part to `J^T P e` over all responses, and the same turned by 90
/// degrees.
fn score(
    data: &FitData,
    outputs: &[ProjectedProblem],
    left_out: &LeaveOneOutChange,
    turns: usize,
) -> Mat<f64> {
    let size = outputs.first().map_or(0, |left| left.projected.ncols());
    let inputs = responses_of_part(data, outputs);
    let rows = 2 * data.lines.len();
    let mut sums = Mat::<f64>::zeros(size, turns);
    for (o, left) in outputs.iter().enumerate() {
        let turned = Mat::from_fn(left.projected.nrows(), turns, |row, turn| {
            let (response, k) = (o * inputs + row / rows, row % rows / 2);
            let change = left_out.change[response]
                .get(data.lines[k])
                .map_or(c64::new(0.0, 0.0), |of| {
                    of * data.responses[response].weight[k]
                });
            match (row % 2, turn) {
                (0, 0) | (1, 1) => change.re,
                (0, _) => -change.im,
                _ => change.im,
            }
        });
        sums += left.projected.transpose() * turned;
    }
    sums
}
