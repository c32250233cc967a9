//! Null direction of a nearly singular matrix.

use faer::Mat;
use faer::linalg::solvers::Solve;

/// Steps of inverse iteration.
const INVERSE_ITERATIONS: usize = 3;

/// Returns a unit vector near the null space, by inverse iteration.
pub fn null_vector(matrix: &Mat<f64>) -> Vec<f64> {
    let n = matrix.nrows();
    // Shift off the singular matrix, of the size of roundoff.
    let size = (0..n).map(|i| matrix[(i, i)].abs()).fold(1.0, f64::max);
    let solver = Mat::from_fn(n, n, |i, j| {
        matrix[(i, j)] + if i == j { 1e-12 * size } else { 0.0 }
    })
    .partial_piv_lu();
    let mut vector = Mat::from_fn(n, 1, |i, _| 1.0 + 0.1 * i as f64);
    for _ in 0..INVERSE_ITERATIONS {
        vector = solver.solve(&vector);
        let length = vector.norm_l2();
        vector = Mat::from_fn(n, 1, |i, _| vector[(i, 0)] / length);
    }
    (0..n).map(|i| vector[(i, 0)]).collect()
}
