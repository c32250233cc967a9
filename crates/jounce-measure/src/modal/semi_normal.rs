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

use faer::linalg::matmul::matmul;
use faer::linalg::matmul::triangular::{BlockStructure, matmul as triangular};
use faer::linalg::solvers::{Llt, Solve};
use faer::{Accum, Mat, Par, Side};

use super::design_matrix::DesignMatrix;
use super::likelihood::WeightedResponse;

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
    pub right: Mat<f64>,
    /// Squared norm of the residual.
    pub error: f64,
}

impl NormalEquations {
    /// Computes the contribution; `None` where the linear columns are nearly dependent.
    pub fn of(weighed: &WeightedResponse, terms: &DesignMatrix) -> Option<Self> {
        let (width, columns) = (
            terms.linear.ncols(),
            terms.linear.ncols() + terms.squares.ncols(),
        );
        let products = products(weighed, terms);
        let scale: Vec<f64> = (0..columns).map(|c| products[(c, c)].sqrt()).collect();
        if !scale.iter().all(|x| x.is_finite() && *x > 0.0) {
            return None;
        }
        let of = |r: usize, c: usize| products[(r.max(c), r.min(c))] / (scale[r] * scale[c]);
        let factor = Mat::from_fn(width, width, of).llt(Side::Lower).ok()?;
        let mixed = Mat::from_fn(width, columns - width, |r, c| of(r, width + c));
        let begun = factor.solve(Mat::from_fn(width, 1, |r, _| {
            products[(columns, r)] / scale[r]
        }));
        let LinearResidual {
            unknown,
            right,
            error,
        } = LinearResidual::corrected(weighed, terms, (&scale, &factor, &mixed), begun)?;
        let mut taken = mixed.clone();
        factor.L().solve_lower_triangular_in_place(&mut taken);
        let beyond = Mat::from_fn(columns - width, columns - width, |r, c| {
            of(width + r, width + c)
        }) - taken.transpose() * &taken;
        // Derivatives by the real and the imaginary part of a pole: its residue x + j y turns the
        // columns of S.
        let turned = |r: usize, of: &dyn Fn(usize) -> f64| {
            let (x, y) = (unknown[(r & !1, 0)], unknown[(r | 1, 0)]);
            if r.is_multiple_of(2) {
                x * of(r) + y * of(r + 1)
            } else {
                x * of(r) - y * of(r - 1)
            }
        };
        let unscaled = |r: usize, c: usize| beyond[(r, c)] * scale[width + r] * scale[width + c];
        let size = columns - width;
        let by_columns = Mat::from_fn(size, size, |r, c| turned(c, &|c| unscaled(r, c)));
        Some(Self {
            normal: Mat::from_fn(size, size, |r, c| turned(r, &|r| by_columns[(r, c)])),
            right: Mat::from_fn(size, 1, |r, _| {
                turned(r, &|r| right[(r, 0)] * scale[width + r])
            }),
            error,
        })
    }
}

/// Linear unknowns and their residual.
struct LinearResidual {
    unknown: Mat<f64>,
    /// `S^T P b`, scaled as the columns.
    right: Mat<f64>,
    error: f64,
}

impl LinearResidual {
    fn corrected(
        weighed: &WeightedResponse,
        terms: &DesignMatrix,
        (scale, factor, mixed): (&[f64], &Llt<f64>, &Mat<f64>),
        mut scaled: Mat<f64>,
    ) -> Option<Self> {
        let width = mixed.nrows();
        let mut before = scaled.norm_l2();
        loop {
            let unknown = Mat::from_fn(width, 1, |c, _| scaled[(c, 0)] / scale[c]);
            let (by_columns, square) = left(weighed, terms, &unknown);
            let wrong = Mat::from_fn(width, 1, |c, _| by_columns[(c, 0)] / scale[c]);
            let change = factor.solve(&wrong);
            let (size, all) = (change.norm_l2(), scaled.norm_l2());
            scaled += &change;
            if size * size <= CORRECTION_TOLERANCE * before * all {
                let right = Mat::from_fn(mixed.ncols(), 1, |c, _| {
                    by_columns[(width + c, 0)] / scale[width + c]
                }) - mixed.transpose() * &change;
                return Some(Self {
                    unknown: Mat::from_fn(width, 1, |c, _| scaled[(c, 0)] / scale[c]),
                    right,
                    error: (square - (change.transpose() * &wrong)[(0, 0)]).max(0.0),
                });
            }
            let shrinks = size <= MAX_CORRECTION_RATIO * before;
            if !shrinks {
                return None;
            }
            before = size;
        }
    }
}

