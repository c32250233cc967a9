//! Eliminates linear unknowns from a least-squares problem, so that only the others are searched
//! for (variable projection).
//!
//! Source: G. Golub and V. Pereyra, SIAM J. Numer. Anal. 10 (1973) 413; L. Kaufman, BIT 15 (1975)
//! 49.

use faer::Mat;
use faer::linalg::solvers::Solve;

/// Linear problem at its minimum.
pub(super) struct LinearSolution {
    /// Linear unknowns.
    pub linear: Mat<f64>,
    /// Residual of the right side.
    pub rest: Mat<f64>,
    /// Orthonormal basis of the columns.
    thin: Mat<f64>,
}

impl LinearSolution {
    /// Solves for weighted columns `a` and a right side `b`. Columns are scaled to size 1: residual
    /// terms and residues differ by many powers of ten.
    pub fn new(mut a: Mat<f64>, b: &Mat<f64>) -> Self {
        let scale: Vec<f64> = a
            .col_iter()
            .map(|column| column.norm_l2().max(f64::MIN_POSITIVE))
            .collect();
        for (column, scale) in a.col_iter_mut().zip(&scale) {
            column.iter_mut().for_each(|x| *x /= scale);
        }
        let q = a.qr();
        let thin = q.compute_thin_Q();
        let solution = q.thin_R().partial_piv_lu().solve(thin.transpose() * b);
        let rest = b - &a * &solution;
        let linear = Mat::from_fn(scale.len(), 1, |c, _| solution[(c, 0)] / scale[c]);
        Self { linear, rest, thin }
    }

    /// Part of other columns orthogonal to the linear columns.
    pub fn beyond(&self, columns: &Mat<f64>) -> Mat<f64> {
        columns - &self.thin * (self.thin.transpose() * columns)
    }

    /// Returns the projected problem, from the derivatives by the other unknowns.
    pub fn left(self, derivative: &Mat<f64>) -> ProjectedProblem {
        let projected = self.beyond(derivative);
        let taken = (0..self.thin.nrows())
            .map(|row| self.thin.row(row).squared_norm_l2())
            .collect();
        ProjectedProblem {
            linear: self.linear,
            projected,
            rest: self.rest,
            taken,
        }
    }
}

/// Problem without its linear unknowns.
pub(super) struct ProjectedProblem {
    /// Linear unknowns at the minimum.
    pub linear: Mat<f64>,
    /// Derivatives by the other unknowns, projected: `P J`.
    pub projected: Mat<f64>,
    /// Residual of the right side.
    pub rest: Mat<f64>,
    /// Leverage of each row.
    pub taken: Vec<f64>,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A parabola fitted to points of `1 + 2 x + x^3`: residual and projection are orthogonal to
    /// all its columns.
    #[test]
    fn what_is_left_is_orthogonal_to_the_columns() {
        let x = |row: usize| 0.1 * row as f64;
        let columns = Mat::from_fn(21, 3, |row, c| {
            1e6_f64.powi(c as i32) * x(row).powi(c as i32)
        });
        let right = Mat::from_fn(21, 1, |row, _| 1.0 + 2.0 * x(row) + x(row).powi(3));
        let found = LinearSolution::new(columns.clone(), &right);
        let cubic = Mat::from_fn(21, 1, |row, _| x(row).powi(3));
        let beyond = found.beyond(&cubic);
        for c in 0..3 {
            let size = columns.col(c).norm_l2();
            assert!((columns.col(c).transpose() * found.rest.col(0)).abs() < 1e-12 * size);
            assert!((columns.col(c).transpose() * beyond.col(0)).abs() < 1e-12 * size);
        }
        assert!(
            (&found.rest - &beyond).norm_l2() < 1e-11,
            "a parabola takes up all but the cubic"
        );
    }
}
