//! Quadrature between the edges of a contact.
//!
//! ```text
//! int_a^b F(x) dx = (b - a) / 2 int_-1^1 F(m + (b - a) / 2 g(s)) g'(s) ds,   g = 5/4 (s - s^5 / 5),   m = (a + b) / 2
//! ```
//!
//! by Gauss-Legendre in `s`. At an edge `x - a ~ (s + 1)^2`. A force that starts like
//! `(x - a)^(3/2)`, like `x - a` or with a jump thus becomes smooth in `s`. In the middle `x`
//! advances evenly, as high harmonics need.
//!
//! Source: P. J. Davis and P. Rabinowitz, *Methods of Numerical Integration* (1984), sections 2.7 and 2.9.

use std::f64::consts::PI;
use std::sync::OnceLock;

/// The number of nodes is a multiple of this, so that it seldom changes along a curve.
const NODES_PER_LOT: usize = 8;

/// Largest number of such multiples.
const MAX_LOTS: usize = 512;

/// Rules of all lengths, each computed at its first use.
#[derive(Debug)]
pub struct QuadratureRules(Vec<OnceLock<QuadratureRule>>);

/// Points on `[-1, 1]` and weights with a sum of about two.
#[derive(Debug)]
pub struct QuadratureRule {
    /// `g`.
    pub positions: Vec<f64>,
    /// `g' ds`.
    pub weights: Vec<f64>,
}

impl Default for QuadratureRules {
    fn default() -> Self {
        Self((0..MAX_LOTS).map(|_| OnceLock::new()).collect())
    }
}

impl QuadratureRules {
    /// Returns the rule with at least `nodes` nodes.
    pub fn at_least(&self, nodes: f64) -> &QuadratureRule {
        let lot = ((nodes / NODES_PER_LOT as f64) as usize).min(MAX_LOTS - 1);
        self.0[lot].get_or_init(|| QuadratureRule::new((lot + 1) * NODES_PER_LOT))
    }
}

impl QuadratureRule {
    fn new(count: usize) -> Self {
        // The rule is even: half of it is enough.
        let half: Vec<(f64, f64)> = (0..count / 2).map(|i| gauss(count, i)).collect();
        let mirrored = half.iter().rev().map(|(x, weight)| (-x, *weight));
        let (mut positions, mut weights) = (Vec::with_capacity(count), Vec::with_capacity(count));
        for (x, weight) in half.iter().copied().chain(mirrored) {
            let fourth = x.powi(4);
            positions.push(0.25 * x * (5.0 - fourth));
            weights.push(1.25 * weight * (1.0 - fourth));
        }
        Self { positions, weights }
    }
}

/// Returns node and weight of Gauss-Legendre: Newton from Tricomi's guess, down to roundoff.
fn gauss(count: usize, i: usize) -> (f64, f64) {
    let n = count as f64;
    let mut x = -(PI * (i as f64 + 0.75) / (n + 0.5)).cos();
    let mut slope = 1.0;
    for _ in 0..8 {
        let (mut before, mut value) = (1.0, x);
        for k in 2..=count {
            let k = k as f64;
            (before, value) = (
                value,
                ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k,
            );
        }
        slope = n * (before - x * value) / (1.0 - x * x);
        let change = value / slope;
        x -= change;
        if change.abs() < 1e-15 {
            break;
        }
    }
    (x, 2.0 / ((1.0 - x * x) * slope * slope))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `int_-1^1 (1 - x^2)^n dx = sqrt(pi) Gamma(n + 1) / Gamma(n + 3/2)`.
    #[test]
    fn forces_of_every_law_are_integrated_to_rounding() {
        for nodes in [16.0, 40.0] {
            let rules = QuadratureRules::default();
            let rule = rules.at_least(nodes);
            for (n, exact) in [(0, 2.0), (1, PI / 2.0), (2, 4.0 / 3.0), (3, 3.0 * PI / 8.0)] {
                let value = |x: &f64| (1.0 - x * x).powf(0.5 * f64::from(n));
                let sum: f64 = rule
                    .positions
                    .iter()
                    .zip(&rule.weights)
                    .map(|(x, w)| w * value(x))
                    .sum();
                assert!(
                    (sum - exact).abs() < 2e-14,
                    "{nodes} nodes, power {n}: {:e}",
                    sum - exact
                );
            }
        }
    }
}