/// Products of all pairs of columns: those of `A`, of `S`, then `b`. Lower triangle.
fn products(weighed: &WeightedResponse, terms: &DesignMatrix) -> Mat<f64> {
    let (rows, width, squares) = (
        terms.linear.nrows(),
        terms.linear.ncols(),
        terms.squares.ncols(),
    );
    let all = width + squares + 1;
    let (mut sums, mut block) = (
        Mat::<f64>::zeros(all, all),
        Mat::<f64>::zeros(ROWS_AT_ONCE, all),
    );
    for from in (0..rows).step_by(ROWS_AT_ONCE) {
        let count = ROWS_AT_ONCE.min(rows - from);
        let weight = &weighed.weight[from / 2..(from + count) / 2];
        for (c, column) in block.col_iter_mut().enumerate() {
            let Some(column) = column.try_as_col_major_mut() else {
                continue;
            };
            let column = column.as_slice_mut().as_chunks_mut::<2>().0.iter_mut();
            if c == width + squares {
                column
                    .zip(&weighed.value[from / 2..])
                    .for_each(|(x, value)| *x = [value.re, value.im]);
                continue;
            }
            let of = if c < width {
                terms.linear.col_as_slice(c)
            } else {
                terms.squares.col_as_slice(c - width)
            };
            for ((x, of), weight) in column.zip(of[from..].as_chunks::<2>().0).zip(weight) {
                *x = of.map(|of| weight * of);
            }
        }
        let block = block.subrows(0, count);
        let (lower, whole) = (BlockStructure::TriangularLower, BlockStructure::Rectangular);
        triangular(
            &mut sums,
            lower,
            Accum::Add,
            block.transpose(),
            whole,
            block,
            whole,
            1.0,
            Par::Seq,
        );
    }
    sums
}

/// Residual of the response: its products with the columns of `A` and of `S`, and its square.
fn left(weighed: &WeightedResponse, terms: &DesignMatrix, unknown: &Mat<f64>) -> (Mat<f64>, f64) {
    let (rows, width, squares) = (
        terms.linear.nrows(),
        terms.linear.ncols(),
        terms.squares.ncols(),
    );
    let (mut sums, mut square) = (Mat::<f64>::zeros(width + squares, 1), 0.0);
    let mut rest = Mat::<f64>::zeros(ROWS_AT_ONCE, 1);
    for from in (0..rows).step_by(ROWS_AT_ONCE) {
        let count = ROWS_AT_ONCE.min(rows - from);
        let (linear, own) = (
            terms.linear.subrows(from, count),
            terms.squares.subrows(from, count),
        );
        let mut rest = rest.subrows_mut(0, count);
        matmul(&mut rest, Accum::Replace, linear, unknown, 1.0, Par::Seq);
        for row in 0..count {
            let k = (from + row) / 2;
            let (value, weight) = (weighed.value[k], weighed.weight[k]);
            let left = if row.is_multiple_of(2) {
                value.re
            } else {
                value.im
            } - weight * rest[(row, 0)];
            square += left * left;
            rest[(row, 0)] = weight * left;
        }
        matmul(
            sums.subrows_mut(0, width),
            Accum::Add,
            linear.transpose(),
            &rest,
            1.0,
            Par::Seq,
        );
        matmul(
            sums.subrows_mut(width, squares),
            Accum::Add,
            own.transpose(),
            &rest,
            1.0,
            Par::Seq,
        );
    }
    (sums, square)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::super::likelihood::by_orthogonal_columns;
    use super::*;
    use crate::spectral::WindowBias;
    use faer::c64;
    use jounce_core::drive::RandomStream;

    /// A response of three modes, two of them close, in noise and under uneven weights, and the
    /// terms of a fit at slightly wrong poles.
    fn made(poles: &[c64], upper: usize) -> (WeightedResponse, DesignMatrix) {
        let angular: Vec<f64> = (40..900).map(|k| 1.5 * f64::from(k)).collect();
        let sight = WindowBias::Cut { length_s: 2.0 };
        let terms = DesignMatrix::of_kinds(sight, &[2], &angular, poles, upper).remove(0);
        let mut stream = RandomStream::new(3, 9);
        let weight: Vec<f64> = angular
            .iter()
            .map(|w| 1.0 + (0.02 * w).sin().powi(2))
            .collect();
        let value = (0..angular.len()).map(|k| {
            let sum: f64 = (0..2 * poles.len()).map(|c| terms.linear[(2 * k, c)]).sum();
            let odd: f64 = (0..2 * poles.len())
                .map(|c| terms.linear[(2 * k + 1, c)])
                .sum();
            let [re, im] = stream.normal_pair();
            c64::new(1.01 * sum + 1e-3 * re, odd + 1e-3 * im) * weight[k]
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
    fn it_gives_what_orthogonal_columns_give() {
        let poles = [
            c64::new(-2.0, 200.0),
            c64::new(-3.0, 204.0),
            c64::new(-5.0, 900.0),
        ];
        for upper in [1, 4, 8] {
            let (weighed, terms) = made(&poles, upper);
            let (found, due) = (
                NormalEquations::of(&weighed, &terms).unwrap(),
                by_orthogonal_columns(&weighed, &terms),
            );
            let off = [
                (&found.normal - &due.normal).norm_l2() / due.normal.norm_l2(),
                (&found.right - &due.right).norm_l2() / (due.normal.norm_l2() * due.error).sqrt(),
                (found.error / due.error - 1.0).abs(),
            ];
            eprintln!(
                "{upper} terms above: {:.1e}, {:.1e}, {:.1e} off",
                off[0], off[1], off[2]
            );
            assert!(
                off[0] < 1e-7 && off[1] < 1e-12 && off[2] < 1e-12,
                "{upper}: {off:?}"
            );
        }
    }

    /// Two poles at one frequency have equal columns.
    #[test]
    fn columns_that_are_alike_are_left_to_orthogonal_ones() {
        let (weighed, terms) = made(&[c64::new(-2.0, 200.0), c64::new(-2.0, 200.0)], 1);
        assert!(NormalEquations::of(&weighed, &terms).is_none());
    }
}
