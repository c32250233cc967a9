//! Factors of matrices: triangular, orthogonal, and singular values.

use crate::{Mat, SWEEPS_PER_ROW, c64};
use nalgebra::{Cholesky, ComplexField, Dyn, SVD};

/// Ratio to its neighbours below which the iteration for singular values takes an off-diagonal entry
/// as zero. With a smaller one, some matrices do not converge because of roundoff.
const NEGLIGIBLE_RATIO: f64 = 5.0 * f64::EPSILON;

/// A matrix that is not finite: the result where a matrix is singular.
pub(crate) fn singular<T: ComplexField<RealField = f64>>(rows: usize, columns: usize) -> Mat<T> {
    Mat::from_element(rows, columns, T::from_real(f64::NAN))
}

/// `L` of `A = L L^T`, for a symmetric positive definite matrix.
#[derive(Debug)]
pub struct CholeskyFactor(Cholesky<f64, Dyn>);

impl CholeskyFactor {
    /// Factors a matrix, of which only the lower triangle is read; `None` where it is not positive
    /// definite.
    pub fn of(matrix: Mat<f64>) -> Option<Self> {
        Some(Self(matrix.cholesky()?))
    }

    /// Solves `A X = B`.
    pub fn solve(&self, right: &Mat<f64>) -> Mat<f64> {
        self.0.solve(right)
    }

    /// Solves `L X = B`.
    pub fn solve_lower(&self, right: &Mat<f64>) -> Mat<f64> {
        let mut solution = right.clone();
        self.0.l_dirty().solve_lower_triangular_mut(&mut solution);
        solution
    }
}

/// Returns the upper factor `R` of `A = R^T R` for a symmetric positive definite matrix; `None` for
/// any other.
pub fn upper_cholesky(matrix: &Mat<f64>) -> Option<Mat<f64>> {
    Some(matrix.clone().cholesky()?.l().transpose())
}

/// Returns the inverse of the lower factor `L` of `A = L L^T` for a symmetric positive definite
/// matrix; `None` for any other.
pub fn inverse_cholesky_factor(matrix: &Mat<f64>) -> Option<Mat<f64>> {
    let identity = Mat::identity(matrix.nrows(), matrix.nrows());
    Some(CholeskyFactor::of(matrix.clone())?.solve_lower(&identity))
}

/// Returns the inverse of the lower factor `L` of `A = L L^H` for a Hermitian positive definite
/// matrix; `None` for any other.
pub fn complex_inverse_cholesky_factor(matrix: &Mat<c64>) -> Option<Mat<c64>> {
    let mut inverse = Mat::identity(matrix.nrows(), matrix.nrows());
    let factor = matrix.clone().cholesky()?;
    // nalgebra accepts a negative pivot, whose root is imaginary.
    let is_definite = |pivot: &c64| pivot.re > 0.0 && pivot.im == 0.0;
    if !factor.l_dirty().diagonal().iter().all(is_definite) {
        return None;
    }
    factor.l_dirty().solve_lower_triangular_mut(&mut inverse);
    Some(inverse)
}

/// Returns the square orthogonal factor `Q` of `A = Q R`, for `A` with no more columns than rows.
pub fn orthogonal_factor(matrix: &Mat<f64>) -> Mat<f64> {
    let (rows, columns) = matrix.shape();
    // Columns of the identity complete the basis.
    let completed = Mat::from_fn(rows, columns + rows, |i, j| match j.checked_sub(columns) {
        None => matrix[(i, j)],
        Some(k) => f64::from(u8::from(i == k)),
    });
    completed.qr().q()
}

/// Returns the factors `Q`, with as many columns as `A`, and `R`, square, of `A = Q R`.
pub fn thin_qr(matrix: &Mat<f64>) -> (Mat<f64>, Mat<f64>) {
    matrix.clone().qr().unpack()
}

/// Returns the singular values, largest first; `None` without convergence.
pub fn singular_values(matrix: &Mat<f64>) -> Option<Vec<f64>> {
    let values = svd(matrix.clone(), false, false)?.singular_values;
    Some(values.iter().copied().collect())
}

