//! Null direction of a nearly singular matrix.

use jounce_linalg::{LuFactors, Mat, norm};

/// Steps of inverse iteration.
const INVERSE_ITERATIONS: usize = 3;

/// Returns a unit vector near the null space, by inverse iteration.
pub fn null_vector(matrix: &Mat<f64>) -> Vec<f64> {
    let n = matrix.nrows();
    // Shift off the singular matrix, of the size of roundoff.
    let size = (0..n).map(|i| matrix[(i, i)].abs()).fold(1.0, f64::max);
    let factors = LuFactors::of(&Mat::from_fn(n, n, |i, j| {
        matrix[(i, j)] + if i == j { 1e-12 * size } else { 0.0 }
    }));
    let mut vector: Vec<f64> = (0..n).map(|i| 1.0 + 0.1 * i as f64).collect();
    for _ in 0..INVERSE_ITERATIONS {
        factors.solve(&mut vector);
        let length = norm(&vector);
        vector.iter_mut().for_each(|entry| *entry /= length);
    }
    vector
}
