//! Decompositions of dense matrices.
//!
//! The algorithms of `faer` are generic: each crate that calls one compiles it anew. This crate
//! calls them for doubles, so they are compiled once.
//!
//! ```
//! use faer::Mat;
//! use jounce_linalg::{eigenvalues, inverse};
//!
//! let rotation = Mat::from_fn(2, 2, |i, j| [[0.0, -1.0], [1.0, 0.0]][i][j]);
//! assert_eq!(inverse(&rotation), rotation.transpose());
//! let values = eigenvalues(&rotation).ok_or("no convergence")?;
//! assert!(values.iter().all(|value| (value.im.abs() - 1.0).abs() < 1e-15));
//! # Ok::<(), &str>(())
//! ```

use faer::linalg::solvers::{DenseSolveCore, Solve};
use faer::{Mat, MatRef, Side, c64};

/// Eigenvalues of a matrix and the columns of their eigenvectors.
#[derive(Debug, Clone)]
pub struct Eigen {
    /// Eigenvalues.
    pub values: Vec<c64>,
    /// Eigenvectors, one per column.
    pub vectors: Mat<c64>,
}

/// Returns eigenvalues and eigenvectors; `None` without convergence.
pub fn eigen(matrix: &Mat<f64>) -> Option<Eigen> {
    let eigen = matrix.eigen().ok()?;
    Some(Eigen {
        values: eigen.S().column_vector().iter().copied().collect(),
        vectors: eigen.U().to_owned(),
    })
}

/// Returns the eigenvalues; `None` without convergence.
pub fn eigenvalues(matrix: &Mat<f64>) -> Option<Vec<c64>> {
    matrix.eigenvalues().ok()
}

/// Returns the eigenvalues of a complex matrix; `None` without convergence.
pub fn complex_eigenvalues(matrix: &Mat<c64>) -> Option<Vec<c64>> {
    matrix.eigenvalues().ok()
}

/// Returns the eigenvalues of a symmetric matrix, ascending, and the columns of their orthonormal
/// eigenvectors; `None` without convergence. Only the lower triangle is read.
pub fn symmetric_eigen(matrix: &Mat<f64>) -> Option<(Vec<f64>, Mat<f64>)> {
    let eigen = matrix.self_adjoint_eigen(Side::Lower).ok()?;
    let values = eigen.S().column_vector().iter().copied().collect();
    Some((values, eigen.U().to_owned()))
}

/// Returns the inverse, by partial pivoting; not finite for a singular matrix.
pub fn inverse(matrix: &Mat<f64>) -> Mat<f64> {
    matrix.partial_piv_lu().inverse()
}

/// Returns the inverse of a complex matrix, by partial pivoting; not finite for a singular matrix.
pub fn complex_inverse(matrix: &Mat<c64>) -> Mat<c64> {
    matrix.partial_piv_lu().inverse()
}

/// Solves `A X = B` by partial pivoting.
pub fn solve(matrix: &Mat<f64>, right: &Mat<f64>) -> Mat<f64> {
    matrix.partial_piv_lu().solve(right)
}

/// Solves `A X = B` with complex entries by partial pivoting.
pub fn complex_solve(matrix: &Mat<c64>, right: &Mat<c64>) -> Mat<c64> {
    matrix.partial_piv_lu().solve(right)
}

/// Returns the inverse by full pivoting and the magnitudes of the pivots, largest first.
pub fn inverse_fully_pivoted(matrix: &Mat<f64>) -> (Mat<f64>, Vec<f64>) {
    let lu = matrix.full_piv_lu();
    let pivots = (0..matrix.nrows()).map(|i| lu.U()[(i, i)].abs()).collect();
    (lu.inverse(), pivots)
}

/// Returns the determinant, by partial pivoting.
pub fn determinant(matrix: &Mat<f64>) -> f64 {
    matrix.determinant()
}

/// Returns the singular values, largest first; `None` without convergence.
pub fn singular_values(matrix: MatRef<'_, f64>) -> Option<Vec<f64>> {
    matrix.singular_values().ok()
}

/// Returns the square orthogonal factor `Q` of `A = Q R`.
pub fn orthogonal_factor(matrix: &Mat<f64>) -> Mat<f64> {
    matrix.qr().compute_Q()
}

/// Returns the factors `Q`, with as many columns as `A`, and `R`, square, of `A = Q R`.
pub fn thin_qr(matrix: &Mat<f64>) -> (Mat<f64>, Mat<f64>) {
    let qr = matrix.qr();
    (qr.compute_thin_Q(), qr.thin_R().to_owned())
}

/// Solves `A X = B` by full pivoting.
pub fn solve_fully_pivoted(matrix: &Mat<f64>, right: &Mat<f64>) -> Mat<f64> {
    matrix.full_piv_lu().solve(right)
}

/// Returns the upper factor `R` of `A = R' R` for a symmetric positive definite matrix; `None` for
/// any other.
pub fn cholesky(matrix: &Mat<f64>) -> Option<Mat<f64>> {
    Some(matrix.llt(Side::Lower).ok()?.L().transpose().to_owned())
}

/// Returns the inverse of a symmetric positive definite matrix; `None` for any other.
pub fn positive_inverse(matrix: &Mat<f64>) -> Option<Mat<f64>> {
    Some(matrix.llt(Side::Lower).ok()?.inverse())
}

/// Returns the Moore-Penrose inverse; `None` without convergence.
pub fn pseudoinverse(matrix: &Mat<f64>) -> Option<Mat<f64>> {
    Some(matrix.svd().ok()?.pseudoinverse())
}
