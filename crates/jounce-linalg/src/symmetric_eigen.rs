//! Eigenvalues and eigenvectors of symmetric matrices.

use crate::{Mat, SWEEPS_PER_ROW};
use nalgebra::SymmetricEigen;

/// Returns the eigenvalues of a symmetric matrix, ascending, and the columns of their orthonormal
/// eigenvectors; `None` without convergence. Only the lower triangle is read.
///
/// Vectors of eigenvalues below roundoff of the largest one are accurate as a space, not each.
///
/// The rows are taken in the order of their diagonal, largest first: the iteration finds the last
/// eigenvalue first, and small ones accurately only in this order.
pub fn symmetric_eigen(matrix: &Mat<f64>) -> Option<(Vec<f64>, Mat<f64>)> {
    let n = matrix.nrows();
    if !matrix.iter().all(|x| x.is_finite()) {
        return None;
    }
    let rows = ascending(n, |i| -matrix[(i, i)].abs());
    let sorted = Mat::from_fn(n, n, |a, b| {
        let (i, j) = (rows[a], rows[b]);
        matrix[(i.max(j), i.min(j))]
    });
    let eigen = SymmetricEigen::try_new(sorted, f64::EPSILON, SWEEPS_PER_ROW * n)?;
    let columns = ascending(n, |k| eigen.eigenvalues[k]);
    let mut vectors = Mat::zeros(n, n);
    for (k, column) in columns.iter().enumerate() {
        for (a, i) in rows.iter().enumerate() {
            vectors[(*i, k)] = eigen.eigenvectors[(a, *column)];
        }
    }
    let values = columns.iter().map(|k| eigen.eigenvalues[*k]).collect();
    Some((values, vectors))
}

/// The first `n` indices in ascending order of a value.
fn ascending(n: usize, value: impl Fn(usize) -> f64) -> Vec<usize> {
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|a, b| value(*a).total_cmp(&value(*b)));
    order
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    /// Entries over twenty powers of ten: relative to each eigenvalue, not to the largest one.
    /// Eigenvalues of `D B D` with a well-conditioned `B` are as accurate as those of `B`; their
    /// product is the determinant.
    #[test]
    fn small_symmetric_eigenvalues_are_accurate() {
        let n = 11;
        for descending in [false, true] {
            let size = |i: usize| 10f64.powi(if descending { n - 1 - i } else { i } as i32);
            let matrix = Mat::from_fn(n, n, |i, j| {
                let shared = if i == j { 1.0 } else { 0.3 };
                shared * size(i) * size(j)
            });
            let (values, _) = symmetric_eigen(&matrix).unwrap();
            let logarithm: f64 = values.iter().map(|value| value.ln()).sum();
            // det (0.7 I + 0.3 ones) = 0.7^(n - 1) (0.7 + 0.3 n)
            let exact = 10.0 * 0.7_f64.ln()
                + (0.7 + 0.3 * n as f64).ln()
                + 2.0 * (0..n).map(|i| size(i).ln()).sum::<f64>();
            assert!((logarithm - exact).abs() < 1e-12, "{}", logarithm - exact);
        }
    }

    #[test]
    fn symmetric_values_ascend() {
        let half = Mat::from_fn(9, 9, |i, j| (1.0 + (i * i + 7 * j) as f64).sin());
        let matrix = &half + half.transpose();
        let (values, vectors) = symmetric_eigen(&matrix).unwrap();
        assert!(values.is_sorted());
        let rebuilt = &vectors * Mat::from_diagonal(&values.into()) * vectors.transpose();
        assert!((rebuilt - &matrix).norm() < 1e-14 * matrix.norm());
    }
}
