//! The seven Gauss nodes of a contact step and the Legendre basis on it.
//!
//! On a step of length `h` the contact force is the polynomial of degree 6 through its values at the nodes `x_j h`. Gauss nodes
//! make the state at the end of the step accurate to twice the order of the polynomial, as long as the step resolves the
//! modes that carry the motion.

use super::lane::WIDTH;
use std::sync::LazyLock;

/// Number of nodes.
pub const NODES: usize = WIDTH - 1;

/// Nodes, weights and basis changes on `[0, 1]`.
#[derive(Debug)]
pub struct Collocation {
    /// Gauss-Legendre nodes.
    pub nodes: [f64; NODES],
    /// Their weights, sum 1.
    pub weights: [f64; NODES],
    /// `from_nodal[b][j]`: Legendre coefficient `b` of the polynomial that is 1 at node `j` and 0 at the others.
    pub from_nodal: [[f64; NODES]; NODES],
    /// Value at 0 of the same polynomials.
    pub at_start: [f64; NODES],
    /// Value at 1 of the same polynomials.
    pub at_end: [f64; NODES],
}

/// The one collocation of jounce.
pub static COLLOCATION: LazyLock<Collocation> = LazyLock::new(Collocation::new);

/// Shifted Legendre polynomials `P_0(x) .. P_{count-1}(x)` on `[0, 1]`.
pub fn legendre(x: f64, count: usize) -> Vec<f64> {
    let s = 2.0 * x - 1.0;
    let mut values = vec![1.0, s];
    for n in 1..count.saturating_sub(1) {
        let n_f = n as f64;
        values.push(((2.0 * n_f + 1.0) * s * values[n] - n_f * values[n - 1]) / (n_f + 1.0));
    }
    values.truncate(count);
    values
}

impl Collocation {
    fn new() -> Self {
        let mut nodes = [0.0; NODES];
        let mut weights = [0.0; NODES];
        for (j, node) in nodes.iter_mut().enumerate() {
            *node = gauss_node(j);
            let slope = legendre_slope(*node);
            weights[j] = 4.0 / (4.0 * *node * (1.0 - *node) * slope * slope);
        }
        let mut from_nodal = [[0.0; NODES]; NODES];
        for j in 0..NODES {
            for (b, value) in legendre(nodes[j], NODES).into_iter().enumerate() {
                from_nodal[b][j] = (2 * b + 1) as f64 * weights[j] * value;
            }
        }
        let value_at = |x: f64| {
            let basis = legendre(x, NODES);
            std::array::from_fn(|j| (0..NODES).map(|b| from_nodal[b][j] * basis[b]).sum())
        };
        Self { nodes, weights, at_start: value_at(0.0), at_end: value_at(1.0), from_nodal }
    }
}

/// Zero number `j` of the shifted Legendre polynomial of degree [`NODES`], by Newton from Chebyshev's estimate.
fn gauss_node(j: usize) -> f64 {
    let mut x = 0.5 * (1.0 - (std::f64::consts::PI * (j as f64 + 0.75) / (NODES as f64 + 0.5)).cos());
    for _ in 0..8 {
        x -= legendre(x, NODES + 1)[NODES] / legendre_slope(x);
    }
    x
}

/// Derivative with respect to `x` of the shifted Legendre polynomial of degree [`NODES`].
fn legendre_slope(x: f64) -> f64 {
    let (s, n) = (2.0 * x - 1.0, NODES as f64);
    let values = legendre(x, NODES + 1);
    2.0 * n * (s * values[NODES] - values[NODES - 1]) / (s * s - 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integrates_degree_thirteen_and_interpolates_degree_six() {
        let c = &*COLLOCATION;
        for degree in 0..=13 {
            let sum: f64 = (0..NODES).map(|j| c.weights[j] * c.nodes[j].powi(degree)).sum();
            assert!((sum - 1.0 / f64::from(degree + 1)).abs() < 4e-16, "degree {degree}: {sum}");
        }
        for degree in 0..=6 {
            let end: f64 = (0..NODES).map(|j| c.at_end[j] * c.nodes[j].powi(degree)).sum();
            let start: f64 = (0..NODES).map(|j| c.at_start[j] * c.nodes[j].powi(degree)).sum();
            assert!((end - 1.0).abs() < 1e-13 && (start - 0.0_f64.powi(degree)).abs() < 1e-13, "degree {degree}");
        }
    }
}
