//! A square matrix with a border of one row and one column.

use faer::Mat;
use faer::linalg::solvers::Solve;

/// Solves `[A b; row corner] (x, p) = (right, last)`; `None` where that is singular.
///
/// The border may have units of its own: its row and its column are brought to size one first.
pub fn solve_bordered(
    matrix: &Mat<f64>,
    column: &[f64],
    (row, corner): (&[f64], f64),
    (right, last): (&[f64], f64),
) -> Option<(Vec<f64>, f64)> {
    let n = row.len();
    let row_size = row.iter().fold(corner.abs(), |max, r| max.max(r.abs()));
    let column_size = column.iter().fold(f64::MIN_POSITIVE, |max, r| max.max(r.abs()));
    let bordered = Mat::from_fn(n + 1, n + 1, |i, j| match (i < n, j < n) {
        (true, true) => matrix[(i, j)],
        (true, false) => column[i] / column_size,
        (false, true) => row[j] / row_size,
        (false, false) => corner / (row_size * column_size),
    });
    let right = Mat::from_fn(n + 1, 1, |i, _| if i < n { right[i] } else { last / row_size });
    let solution = bordered.partial_piv_lu().solve(&right);
    let unknown: Vec<f64> = (0..n).map(|i| solution[(i, 0)]).collect();
    let parameter = solution[(n, 0)] / column_size;
    (parameter.is_finite() && unknown.iter().all(|u| u.is_finite())).then_some((unknown, parameter))
}
