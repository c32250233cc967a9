//! Square matrix, factored in place: separate triangles would take three times the memory at every
//! point of a curve.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::{factor, solve};
use faer::perm::PermRef;
use faer::{ColMut, Mat, Par};

/// `L U` of a matrix with its rows exchanged.
#[derive(Debug)]
pub struct LuFactors {
    both: Mat<f64>,
    rows: Vec<usize>,
    back: Vec<usize>,
}

impl LuFactors {
    /// Factors a square matrix.
    pub fn of(matrix: Mat<f64>) -> Self {
        let n = matrix.nrows();
        let (mut both, mut rows, mut back) = (matrix, vec![0; n], vec![0; n]);
        let mut room = MemBuffer::new(factor::lu_in_place_scratch::<usize, f64>(
            n,
            n,
            Par::Seq,
            Default::default(),
        ));
        factor::lu_in_place(
            both.as_mut(),
            &mut rows,
            &mut back,
            Par::Seq,
            MemStack::new(&mut room),
            Default::default(),
        );
        Self { both, rows, back }
    }

    /// Solves for a right side, in place; the solution is not finite where the matrix is singular.
    pub fn solve(&self, right: &mut [f64]) {
        let n = self.rows.len();
        let exchanged = PermRef::new_checked(&self.rows, &self.back, n);
        let mut room = MemBuffer::new(solve::solve_in_place_scratch::<usize, f64>(n, 1, Par::Seq));
        let right = ColMut::from_slice_mut(right).as_mat_mut();
        solve::solve_in_place(
            self.both.as_ref(),
            self.both.as_ref(),
            exchanged,
            right,
            Par::Seq,
            MemStack::new(&mut room),
        );
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_that_must_be_exchanged() {
        let rows = [[0.0, 2.0, 1.0], [1.0, 0.0, 3.0], [4.0, 1.0, 0.0]];
        let factors = LuFactors::of(Mat::from_fn(3, 3, |i, j| rows[i][j]));
        let exact = [1.0, -2.0, 0.5];
        let mut right = rows.map(|row| row.iter().zip(exact).map(|(a, x)| a * x).sum::<f64>());
        factors.solve(&mut right);
        assert!(
            right
                .iter()
                .zip(exact)
                .all(|(found, exact)| (found - exact).abs() < 1e-15),
            "{right:?}"
        );
    }
}
