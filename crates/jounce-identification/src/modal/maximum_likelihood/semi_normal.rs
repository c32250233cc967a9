//! Normal equations of the poles without an orthogonal basis of the linear columns.
//!
//! With the weighted linear columns `A`, the columns `S` of the derivatives, and the response `b`,
//! one pass over the lines gives all products of columns. The factor of `A^T A` gives the linear
//! unknowns `x`, a second pass their residual, `r = b - A x`, and the correction `dx`,
//!
//! ```text
//! A^T A dx = A^T r,   S^T P b = S^T r - S^T A dx,   S^T P S = S^T S - S^T A (A^T A)^-1 A^T S
//! ```
//!
//! which is as accurate as orthogonal columns where `dx` is a small share of `x`. It takes half the
//! work, and stores no matrix as long as the band.
//!
//! Source: A. Bjorck, Linear Algebra Appl. 88/89 (1987) 31 (corrected semi-normal equations).

use jounce_linalg::{
    CholeskyFactor, Mat, add_gram, add_transposed_product, column, column_mut, row_product,
};

use super::design_matrix::DesignMatrix;
use super::fit_data::WeightedResponse;

/// Rows multiplied at once: so many rows of all columns fit into the cache.
const ROWS_AT_ONCE: usize = 256;
/// Relative size of a correction, or of the next one extrapolated from the last two, below which
/// the linear unknowns are as accurate as from orthogonal columns.
const CORRECTION_TOLERANCE: f64 = 1e-15;
/// Ratio of successive corrections above which columns are nearly dependent.
const MAX_CORRECTION_RATIO: f64 = 1e-2;

/// Contribution of one response to the normal equations.
pub(super) struct NormalEquations {
    /// `J^T P J` and `J^T P e`.
    pub normal: Mat<f64>,
    pub rhs: Mat<f64>,
    /// Squared norm of the residual.
    pub error: f64,
}

impl NormalEquations {
    /// Computes the contribution; `None` where the linear columns are nearly dependent.
    pub fn of(weighted: &WeightedResponse, terms: &DesignMatrix) -> Option<Self> {
        let (width, columns) = (
            terms.linear.ncols(),
            terms.linear.ncols() + terms.derivatives.ncols(),
        );
        let products = products(weighted, terms);
        let scale: Vec<f64> = (0..columns).map(|c| products[(c, c)].sqrt()).collect();
        if !scale.iter().all(|x| x.is_finite() && *x > 0.0) {
            return None;
        }
        let scaled_product =
            |r: usize, c: usize| products[(r.max(c), r.min(c))] / (scale[r] * scale[c]);
        let factor = CholeskyFactor::of(Mat::from_fn(width, width, scaled_product))?;
        let mixed = Mat::from_fn(width, columns - width, |r, c| scaled_product(r, width + c));
        let initial = factor.solve(&Mat::from_fn(width, 1, |r, _| {
            products[(columns, r)] / scale[r]
        }));
        let LinearResidual {
            unknown,
            rhs,
            error,
        } = LinearResidual::corrected(weighted, terms, (&scale, &factor, &mixed), initial)?;
        let solved = factor.solve_lower(&mixed);
        let schur = Mat::from_fn(columns - width, columns - width, |r, c| {
            scaled_product(width + r, width + c)
        }) - solved.transpose() * &solved;
        // Derivatives by the real and the imaginary part of a pole: its residue x + j y turns the
        // columns of S.
        let rotated = |r: usize, value: &dyn Fn(usize) -> f64| {
            let (x, y) = (unknown[(r & !1, 0)], unknown[(r | 1, 0)]);
            if r.is_multiple_of(2) {
                x * value(r) + y * value(r + 1)
            } else {
                x * value(r) - y * value(r - 1)
            }
        };
        let unscaled = |r: usize, c: usize| schur[(r, c)] * scale[width + r] * scale[width + c];
        let pole_columns = columns - width;
        let by_columns = Mat::from_fn(pole_columns, pole_columns, |r, c| {
            rotated(c, &|c| unscaled(r, c))
        });
        Some(Self {
            normal: Mat::from_fn(pole_columns, pole_columns, |r, c| {
                rotated(r, &|r| by_columns[(r, c)])
            }),
            rhs: Mat::from_fn(pole_columns, 1, |r, _| {
                rotated(r, &|r| rhs[(r, 0)] * scale[width + r])
            }),
            error,
        })
    }
}

