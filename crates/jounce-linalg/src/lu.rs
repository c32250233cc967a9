//! `L U` of a square matrix with its rows exchanged, in the vector instructions of the machine.
//!
//! Newton's method of an orbit factors one matrix of tens of rows per step. `nalgebra` compiles for
//! the oldest processor of its kind; harmonic balance took 1.4 times the instructions with it.
//!
//! Source: G. Golub, C. Van Loan, Matrix Computations, 4th ed., 2013, algorithm 3.4.1.

use crate::{Mat, column};
use jounce_simd::{F64x8, LANES, Simd, Task, widest};

/// `L U` of a square matrix with its rows exchanged.
#[derive(Debug)]
pub struct LuFactors {
    /// Columns of `L` below the diagonal, and of `U`, each filled up to whole vectors.
    columns: Vec<F64x8>,
    /// Row with which each row was exchanged, in the order of the exchanges.
    exchanged: Vec<usize>,
}

impl LuFactors {
    /// Factors a square matrix.
    pub fn of(matrix: &Mat<f64>) -> Self {
        let rows = matrix.nrows();
        let columns = (0..rows).flat_map(|j| vectors(column(matrix, j)));
        let mut factors = Self {
            columns: columns.collect(),
            exchanged: Vec::with_capacity(rows),
        };
        widest(Factoring(&mut factors, rows));
        factors
    }

    /// Solves for a right side, in place; the solution is not finite where the matrix is singular.
    pub fn solve(&self, right: &mut [f64]) {
        for (k, other) in self.exchanged.iter().enumerate() {
            right.swap(k, *other);
        }
        let mut solution: Vec<F64x8> = vectors(right).collect();
        widest(Substitution(self, &mut solution));
        let solution = solution.iter().flat_map(|vector| vector.0);
        right.iter_mut().zip(solution).for_each(|(x, y)| *x = y);
    }

    /// Column of both factors.
    #[inline(always)]
    fn column(&self, k: usize) -> &[F64x8] {
        let count = self.exchanged.len().div_ceil(LANES);
        &self.columns[k * count..(k + 1) * count]
    }
}

/// Numbers in whole vectors, filled up with zeros.
fn vectors(numbers: &[f64]) -> impl Iterator<Item = F64x8> {
    numbers.chunks(LANES).map(|chunk| {
        let mut vector = F64x8::ZERO;
        vector.0[..chunk.len()].copy_from_slice(chunk);
        vector
    })
}

struct Factoring<'f>(&'f mut LuFactors, usize);

impl Task for Factoring<'_> {
    type Output = ();

    #[inline(always)]
    fn run<W: Simd>(self, w: W) {
        let Self(LuFactors { columns, exchanged }, rows) = self;
        let count = rows.div_ceil(LANES);
        let mut multipliers = vec![F64x8::ZERO; count];
        for (k, first) in (0..rows).map(|k| (k, k / LANES)) {
            let at = |i: usize, j: usize| (j * count + i / LANES, i % LANES);
            let entry = |columns: &[F64x8], (vector, lane): (usize, usize)| columns[vector].0[lane];
            let pivot = (k..rows).fold(k, |largest, i| {
                let [old, new] = [largest, i].map(|i| entry(columns, at(i, k)).abs());
                if new > old { i } else { largest }
            });
            exchanged.push(pivot);
            for j in 0..rows {
                let ((a, a_lane), (b, b_lane)) = (at(k, j), at(pivot, j));
                (columns[a].0[a_lane], columns[b].0[b_lane]) =
                    (columns[b].0[b_lane], columns[a].0[a_lane]);
            }
            // The multipliers of the rows below, zero for the others.
            let reciprocal = w.splat(1.0 / entry(columns, at(k, k)));
            multipliers[first] = F64x8::ZERO;
            for i in k + 1..rows.min((first + 1) * LANES) {
                multipliers[first].0[i % LANES] = entry(columns, at(i, k));
            }
            multipliers[first + 1..]
                .copy_from_slice(&columns[k * count + first + 1..(k + 1) * count]);
            for vector in &mut multipliers[first..] {
                *vector = w.store(w.mul(w.load(vector), reciprocal));
            }
            for i in k + 1..rows.min((first + 1) * LANES) {
                columns[k * count + first].0[i % LANES] = multipliers[first].0[i % LANES];
            }
            columns[k * count + first + 1..(k + 1) * count]
                .copy_from_slice(&multipliers[first + 1..]);
            for j in k + 1..rows {
                let column = &mut columns[j * count..(j + 1) * count];
                let factor = w.splat(-column[first].0[k % LANES]);
                for (vector, multiplier) in column[first..].iter_mut().zip(&multipliers[first..]) {
                    *vector = w.store(w.fma(factor, w.load(multiplier), w.load(vector)));
                }
            }
        }
    }
}

struct Substitution<'f>(&'f LuFactors, &'f mut [F64x8]);

impl Task for Substitution<'_> {
    type Output = ();

    #[inline(always)]
    fn run<W: Simd>(self, w: W) {
        let Self(factors, x) = self;
        let rows = factors.exchanged.len();
        for (k, own, lane) in (0..rows).map(|k| (k, k / LANES, k % LANES)) {
            let column = factors.column(k);
            let solved = x[own].0[lane];
            for i in lane + 1..LANES {
                x[own].0[i] -= column[own].0[i] * solved;
            }
            let factor = w.splat(-solved);
            for (x, l) in x[own + 1..].iter_mut().zip(&column[own + 1..]) {
                *x = w.store(w.fma(factor, w.load(l), w.load(x)));
            }
        }
        for (k, own, lane) in (0..rows).rev().map(|k| (k, k / LANES, k % LANES)) {
            let column = factors.column(k);
            let solved = x[own].0[lane] / column[own].0[lane];
            x[own].0[lane] = solved;
            for i in 0..lane {
                x[own].0[i] -= column[own].0[i] * solved;
            }
            let factor = w.splat(-solved);
            for (x, u) in x[..own].iter_mut().zip(column) {
                *x = w.store(w.fma(factor, w.load(u), w.load(x)));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_solves(matrix: &Mat<f64>, tolerance: f64) {
        let rows = matrix.nrows();
        let exact = Mat::from_fn(rows, 1, |i, _| 1.0 - 0.3 * i as f64);
        let right = matrix * &exact;
        let mut solution = column(&right, 0).to_vec();
        LuFactors::of(matrix).solve(&mut solution);
        let error = crate::distance(&solution, column(&exact, 0));
        assert!(error <= tolerance, "{rows} rows: {error:e}");
    }

    #[test]
    fn rows_that_must_be_exchanged() {
        let rows = [[0.0, 2.0, 1.0], [1.0, 0.0, 3.0], [4.0, 1.0, 0.0]];
        assert_solves(&Mat::from_fn(3, 3, |i, j| rows[i][j]), 1e-15);
    }

    /// Sizes around whole vectors. The matrices, of distinct sines, have condition numbers up to
    /// 1e4.
    #[test]
    fn all_sizes() {
        for rows in 1..40 {
            let matrix = Mat::from_fn(rows, rows, |i, j| {
                (1.0 + 1.7 * (i * i + 3 * j * j + i * j) as f64).sin()
            });
            assert_solves(&matrix, 1e-10);
        }
    }

    #[test]
    fn singular_matrices_have_no_finite_solution() {
        let mut right = [1.0, 2.0];
        LuFactors::of(&Mat::from_element(2, 2, 1.0)).solve(&mut right);
        assert!(right.iter().all(|x| !x.is_finite()), "{right:?}");
    }
}
