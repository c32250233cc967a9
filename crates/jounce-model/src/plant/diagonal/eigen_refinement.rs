//! Refinement of eigenvectors to the roundoff of each entry, for a state far faster than all
//! others.
//!
//! An eigenvalue solver leaves an error of its roundoff times the fastest rate in every entry. With
//! `E = A V - V L` and `W = V^-1`,
//!
//! ```text
//! L <- L + diag(W E),   V <- V + V X,   X_ij = (W E)_ij / (L_j - L_i)
//! ```
//!
//! squares that error (Newton's method on `A v = l v` for all pairs at once). The matrix must be
//! graded: its fast rate in one diagonal entry, so its slow rates are accurate to their own
//! roundoff.
use jounce_linalg::{Mat, c64};

/// Two corrections: the first leaves the square of roundoff times the spread of the rates, which
/// may reach 1e-8.
const REFINEMENT_STEPS: usize = 2;

/// Largest `X_ij` that is applied as a correction. Above it the two eigenvalues are equal up to
/// roundoff, and the span of their vectors is correct without correction.
const MAX_CORRECTION: f64 = 1e-4;

/// Returns corrected eigenvalues and eigenvectors; real ones remain real.
pub(super) fn refined(
    matrix: &Mat<f64>,
    mut values: Vec<c64>,
    mut vectors: Mat<c64>,
) -> (Vec<c64>, Mat<c64>) {
    let n = values.len();
    let full = Mat::from_fn(n, n, |i, j| c64::new(matrix[(i, j)], 0.0));
    let is_real: Vec<bool> = values.iter().map(|value| value.im == 0.0).collect();
    let is_resolved = |j: usize, number: c64| {
        if is_real[j] {
            c64::new(number.re, 0.0)
        } else {
            number
        }
    };
    for _ in 0..REFINEMENT_STEPS {
        let applied = &full * &vectors;
        let residual = Mat::from_fn(n, n, |i, j| applied[(i, j)] - vectors[(i, j)] * values[j]);
        let within = jounce_linalg::complex_inverse(&vectors) * residual;
        let distance = |i: usize, j: usize| {
            let share = within[(i, j)] / (values[j] - values[i]);
            if i != j && share.norm() < MAX_CORRECTION {
                share
            } else {
                c64::new(0.0, 0.0)
            }
        };
        let correction = Mat::from_fn(n, n, distance);
        let update = &vectors * &correction;
        vectors = Mat::from_fn(n, n, |i, j| {
            is_resolved(j, vectors[(i, j)] + update[(i, j)])
        });
        values = (0..n)
            .map(|j| is_resolved(j, values[j] + within[(j, j)]))
            .collect();
    }
    (values, vectors)
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    /// A fast state coupled to a slow one, `(l + f)(l + s) = a b`, twice, with the slow ones
    /// rotated into each other. The slow root has an error of 1e-15 of itself, where the solver
    /// leaves 5e-8. The vectors still span the complete space.
    #[test]
    fn slow_rates_next_to_fast_ones_are_accurate() {
        let (fast, slow, a, b) = (1e9, 1.0, 3e3, -2e3);
        let (sin, cos) = 0.7_f64.sin_cos();
        let rows = [
            [-fast, 0.0, a * cos, a * sin],
            [0.0, -fast, -a * sin, a * cos],
            [b * cos, -b * sin, -slow, 0.0],
            [b * sin, b * cos, 0.0, -slow],
        ];
        let matrix = Mat::from_fn(4, 4, |i, j| rows[i][j]);
        let eigen = jounce_linalg::eigen(&matrix).unwrap();
        let (values, vectors) = refined(&matrix, eigen.values, eigen.vectors);
        let sum = fast + slow;
        let exact = -(fast * slow - a * b)
            / (0.5 * (sum + (sum * sum - 4.0 * (fast * slow - a * b)).sqrt()));
        let computed: Vec<f64> = values
            .iter()
            .map(|value| value.re)
            .filter(|rate| *rate > -1e3)
            .collect();
        assert_eq!(computed.len(), 2);
        computed
            .iter()
            .for_each(|rate| assert!((rate / exact - 1.0).abs() < 4e-15, "{rate:e} {exact:e}"));
        let sizes = vectors.singular_values();
        assert!(sizes[3] > 0.1 * sizes[0], "{sizes:?}");
    }
}