/// Linear unknowns and their residual.
struct LinearResidual {
    unknown: Mat<f64>,
    /// `S^T P b`, scaled as the columns.
    rhs: Mat<f64>,
    error: f64,
}

impl LinearResidual {
    fn corrected(
        weighted: &WeightedResponse,
        terms: &DesignMatrix,
        (scale, factor, mixed): (&[f64], &CholeskyFactor, &Mat<f64>),
        mut scaled: Mat<f64>,
    ) -> Option<Self> {
        let width = mixed.nrows();
        let mut previous_size = scaled.norm();
        loop {
            let unknown = Mat::from_fn(width, 1, |c, _| scaled[(c, 0)] / scale[c]);
            let (by_columns, squared_residual) = residual_products(weighted, terms, &unknown);
            let scaled_gradient = Mat::from_fn(width, 1, |c, _| by_columns[c] / scale[c]);
            let correction = factor.solve(&scaled_gradient);
            let (correction_size, solution_size) = (correction.norm(), scaled.norm());
            scaled += &correction;
            if correction_size * correction_size
                <= CORRECTION_TOLERANCE * previous_size * solution_size
            {
                let rhs = Mat::from_fn(mixed.ncols(), 1, |c, _| {
                    by_columns[width + c] / scale[width + c]
                }) - mixed.transpose() * &correction;
                return Some(Self {
                    unknown: Mat::from_fn(width, 1, |c, _| scaled[(c, 0)] / scale[c]),
                    rhs,
                    error: (squared_residual - (correction.transpose() * &scaled_gradient)[(0, 0)])
                        .max(0.0),
                });
            }
            let is_converging = correction_size <= MAX_CORRECTION_RATIO * previous_size;
            if !is_converging {
                return None;
            }
            previous_size = correction_size;
        }
    }
}

/// Products of all pairs of columns: those of `A`, of `S`, then `b`. Lower triangle.
fn products(weighted: &WeightedResponse, terms: &DesignMatrix) -> Mat<f64> {
    let (rows, width, derivatives) = (
        terms.linear.nrows(),
        terms.linear.ncols(),
        terms.derivatives.ncols(),
    );
    let total_columns = width + derivatives + 1;
    let (mut sums, mut block) = (
        Mat::<f64>::zeros(total_columns, total_columns),
        Mat::<f64>::zeros(ROWS_AT_ONCE, total_columns),
    );
    for from in (0..rows).step_by(ROWS_AT_ONCE) {
        let count = ROWS_AT_ONCE.min(rows - from);
        let weight = &weighted.weight[from / 2..(from + count) / 2];
        for c in 0..total_columns {
            let block_column = column_mut(&mut block, c).as_chunks_mut::<2>().0.iter_mut();
            if c == width + derivatives {
                block_column
                    .zip(&weighted.value[from / 2..])
                    .for_each(|(x, value)| *x = [value.re, value.im]);
                continue;
            }
            let source = if c < width {
                column(&terms.linear, c)
            } else {
                column(&terms.derivatives, c - width)
            };
            for ((x, source), weight) in block_column
                .zip(source[from..].as_chunks::<2>().0)
                .zip(weight)
            {
                *x = source.map(|source| weight * source);
            }
        }
        add_gram(&mut sums, &block, count);
    }
    sums
}

