//! Systems of equations, inverses, determinants.

use crate::factors::{singular, svd};
use crate::{Mat, c64};

/// Returns the inverse, by partial pivoting; not finite for a singular matrix.
pub fn inverse(matrix: &Mat<f64>) -> Mat<f64> {
    let inverse = matrix.clone().lu().try_inverse();
    inverse.unwrap_or_else(|| singular(matrix.nrows(), matrix.ncols()))
}

/// Returns the inverse of a complex matrix, by partial pivoting; not finite for a singular matrix.
pub fn complex_inverse(matrix: &Mat<c64>) -> Mat<c64> {
    let inverse = matrix.clone().lu().try_inverse();
    inverse.unwrap_or_else(|| singular(matrix.nrows(), matrix.ncols()))
}

/// Solves `A X = B` by partial pivoting; not finite for a singular matrix.
pub fn solve(matrix: &Mat<f64>, right: &Mat<f64>) -> Mat<f64> {
    let solution = matrix.clone().lu().solve(right);
    solution.unwrap_or_else(|| singular(right.nrows(), right.ncols()))
}

/// Solves `A X = B` with complex entries by partial pivoting; not finite for a singular matrix.
pub fn complex_solve(matrix: &Mat<c64>, right: &Mat<c64>) -> Mat<c64> {
    let solution = matrix.clone().lu().solve(right);
    solution.unwrap_or_else(|| singular(right.nrows(), right.ncols()))
}

/// Returns the inverse by full pivoting and the magnitudes of the pivots, largest first.
pub fn inverse_fully_pivoted(matrix: &Mat<f64>) -> (Mat<f64>, Vec<f64>) {
    let lu = matrix.clone().full_piv_lu();
    let pivots = lu.u().diagonal().iter().map(|u| u.abs()).collect();
    let inverse = lu.try_inverse();
    (
        inverse.unwrap_or_else(|| singular(matrix.nrows(), matrix.ncols())),
        pivots,
    )
}

/// Solves `A X = B` by full pivoting and one step of refinement; not finite for a singular matrix.
pub fn solve_fully_pivoted(matrix: &Mat<f64>, right: &Mat<f64>) -> Mat<f64> {
    let lu = matrix.clone().full_piv_lu();
    let solved = |right: &Mat<f64>| {
        let solution = lu.solve(right);
        solution.unwrap_or_else(|| singular(right.nrows(), right.ncols()))
    };
    let solution = solved(right);
    let correction = solved(&(right - matrix * &solution));
    solution + correction
}

/// Returns the determinant, by partial pivoting.
pub fn determinant(matrix: &Mat<f64>) -> f64 {
    matrix.clone().lu().determinant()
}

/// Returns the inverse of a symmetric positive definite matrix; `None` for any other.
pub fn positive_inverse(matrix: &Mat<f64>) -> Option<Mat<f64>> {
    Some(matrix.clone().cholesky()?.inverse())
}

/// Returns the Moore-Penrose inverse; `None` without convergence.
pub fn pseudoinverse(matrix: &Mat<f64>) -> Option<Mat<f64>> {
    let svd = svd(matrix.clone(), true, true)?;
    let largest = svd.singular_values.iter().copied().fold(0.0, f64::max);
    let rows = matrix.nrows().max(matrix.ncols()) as f64;
    svd.pseudo_inverse(f64::EPSILON * rows * largest).ok()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    #[test]
    fn singular_matrices_have_no_finite_inverse() {
        let matrix = Mat::from_fn(3, 3, |i, _| i as f64);
        assert!(inverse(&matrix).iter().all(|x| !x.is_finite()));
        assert!(
            solve(&matrix, &Mat::identity(3, 3))
                .iter()
                .all(|x| !x.is_finite())
        );
        assert_eq!(determinant(&matrix), 0.0);
    }

    /// Of `a b^T` the Moore-Penrose inverse is `b a^T / (|a|^2 |b|^2)`.
    #[test]
    fn pseudoinverse_of_rank_one() {
        let (a, b) = ([1.0, 2.0, -1.0], [0.5, 3.0]);
        let inverse = pseudoinverse(&Mat::from_fn(3, 2, |i, j| a[i] * b[j])).unwrap();
        let expected = Mat::from_fn(2, 3, |i, j| b[i] * a[j] / (6.0 * 9.25));
        assert!((inverse - expected).norm() < 1e-16);
    }
}
