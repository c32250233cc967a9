//! Eliminates linear unknowns from a least-squares problem, so that only the others are searched
//! for (variable projection).
//!
//! Source: G. Golub and V. Pereyra, SIAM J. Numer. Anal. 10 (1973) 413; L. Kaufman, BIT 15 (1975)
//! 49.

use jounce_linalg::Mat;

/// Linear problem at its minimum.
pub(super) struct LinearSolution {
    /// Linear unknowns.
    pub linear: Mat<f64>,
    /// Residual of the right side.
    pub residual: Mat<f64>,
    /// Orthonormal basis of the columns.
    thin_q: Mat<f64>,
}

impl LinearSolution {
    /// Solves for weighted columns `a` and a right side `b`. Columns are scaled to size 1: residual
    /// terms and residues differ by many powers of ten.
    pub fn new(mut a: Mat<f64>, b: &Mat<f64>) -> Self {
        let scale: Vec<f64> = a
            .column_iter()
            .map(|column| column.norm().max(f64::MIN_POSITIVE))
            .collect();
        for (mut column, scale) in a.column_iter_mut().zip(&scale) {
            column /= *scale;
        }
        let (thin_q, r) = jounce_linalg::thin_qr(&a);
        let solution = jounce_linalg::solve(&r, &(thin_q.transpose() * b));
        let residual = b - &a * &solution;
        let linear = Mat::from_fn(scale.len(), 1, |c, _| solution[(c, 0)] / scale[c]);
        Self {
            linear,
            residual,
            thin_q,
        }
    }

    /// Part of other columns orthogonal to the linear columns.
    pub fn orthogonal_part(&self, columns: &Mat<f64>) -> Mat<f64> {
        columns - &self.thin_q * (self.thin_q.transpose() * columns)
    }

    /// Returns the projected problem, from the derivatives by the other unknowns.
    pub fn project(self, derivative: &Mat<f64>) -> ProjectedProblem {
        let projected = self.orthogonal_part(derivative);
        let leverage = (0..self.thin_q.nrows())
            .map(|row| self.thin_q.row(row).norm_squared())
            .collect();
        ProjectedProblem {
            linear: self.linear,
            projected,
            residual: self.residual,
            leverage,
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
    pub residual: Mat<f64>,
    /// Leverage of each row.
    pub leverage: Vec<f64>,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A parabola fitted to points of `1 + 2 x + x^3`: residual and projection are orthogonal to
    /// all its columns.
    #[test]
    fn residual_is_orthogonal_to_the_columns() {
        let x = |row: usize| 0.1 * row as f64;
        let columns = Mat::from_fn(21, 3, |row, c| {
            1e6_f64.powi(c as i32) * x(row).powi(c as i32)
        });
        let rhs = Mat::from_fn(21, 1, |row, _| 1.0 + 2.0 * x(row) + x(row).powi(3));
        let result = LinearSolution::new(columns.clone(), &rhs);
        let cubic = Mat::from_fn(21, 1, |row, _| x(row).powi(3));
        let orthogonal_part = result.orthogonal_part(&cubic);
        for c in 0..3 {
            let column_norm = columns.column(c).norm();
            assert!(columns.column(c).dot(&result.residual.column(0)).abs() < 1e-12 * column_norm);
            assert!(columns.column(c).dot(&orthogonal_part.column(0)).abs() < 1e-12 * column_norm);
        }
        assert!(
            (&result.residual - &orthogonal_part).norm() < 1e-11,
            "a parabola takes up all but the cubic"
        );
    }
}
