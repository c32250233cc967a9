//! Eigenvalues and eigenvectors.
//!
//! Eigenvectors of a real matrix without symmetry come from its real Schur form `A = Q T Q^T`: for
//! each eigenvalue, back substitution in `(T - lambda) y = 0`, `x = Q y`. `T` has blocks of two rows
//! on its diagonal for pairs of complex eigenvalues.
//!
//! Source: G. Golub, C. Van Loan, Matrix Computations, 4th ed., 2013, section 7.6.4.

use crate::{LuFactors, Mat, SWEEPS_PER_ROW, c64, column_mut};
use nalgebra::{ComplexField, DVector, Schur};
use std::sync::OnceLock;

/// Eigenvalues of a matrix and the columns of their eigenvectors.
#[derive(Debug, Clone)]
pub struct Eigen {
    /// Eigenvalues; complex ones in successive conjugate pairs.
    pub values: Vec<c64>,
    /// Eigenvectors of length 1 whose largest entry is real, one per column; those of a pair are
    /// conjugate.
    pub vectors: Mat<c64>,
    /// Result of [`Self::basis`], computed at the first call.
    basis: OnceLock<[Mat<f64>; 2]>,
}

/// The factor of magnitude 1 that makes the largest entry real.
fn phase(vector: &[c64]) -> c64 {
    let largest = vector
        .iter()
        .max_by(|a, b| a.norm_sqr().total_cmp(&b.norm_sqr()));
    largest.map_or(c64::new(1.0, 0.0), |x| x.conj() / x.norm())
}

/// Returns eigenvalues and eigenvectors; `None` without convergence.
pub fn eigen(matrix: &Mat<f64>) -> Option<Eigen> {
    let n = matrix.nrows();
    let (q, t) = schur(matrix)?;
    let norm = t.norm();
    let values = block_values(&t);
    let mut vectors = Mat::zeros(n, n);
    let mut k = 0;
    while k < n {
        let rows = diagonal_block(&t, k);
        let y = back_substituted(&t, k, values[k], norm);
        let x: Vec<c64> = (0..n)
            .map(|i| (0..k + rows).map(|j| y[j] * q[(i, j)]).sum())
            .collect();
        let scale = phase(&x) / x.iter().map(c64::norm_sqr).sum::<f64>().sqrt();
        for (i, x) in x.iter().enumerate() {
            vectors[(i, k)] = x * scale;
            if rows == 2 {
                vectors[(i, k + 1)] = vectors[(i, k)].conj();
            }
        }
        k += rows;
    }
    Some(Eigen {
        values,
        vectors,
        basis: OnceLock::new(),
    })
}

/// Place of an eigenvalue in a pair.
#[derive(Clone, Copy)]
enum Place {
    Real,
    First,
    Second,
}

impl Eigen {
    /// Returns `V^-1 B V`, a matrix `B` in the basis of the eigenvectors `V`; not finite where they
    /// are dependent.
    ///
    /// With the real and the imaginary part of each pair as a real basis `W`, `V = W P`, the work is
    /// that of the real `W^-1 B W`.
    pub fn transformed(&self, matrix: &Mat<f64>) -> Mat<c64> {
        let n = self.values.len();
        let places = self.places();
        let [basis, inverse] = self.basis(&places);
        let real = inverse * (matrix * basis);
        let columns = Mat::from_fn(n, n, |i, j| match places[j] {
            Place::Real => c64::new(real[(i, j)], 0.0),
            Place::First => c64::new(real[(i, j)], real[(i, j + 1)]),
            Place::Second => c64::new(real[(i, j - 1)], -real[(i, j)]),
        });
        Mat::from_fn(n, n, |i, j| match places[i] {
            Place::Real => columns[(i, j)],
            Place::First => 0.5 * (columns[(i, j)] - c64::i() * columns[(i + 1, j)]),
            Place::Second => 0.5 * (columns[(i - 1, j)] + c64::i() * columns[(i, j)]),
        })
    }

    /// Returns `W` and its inverse.
    fn basis(&self, places: &[Place]) -> &[Mat<f64>; 2] {
        self.basis.get_or_init(|| {
            let n = places.len();
            let basis = Mat::from_fn(n, n, |i, j| match places[j] {
                Place::Second => self.vectors[(i, j - 1)].im,
                Place::Real | Place::First => self.vectors[(i, j)].re,
            });
            let factors = LuFactors::of(&basis);
            let mut inverse = Mat::identity(n, n);
            (0..n).for_each(|j| factors.solve(column_mut(&mut inverse, j)));
            [basis, inverse]
        })
    }