/// Returns the singular values, largest first, and the columns of the right singular vectors, for a
/// matrix with no more columns than rows; `None` without convergence.
pub fn right_singular(matrix: Mat<f64>) -> Option<(Vec<f64>, Mat<f64>)> {
    let svd = svd(matrix, false, true)?;
    let values = svd.singular_values.iter().copied().collect();
    Some((values, svd.v_t?.transpose()))
}

/// Returns the columns of the right singular vectors of a complex matrix, that of the largest
/// singular value first; `None` without convergence.
pub fn complex_right_singular(matrix: Mat<c64>) -> Option<Mat<c64>> {
    Some(svd(matrix, false, true)?.v_t?.adjoint())
}

/// Singular values and vectors; `None` without convergence or for entries that are not finite.
pub(crate) fn svd<T: ComplexField<RealField = f64>>(
    matrix: Mat<T>,
    left: bool,
    right: bool,
) -> Option<SVD<T, Dyn, Dyn>> {
    let sweeps = SWEEPS_PER_ROW * matrix.nrows().max(matrix.ncols());
    let is_finite = matrix.iter().all(|x| x.clone().is_finite());
    is_finite.then(|| SVD::try_new(matrix, left, right, NEGLIGIBLE_RATIO, sweeps))?
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn indefinite_matrices_have_no_cholesky_factor() {
        let matrix = |diagonal: f64| Mat::from_fn(2, 2, |i, j| if i == j { diagonal } else { 2.0 });
        assert!(upper_cholesky(&matrix(1.0)).is_none() && upper_cholesky(&matrix(3.0)).is_some());
        let complex = |diagonal: f64| {
            complex_inverse_cholesky_factor(&matrix(diagonal).map(|x| c64::new(x, 0.0)))
        };
        assert!(complex(1.0).is_none() && complex(f64::NAN).is_none() && complex(3.0).is_some());
    }

    /// Columns of a rank-deficient matrix, too.
    #[test]
    fn orthogonal_factor_is_square_and_spans_the_columns() {
        for columns in [
            Mat::from_fn(5, 2, |i, j| (1 + i + 3 * j * j) as f64 % 4.0),
            Mat::from_fn(5, 2, |i, _| i as f64),
        ] {
            let q = orthogonal_factor(&columns);
            assert!((q.transpose() * &q - Mat::identity(5, 5)).norm() < 1e-14);
            let outside = q.columns(2, 3).transpose() * &columns;
            assert!(outside.norm() < 1e-14, "{outside}");
        }
    }

    /// The squares of the singular values are the eigenvalues of `A^T A`; matrices of sines, whole and
    /// with weak couplings.
    #[test]
    fn singular_values_of_many_matrices() {
        for rows in 1..46 {
            for coupling in [1.0, 1e-4, 1e-9, 1e-14, 0.0] {
                let matrix = Mat::from_fn(rows, rows, |i, j| {
                    let size = if i == j { 1.0 } else { coupling };
                    size * (1.0 + 1.7 * (i * i + 3 * j * j + i * j) as f64).sin()
                });
                let values = singular_values(&matrix).unwrap();
                let sum: f64 = values.iter().map(|value| value * value).sum();
                assert!((sum / matrix.norm_squared() - 1.0).abs() < 1e-13);
                let (squares, _) = crate::symmetric_eigen(&(matrix.transpose() * &matrix)).unwrap();
                for (value, square) in values.iter().rev().zip(&squares) {
                    assert!((value * value - square).abs() < 1e-13 * values[0] * values[0]);
                }
            }
        }
    }

    /// The singular values of a Vandermonde-like graded matrix are those of its transpose, and the
    /// right vectors diagonalise `A^T A`.
    #[test]
    fn singular_values_of_a_graded_matrix() {
        let matrix = Mat::from_fn(9, 6, |i, j| (1.0 + i as f64 / 9.0).powi(-3 * j as i32));
        let (values, vectors) = right_singular(matrix.clone()).unwrap();
        let image = &matrix * &vectors;
        for (k, value) in values.iter().enumerate() {
            assert!((image.column(k).norm() - value).abs() < 1e-14 * values[0]);
        }
        let transposed = singular_values(&matrix.transpose()).unwrap();
        assert!(
            values
                .iter()
                .zip(&transposed)
                .all(|(a, b)| (a - b).abs() < 1e-14 * values[0])
        );
        assert!(singular_values(&Mat::from_element(2, 2, f64::NAN)).is_none());
    }
}
