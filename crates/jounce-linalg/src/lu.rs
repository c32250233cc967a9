//! `L U` of a square matrix with its rows exchanged, in the vector instructions of the machine.
//!
//! Newton's method of an orbit factors one matrix of tens of rows per step. `nalgebra` compiles for
//! the oldest processor of its kind; harmonic balance took 1.4 times the instructions with it.
//!
//! Source: G. Golub, C. Van Loan, Matrix Computations, 4th ed., 2013, algorithm 3.4.1.

use crate::{Mat, column};
use jounce_simd::{F64x8, LANES, Simd, Task, widest};
use std::array;

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
        let mut factors = Self {
            columns: Vec::with_capacity(rows * rows.div_ceil(LANES)),
            exchanged: Vec::with_capacity(rows),
        };
        for j in 0..rows {
            push_vectors(&mut factors.columns, column(matrix, j));
        }
        widest(Factoring(&mut factors, rows));
        factors
    }

    /// Solves for a right side, in place; the solution is not finite where the matrix is singular.
    pub fn solve(&self, right: &mut [f64]) {
        for (k, other) in self.exchanged.iter().enumerate() {
            right.swap(k, *other);
        }
        let mut solution = Vec::with_capacity(right.len().div_ceil(LANES));
        push_vectors(&mut solution, right);
        widest(Substitution(self, &mut solution));
        for (entries, vector) in right.chunks_mut(LANES).zip(&solution) {
            entries.copy_from_slice(&vector.0[..entries.len()]);
        }
    }

    /// Column of both factors.
    #[inline(always)]
    fn column(&self, k: usize) -> &[F64x8] {
        let count = self.exchanged.len().div_ceil(LANES);
        &self.columns[k * count..(k + 1) * count]
    }
}

/// Appends numbers in whole vectors, filled up with zeros.
fn push_vectors(to: &mut Vec<F64x8>, numbers: &[f64]) {
    let (whole, rest) = numbers.as_chunks::<LANES>();
    to.extend(whole.iter().map(|chunk| F64x8(*chunk)));
    if !rest.is_empty() {
        let mut vector = F64x8::ZERO;
        vector.0[..rest.len()].copy_from_slice(rest);
        to.push(vector);
    }
}

struct Factoring<'f>(&'f mut LuFactors, usize);

impl Task for Factoring<'_> {
    type Output = ();

    /// Factors as many columns as a vector has numbers, then updates the columns after them.
    #[inline(always)]
    fn run<W: Simd>(self, w: W) {
        let Self(LuFactors { columns, exchanged }, rows) = self;
        let count = rows.div_ceil(LANES);
        for first in 0..count {
            let panel = first * LANES..rows.min((first + 1) * LANES);
            for k in panel.clone() {
                exchanged.push(exchange(columns, count, k));
                divide(
                    w,
                    &mut columns[k * count + first..(k + 1) * count],
                    k % LANES,
                );
                let (before, after) = columns.split_at_mut((k + 1) * count);
                let factor = &before[k * count + first..];
                let top = below(&factor[0], k % LANES);
                for j in 0..panel.end - k - 1 {
                    let column = &mut after[j * count + first..(j + 1) * count];
                    let share = -column[0].0[k % LANES];
                    add_multiple(w, &mut column[..1], share, &[top]);
                    add_multiple(w, &mut column[1..], share, &factor[1..]);
                }
            }
            let (before, after) = columns.split_at_mut(panel.end * count);
            let factors = &before[panel.start * count..];
            if panel.end < rows {
                let mut lower = [F64x8::ZERO; LANES];
                for k in 0..LANES {
                    lower[k] = below(&factors[k * count + first], k);
                }
                for j in 0..rows - panel.end {
                    let column = &mut after[j * count + first..(j + 1) * count];
                    update(w, column, (&lower, &factors[first..]), count);
                }
            }
        }
    }
}

/// Exchanges row `k` with the one that has the largest pivot, and returns that row.
#[inline(always)]
fn exchange(columns: &mut [F64x8], count: usize, k: usize) -> usize {
    let first = k / LANES;
    let column = &columns[k * count + first..(k + 1) * count];
    let (mut pivot, mut largest) = (k, column[0].0[k % LANES].abs());
    for (v, vector) in column.iter().enumerate() {
        for (lane, entry) in vector.0.iter().enumerate() {
            let row = (first + v) * LANES + lane;
            if entry.abs() > largest && row > k {
                (pivot, largest) = (row, entry.abs());
            }
        }
    }
    if pivot != k {
        let [(own, lane), (other, other_lane)] = [k, pivot].map(|row| (row / LANES, row % LANES));
        for column in columns.chunks_exact_mut(count) {
            let entry = column[own].0[lane];
            column[own].0[lane] = column[other].0[other_lane];
            column[other].0[other_lane] = entry;
        }
    }
    pivot
}

/// Divides the entries below the diagonal, which lies at `lane` of the first vector, by it.
#[inline(always)]
fn divide<W: Simd>(w: W, column: &mut [F64x8], lane: usize) {
    let reciprocal = 1.0 / column[0].0[lane];
    for i in lane + 1..LANES {
        column[0].0[i] *= reciprocal;
    }
    for vector in &mut column[1..] {
        *vector = w.store(w.mul(w.splat(reciprocal), w.load(vector)));
    }
}

/// Adds a multiple of a column to another.
#[inline(always)]
fn add_multiple<W: Simd>(w: W, column: &mut [F64x8], factor: f64, other: &[F64x8]) {
    // A zip would be called, not inlined.
    let other = &other[..column.len()];
    for i in 0..column.len() {
        column[i] = w.store(w.fma(w.splat(factor), w.load(&other[i]), w.load(&column[i])));
    }
}

/// The entries below one of a vector, zero for the others.
#[inline(always)]
fn below(vector: &F64x8, lane: usize) -> F64x8 {
    let mut rest = F64x8::ZERO;
    for i in lane + 1..LANES {
        rest.0[i] = vector.0[i];
    }
    rest
}

/// Updates a column, from the first row of a whole vector of factored columns, by these. `lower` are
/// their entries below the diagonal in the first vector.
#[inline(always)]
fn update<W: Simd>(
    w: W,
    column: &mut [F64x8],
    (lower, factors): (&[F64x8; LANES], &[F64x8]),
    stride: usize,
) {
    let mut shares = [w.zero(); LANES];
    for k in 0..LANES {
        shares[k] = w.splat(-column[0].0[k]);
        column[0] = w.store(w.fma(shares[k], w.load(&lower[k]), w.load(&column[0])));
    }
    let parts: [&[F64x8]; LANES] =
        array::from_fn(|k| &factors[k * stride..k * stride + column.len()]);
    for v in 1..column.len() {
        let mut sum = w.load(&column[v]);
        for k in 0..LANES {
            sum = w.fma(shares[k], w.load(&parts[k][v]), sum);
        }
        column[v] = w.store(sum);
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
            add_multiple(w, &mut x[own + 1..], -solved, &column[own + 1..]);
        }
        for (k, own, lane) in (0..rows).rev().map(|k| (k, k / LANES, k % LANES)) {
            let column = factors.column(k);
            let solved = x[own].0[lane] / column[own].0[lane];
            x[own].0[lane] = solved;
            for i in 0..lane {
                x[own].0[i] -= column[own].0[i] * solved;
            }
            add_multiple(w, &mut x[..own], -solved, &column[..own]);
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