    fn places(&self) -> Vec<Place> {
        let mut places = Vec::with_capacity(self.values.len());
        while let Some(value) = self.values.get(places.len()) {
            if value.im == 0.0 {
                places.push(Place::Real);
            } else {
                places.extend([Place::First, Place::Second]);
            }
        }
        places
    }
}

/// Returns the eigenvalues, complex ones in successive conjugate pairs; `None` without convergence.
pub fn eigenvalues(matrix: &Mat<f64>) -> Option<Vec<c64>> {
    Some(block_values(&schur(matrix)?.1))
}

/// Returns the eigenvalues of a complex matrix; `None` without convergence.
pub fn complex_eigenvalues(matrix: &Mat<c64>) -> Option<Vec<c64>> {
    let values = schur(matrix)?.1.diagonal();
    Some(values.iter().copied().collect())
}

/// Returns the factors `Q` and `T` of `A = Q T Q^H`. The iteration repeats a cyclic matrix without
/// end, so a matrix that does not converge is reflected first.
fn schur<T: ComplexField<RealField = f64>>(matrix: &Mat<T>) -> Option<(Mat<T>, Mat<T>)> {
    let rows = matrix.nrows();
    if !matrix.iter().all(|x| x.clone().is_finite()) {
        return None;
    }
    let factors = |matrix: Mat<T>| {
        let schur = Schur::try_new(matrix, f64::EPSILON, SWEEPS_PER_ROW * rows.max(1))?;
        Some(schur.unpack())
    };
    factors(matrix.clone()).or_else(|| {
        let normal =
            DVector::from_fn(rows, |i, _| T::from_real(1.0 / (1.0 + i as f64))).normalize();
        let reflection = Mat::identity(rows, rows) - &normal * normal.adjoint() * T::from_real(2.0);
        let (q, t) = factors(&reflection * matrix * &reflection)?;
        Some((reflection * q, t))
    })
}

/// Rows of the diagonal block of a real Schur form that begins at row `k`: 1 or 2.
fn diagonal_block(t: &Mat<f64>, k: usize) -> usize {
    1 + usize::from(k + 1 < t.nrows() && t[(k + 1, k)] != 0.0)
}

/// The eigenvalues of all diagonal blocks of a real Schur form.
fn block_values(t: &Mat<f64>) -> Vec<c64> {
    let mut values = Vec::with_capacity(t.nrows());
    while values.len() < t.nrows() {
        let k = values.len();
        if diagonal_block(t, k) == 1 {
            values.push(c64::new(t[(k, k)], 0.0));
            continue;
        }
        let half_difference = 0.5 * (t[(k, k)] - t[(k + 1, k + 1)]);
        let product = t[(k, k + 1)] * t[(k + 1, k)];
        let mean = 0.5 * (t[(k, k)] + t[(k + 1, k + 1)]);
        // Roundoff can make it positive for a double eigenvalue.
        let discriminant = (half_difference * half_difference + product).min(0.0);
        let above = c64::new(mean, (-discriminant).sqrt());
        values.extend([above, above.conj()]);
    }
    values
}

/// Returns a pivot, or the least one where it is smaller.
fn at_least(least: f64, pivot: c64) -> c64 {
    if pivot.norm() < least {
        c64::new(least, 0.0)
    } else {
        pivot
    }
}

/// Solves `(T - lambda) y = 0` for the eigenvalue of the block at row `k`.
fn back_substituted(t: &Mat<f64>, k: usize, value: c64, norm: f64) -> Vec<c64> {
    let block = diagonal_block(t, k);
    let mut y = vec![c64::new(0.0, 0.0); k + block];
    y[k] = c64::new(1.0, 0.0);
    if block == 2 {
        // The row with the larger off-diagonal entry determines the ratio.
        y[k + 1] = if t[(k, k + 1)].abs() >= t[(k + 1, k)].abs() {
            (value - t[(k, k)]) / t[(k, k + 1)]
        } else {
            let ratio = (value - t[(k + 1, k + 1)]) / t[(k + 1, k)];
            1.0 / ratio
        };
    }
    // Equal eigenvalues differ by at least a roundoff, so that each has a vector.
    let smallest = f64::EPSILON * norm.max(f64::MIN_POSITIVE);
    let mut above = k;
    while above > 0 {
        let rows = 1 + usize::from(above > 1 && t[(above - 1, above - 2)] != 0.0);
        let first = above - rows;
        let right = |i: usize| -> c64 { -(above..y.len()).map(|j| y[j] * t[(i, j)]).sum::<c64>() };
        if rows == 1 {
            y[first] = right(first) / at_least(smallest, t[(first, first)] - value);
        } else {
            let (a, d) = (t[(first, first)] - value, t[(first + 1, first + 1)] - value);
            let (b, c) = (t[(first, first + 1)], t[(first + 1, first)]);
            let least = smallest * smallest.max(b.abs().max(c.abs()));
            let determinant = at_least(least, a * d - b * c);
            let (r, s) = (right(first), right(first + 1));
            y[first] = (r * d - s * b) / determinant;
            y[first + 1] = (a * s - r * c) / determinant;
        }
        above = first;
        rescale(&mut y);
    }
    y
}