/// Residual of the response: its products with the columns of `A` and of `S`, and its square.
fn residual_products(
    weighted: &WeightedResponse,
    terms: &DesignMatrix,
    unknown: &Mat<f64>,
) -> (Vec<f64>, f64) {
    let (rows, width, derivatives) = (
        terms.linear.nrows(),
        terms.linear.ncols(),
        terms.derivatives.ncols(),
    );
    let (mut sums, mut squared_residual) = (vec![0.0; width + derivatives], 0.0);
    let (of_linear, of_derivatives) = sums.split_at_mut(width);
    for from in (0..rows).step_by(ROWS_AT_ONCE) {
        let block = from..rows.min(from + ROWS_AT_ONCE);
        let mut residual = row_product(&terms.linear, block.clone(), column(unknown, 0));
        for (row, residual) in block.clone().zip(&mut residual) {
            let (value, weight) = (weighted.value[row / 2], weighted.weight[row / 2]);
            let part = if row.is_multiple_of(2) {
                value.re
            } else {
                value.im
            };
            let line_residual = part - weight * *residual;
            squared_residual += line_residual * line_residual;
            *residual = weight * line_residual;
        }
        add_transposed_product(of_linear, &terms.linear, block.clone(), &residual);
        add_transposed_product(of_derivatives, &terms.derivatives, block, &residual);
    }
    (sums, squared_residual)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::super::likelihood::by_orthogonal_columns;
    use super::*;
    use jounce_linalg::c64;
    use jounce_signal::RandomStream;
    use jounce_signal::spectral::WindowBias;

    /// A response of three modes, two of them close, in noise and under uneven weights, and the
    /// terms of a fit at slightly wrong poles.
    fn example_response(poles: &[c64], upper: usize) -> (WeightedResponse, DesignMatrix) {
        let angular: Vec<f64> = (40..900).map(|k| 1.5 * f64::from(k)).collect();
        let window_bias = WindowBias::Cut { length_s: 2.0 };
        let terms = DesignMatrix::of_kinds(window_bias, &[2], &angular, poles, upper).remove(0);
        let mut stream = RandomStream::new(3, 9);
        let weight: Vec<f64> = angular
            .iter()
            .map(|w| 1.0 + (0.02 * w).sin().powi(2))
            .collect();
        let value = (0..angular.len()).map(|k| {
            let real_sum: f64 = (0..2 * poles.len()).map(|c| terms.linear[(2 * k, c)]).sum();
            let imaginary_sum: f64 = (0..2 * poles.len())
                .map(|c| terms.linear[(2 * k + 1, c)])
                .sum();
            let [re, im] = stream.normal_pair();
            c64::new(1.01 * real_sum + 1e-3 * re, imaginary_sum + 1e-3 * im) * weight[k]
        });
        let value = value.collect();
        (
            WeightedResponse {
                kind: 0,
                weight,
                value,
            },
            terms,
        )
    }

    /// Compares with orthogonal columns. Measured: right side and error within 6e-15 of their
    /// sizes. The matrix, which affects only step lengths, agrees within 8e-15 with up to four
    /// terms above the band, and 2.4e-9 with eight nearly dependent ones.
    #[test]
    fn result_is_that_of_orthogonal_columns() {
        let poles = [
            c64::new(-2.0, 200.0),
            c64::new(-3.0, 204.0),
            c64::new(-5.0, 900.0),
        ];
        for upper in [1, 4, 8] {
            let (weighted, terms) = example_response(&poles, upper);
            let (result, expected) = (
                NormalEquations::of(&weighted, &terms).unwrap(),
                by_orthogonal_columns(&weighted, &terms),
            );
            let errors = [
                (&result.normal - &expected.normal).norm() / expected.normal.norm(),
                (&result.rhs - &expected.rhs).norm()
                    / (expected.normal.norm() * expected.error).sqrt(),
                (result.error / expected.error - 1.0).abs(),
            ];
            eprintln!(
                "{upper} terms above: {:.1e}, {:.1e}, {:.1e} off",
                errors[0], errors[1], errors[2]
            );
            assert!(
                errors[0] < 1e-7 && errors[1] < 1e-12 && errors[2] < 1e-12,
                "{upper}: {errors:?}"
            );
        }
    }

    /// Two poles at one frequency have equal columns.
    #[test]
    fn nearly_equal_columns_are_refused() {
        let (weighted, terms) =
            example_response(&[c64::new(-2.0, 200.0), c64::new(-2.0, 200.0)], 1);
        assert!(NormalEquations::of(&weighted, &terms).is_none());
    }
}
