//! Eigenvectors to the roundoff of each of their entries, where one state is far faster than all others.
//!
//! An eigenvalue solver leaves an error of its roundoff times the fastest rate in every entry. With `E = A V - V L` and `W = V^-1`,
//!
//! ```text
//! L <- L + diag(W E),   V <- V + V X,   X_ij = (W E)_ij / (L_j - L_i)
//! ```
//!
//! squares that error (Newton's method on `A v = l v` for all at once). The matrix must be graded: its fast rate in one entry of the
//! diagonal, so that its slow ones are in it to their own roundoff.

use faer::linalg::solvers::DenseSolveCore;
use faer::{Mat, c64};

/// Two corrections: the first leaves the square of roundoff times the spread of the rates, which may be 1e-8.
const CORRECTIONS: usize = 2;

/// Eigenvalues and eigenvectors, corrected; real ones stay real.
pub(super) fn refined(matrix: &Mat<f64>, mut values: Vec<c64>, mut vectors: Mat<c64>) -> (Vec<c64>, Mat<c64>) {
    let n = values.len();
    let full = Mat::from_fn(n, n, |i, j| c64::new(matrix[(i, j)], 0.0));
    let is_real: Vec<bool> = values.iter().map(|value| value.im == 0.0).collect();
    let kept = |j: usize, number: c64| if is_real[j] { c64::new(number.re, 0.0) } else { number };
    for _ in 0..CORRECTIONS {
        let applied = &full * &vectors;
        let left = Mat::from_fn(n, n, |i, j| applied[(i, j)] - vectors[(i, j)] * values[j]);
        let within = vectors.partial_piv_lu().inverse() * left;
        let apart = |i: usize, j: usize| if values[i] == values[j] { c64::new(0.0, 0.0) } else { within[(i, j)] / (values[j] - values[i]) };
        let correction = Mat::from_fn(n, n, apart);
        let moved = &vectors * &correction;
        vectors = Mat::from_fn(n, n, |i, j| kept(j, vectors[(i, j)] + moved[(i, j)]));
        values = (0..n).map(|j| kept(j, values[j] + within[(j, j)])).collect();
    }
    (values, vectors)
}
