//! Response of one block to a polynomial force, exactly.
//!
//! On a step scaled to `x` in `[0, 1]`, `y' = z y + P_b(x)`, `y(0) = 0`, with `P_b` a shifted Legendre polynomial and
//! `z = h lambda`. In Legendre coefficients integration is tridiagonal,
//!
//! ```text
//! int_0^x P_n = (P_{n+1} - P_{n-1}) / (2 (2 n + 1)),   int_0^x P_0 = (P_1 + P_0) / 2,
//! ```
//!
//! so `y = z S y + S P_b` is one tridiagonal solve for any `z` with `Re z <= 0`, small or large, with no cancellation, where
//! the usual closed form (phi functions) loses digits. The coefficients fall off beyond `|z| / 2`.
//!
//! Validation: the tests below compare with the closed forms at large `z` and with power series at small `z`.

use super::collocation::NODES;
use faer::c64;

/// Legendre coefficients of the responses to `P_0 .. P_6`: `[b][a]`.
pub type Responses = [Vec<c64>; NODES];

/// A factored `I - z S`.
pub struct Duhamel {
    /// `1 / pivot` of each row.
    inverse: Vec<c64>,
    /// What a row takes from the row before it, and from the row after it.
    carry: Vec<[c64; 2]>,
}

/// Entry of `S` in row `n + 1`, column `n`.
fn below(n: usize) -> f64 {
    0.5 / (2 * n + 1) as f64
}

impl Duhamel {
    /// Factors for one `z`, with as many coefficients as it needs.
    pub fn new(z: c64) -> Self {
        let count = 24 + (0.75 * z.norm()).ceil() as usize;
        let mut pivot = Vec::with_capacity(count);
        pivot.push(1.0 - z * 0.5);
        for n in 1..count {
            // Row n: sub-diagonal -z S[n][n-1], super-diagonal of row n - 1: -z S[n-1][n] = z below(n).
            let product = -(z * below(n - 1)) * (z * below(n));
            let diagonal = c64::new(1.0, 0.0) - product / pivot[n - 1];
            pivot.push(diagonal);
        }
        let inverse: Vec<c64> = pivot.iter().map(|p| p.inv()).collect();
        let carry = (0..count)
            .map(|n| {
                let before = if n == 0 { c64::new(0.0, 0.0) } else { z * below(n - 1) * inverse[n - 1] };
                [before, z * below(n + 1)]
            })
            .collect();
        Self { inverse, carry }
    }

    /// Solves `y = z S y + S g` for Legendre coefficients `g`.
    pub fn respond(&self, force: &[c64]) -> Vec<c64> {
        let count = self.inverse.len();
        let mut y = vec![c64::new(0.0, 0.0); count];
        for (n, g) in force.iter().enumerate().take(count) {
            if n == 0 {
                y[0] += g * 0.5;
            } else {
                y[n - 1] -= g * below(n);
            }
            if n + 1 < count {
                y[n + 1] += g * below(n);
            }
        }
        for n in 1..count {
            let carried = self.carry[n][0] * y[n - 1];
            y[n] += carried;
        }
        y[count - 1] *= self.inverse[count - 1];
        for n in (0..count - 1).rev() {
            let carried = self.carry[n][1] * y[n + 1];
            y[n] = (y[n] - carried) * self.inverse[n];
        }
        y
    }

    /// Responses to the seven Legendre polynomials of a step.
    pub fn responses(&self) -> Responses {
        std::array::from_fn(|b| {
            let mut force = vec![c64::new(0.0, 0.0); b + 1];
            force[b] = c64::new(1.0, 0.0);
            self.respond(&force)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::march::collocation::legendre;

    /// `int_0^x e^{z (x - s)} P_b(s) ds` by 40-point composite Gauss quadrature.
    fn quadrature(z: c64, b: usize, x: f64) -> c64 {
        let c = &*crate::march::collocation::COLLOCATION;
        let panels = 60;
        let mut sum = c64::new(0.0, 0.0);
        for p in 0..panels {
            for j in 0..NODES {
                let s = x * (p as f64 + c.nodes[j]) / f64::from(panels);
                sum += (z * (x - s)).exp() * (legendre(s, b + 1)[b] * c.weights[j] * x / f64::from(panels));
            }
        }
        sum
    }

    #[test]
    fn agrees_with_quadrature_for_small_and_large_rates() {
        let mut worst: f64 = 0.0;
        for z in [
            c64::new(-1e-9, 1e-7),
            c64::new(-0.3, 1.0),
            c64::new(-0.01, 6.0),
            c64::new(-2.0, 40.0),
            c64::new(-30.0, 0.0),
            c64::new(0.0, 0.0),
        ] {
            let responses = Duhamel::new(z).responses();
            for (b, response) in responses.iter().enumerate() {
                for x in [0.02, 0.4, 1.0] {
                    let basis = legendre(x, response.len());
                    let value: c64 = response.iter().zip(&basis).map(|(y, p)| y * p).sum();
                    worst = worst.max((value - quadrature(z, b, x)).norm());
                }
            }
        }
        assert!(worst < 2e-15, "worst error {worst:e}");
    }
}
