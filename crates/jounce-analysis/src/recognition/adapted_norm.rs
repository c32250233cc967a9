//! Norm in which a stable linear map contracts.
//!
//! ```text
//! V = sum_k (M/g)'^k (M/g)^k,   |d|^2 = d' V d,   |M d| <= g |d|,   rho(M) < g < 1
//! ```
//!
//! `M` is a map with spectral radius `rho(M)`, and `g` the contraction rate in the norm. In the
//! Euclidean norm a stable map may first expand before it contracts; in this norm it contracts at
//! every step. The sum is computed by doubling: `V <- V + A' V A`, `A <- A A`.
//!
//! Source: J. P. LaSalle, *The Stability and Control of Discrete Processes* (Springer, 1986), ch. 1
//! (the equation of Stein and Lyapunov).
use jounce_linalg::Mat;

/// Doublings after which the sum has converged for every `g` that doubles can distinguish from the
/// spectral radius.
const MAX_DOUBLINGS: usize = 60;

/// Frobenius norm of a term, relative to the first, below which it changes the sum by roundoff
/// only.
const NEGLIGIBLE_TERM: f64 = 1e-17;

/// `|d| = |F d|_2` with `F' F = V`.
#[derive(Debug, Clone, PartialEq)]
pub struct AdaptedNorm {
    factor: Mat<f64>,
    inverse: Mat<f64>,
}

impl AdaptedNorm {
    /// Returns the norm in which `map` contracts by `rate`; `None` where the sum does not converge.
    pub fn of(map: &Mat<f64>, rate: f64) -> Option<Self> {
        let n = map.nrows();
        let mut sum = Mat::<f64>::identity(n, n);
        let mut power = map / rate;
        for _ in 0..MAX_DOUBLINGS {
            let term = power.transpose() * &sum * &power;
            sum += &term;
            if !sum.norm().is_finite() {
                return None;
            }
            if term.norm() < NEGLIGIBLE_TERM * sum.norm() {
                let factor = jounce_linalg::upper_cholesky(&sum)?;
                let inverse = jounce_linalg::inverse(&factor);
                return Some(Self { factor, inverse });
            }
            power = &power * &power;
        }
        None
    }

    /// Returns the Euclidean norm.
    pub fn euclidean(states: usize) -> Self {
        let identity = Mat::identity(states, states);
        Self {
            factor: identity.clone(),
            inverse: identity,
        }
    }

    /// Returns the length of a vector.
    pub fn length(&self, vector: &[f64]) -> f64 {
        let column = Mat::from_column_slice(vector.len(), 1, vector);
        (&self.factor * column).norm()
    }

    /// Returns the largest factor by which a map expands a vector; `None` where it is not finite.
    pub fn norm_of(&self, map: &Mat<f64>) -> Option<f64> {
        let transformed = &self.factor * map * &self.inverse;
        jounce_linalg::singular_values(&transformed)?
            .first()
            .copied()
            .filter(|largest| largest.is_finite())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A shear with multipliers 0.9 expands vectors a hundredfold in the Euclidean norm, and by
    /// less than 0.95 in the norm adapted to it.
    #[test]
    fn stable_map_contracts_at_the_requested_rate() {
        let map = Mat::from_fn(2, 2, |i, j| [[0.9, 100.0], [0.0, 0.9]][i][j]);
        let euclidean = AdaptedNorm::euclidean(2).norm_of(&map).unwrap_or(0.0);
        assert!((euclidean - 100.0).abs() < 0.1, "{euclidean}");
        let norm = AdaptedNorm::of(&map, 0.95).unwrap_or_else(|| AdaptedNorm::euclidean(2));
        let norm_of_map = norm.norm_of(&map).unwrap_or(1.0);
        assert!((0.9..0.95).contains(&norm_of_map), "{norm_of_map}");
        assert!(norm.length(&[1.0, 2.0]) >= 5.0_f64.sqrt(), "V >= I");
    }

    /// `V` of a scalar map is a geometric series; it diverges for a map with a larger spectral
    /// radius.
    #[test]
    fn the_sum_is_the_geometric_series() {
        let map = Mat::from_fn(1, 1, |_, _| 0.5);
        let length = AdaptedNorm::of(&map, 0.75).map_or(0.0, |norm| norm.length(&[1.0]));
        assert!(
            (length * length - 1.0 / (1.0 - (0.5_f64 / 0.75).powi(2))).abs() < 1e-12,
            "{length}"
        );
        assert!(AdaptedNorm::of(&map, 0.4).is_none());
    }
}