/// Keeps the entries in the range of doubles.
fn rescale(y: &mut [c64]) {
    let largest = y.iter().map(|y| y.norm()).fold(0.0, f64::max);
    if largest > 1e100 {
        y.iter_mut().for_each(|y| *y /= largest);
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    /// Numbers between -0.5 and 0.5 (xorshift).
    fn numbers(seed: u64) -> impl FnMut() -> f64 {
        let mut state = seed;
        move || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state >> 11) as f64 / (1u64 << 53) as f64 - 0.5
        }
    }

    fn assert_eigen(matrix: &Mat<f64>, tolerance: f64) {
        let Eigen {
            values, vectors, ..
        } = eigen(matrix).unwrap();
        let residual = matrix.map(|x| c64::new(x, 0.0)) * &vectors
            - &vectors * Mat::from_diagonal(&values.clone().into());
        let error = residual.norm() / matrix.norm();
        assert!(error < tolerance, "{error:e} at {} rows", matrix.nrows());
        let trace: c64 = values.iter().sum();
        assert!((trace - matrix.trace()).norm() < 1e-13 * matrix.norm());
        for (k, value) in values.iter().enumerate() {
            assert!((vectors.column(k).norm() - 1.0).abs() < 1e-14);
            assert!(value.im == 0.0 || values.contains(&value.conj()));
        }
        assert_eq!(values, eigenvalues(matrix).unwrap());
    }

    /// A matrix in its own eigenvectors is diagonal, and another has the same trace as before.
    #[test]
    fn matrices_in_a_basis_of_eigenvectors() {
        let mut number = numbers(3);
        let [matrix, other] = [(); 2].map(|()| Mat::from_fn(9, 9, |_, _| number()));
        let eigen = eigen(&matrix).unwrap();
        assert!(eigen.values.iter().any(|value| value.im != 0.0));
        let diagonal = Mat::from_diagonal(&eigen.values.clone().into());
        assert!((eigen.transformed(&matrix) - diagonal).norm() < 1e-13);
        let transformed = eigen.transformed(&other);
        assert!((transformed.trace() - other.trace()).norm() < 1e-13);
        let back = &eigen.vectors * transformed;
        let forth = other.map(|x| c64::new(x, 0.0)) * &eigen.vectors;
        assert!((back - forth).norm() < 1e-13);
    }

    /// Measured: at most 4e-15.
    #[test]
    fn eigenvectors_of_random_matrices() {
        for rows in [1, 2, 3, 8, 21, 44] {
            for seed in 1..20 {
                let mut number = numbers(seed);
                assert_eigen(&Mat::from_fn(rows, rows, |_, _| number()), 3e-14);
            }
        }
    }

    /// Oscillators: blocks of two rows on the diagonal, with frequencies over four decades.
    #[test]
    fn eigenvectors_of_oscillators() {
        let n = 12;
        let matrix = Mat::from_fn(2 * n, 2 * n, |i, j| {
            let w = 10f64.powf(4.0 * (i % n) as f64 / n as f64);
            match (i < n, j < n) {
                (true, false) if i == j - n => 1.0,
                (false, true) if i - n == j => -w * w,
                (false, false) if i == j => -0.02 * w,
                _ => 0.0,
            }
        });
        assert_eigen(&matrix, 1e-14);
    }

    /// Matrices that the iteration repeats without end. Measured: at most 2e-14.
    #[test]
    fn eigenvectors_of_cyclic_matrices() {
        for rows in 2..9 {
            let cyclic = Mat::from_fn(rows, rows, |i, j| f64::from(u8::from((i + 1) % rows == j)));
            assert_eigen(&cyclic, 3e-14);
            let complex = cyclic.map(|x| c64::new(0.0, x));
            let values = complex_eigenvalues(&complex).unwrap();
            assert!(
                values
                    .iter()
                    .all(|value| (value.norm() - 1.0).abs() < 1e-13)
            );
        }
    }

    /// A repeated eigenvalue with one vector, and one with all of them.
    #[test]
    fn eigenvectors_of_defective_and_scalar_matrices() {
        let jordan = Mat::from_fn(3, 3, |i, j| f64::from(u8::from(i == j || i + 1 == j)));
        assert_eigen(&jordan, 1e-14);
        assert_eigen(&(Mat::identity(4, 4) * 3.0), 1e-15);
        assert!(eigen(&Mat::zeros(0, 0)).unwrap().values.is_empty());
    }
}
