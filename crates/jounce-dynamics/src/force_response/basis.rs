//! Force on a contact step: seven nodal values and the functions that interpolate them.
//!
//! Steps are scaled to `x` in `[0, 1]`. There are two bases of seven functions, each 1 at its own
//! node and 0 at the other six:
//!
//! - *smooth*: polynomials of degree 6 through the Gauss-Legendre nodes;
//! - *onset*: `x^n` times polynomials of degree 6 in `x^q`, for the first step of a contact whose
//!   force starts like `t^n`. With `n = 3/2` the force is analytic in `sqrt(t)`, so `q = 1/2`; for
//!   other exponents `q = 1`. The nodes are the Gauss-Jacobi nodes of the measure `x^n dx` in the
//!   variable `x^q`.
//!
//! With Gauss nodes the state at the end of the step has about twice the order of accuracy of the
//! force inside it.

use jounce_simd::{F64x8, LANES};
use std::sync::LazyLock;

/// Number of nodes.
pub const NODES: usize = LANES - 1;

/// Number of Legendre coefficients for a basis function that is not a polynomial: in the
/// displacement the remainder falls off like this number to the power `-2 n - 3`.
const SINGULAR_TERMS: usize = 64;

/// Seven basis functions on `[0, 1]`.
#[derive(Debug, Clone)]
pub struct BasisFunctions {
    /// Nodes, then 1.
    pub positions: [f64; LANES],
    /// Integral of each function; the last lane is 0.
    pub weights: F64x8,
    /// Value of each function at 0; the last lane is 0.
    pub at_start: F64x8,
    /// Value of each function at 1; the last lane is 0.
    pub at_end: F64x8,
    /// Legendre coefficients, row by row: lane `j` is function `j`, the last lane is 0.
    pub series: Vec<F64x8>,
    /// `n` and `q`; not used for the smooth basis.
    powers: Option<[f64; 2]>,
    /// Barycentric weights of the polynomial part.
    barycentric: [f64; NODES],
}

/// Basis of polynomials of degree 6.
pub static SMOOTH_BASIS: LazyLock<BasisFunctions> = LazyLock::new(|| BasisFunctions::new(None));

/// Returns the shifted Legendre polynomials `P_0(x) .. P_{count-1}(x)` on `[0, 1]`.
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

impl BasisFunctions {
    /// Returns the basis for the first step of a contact whose force starts like `t^exponent`;
    /// `None` where that is smooth.
    pub fn onset(exponent: f64) -> Option<Self> {
        if exponent.fract() == 0.0 {
            return None;
        }
        let step = if (2.0 * exponent).fract() == 0.0 {
            0.5
        } else {
            1.0
        };
        Some(Self::new(Some([exponent, step])))
    }

    fn new(powers: Option<[f64; 2]>) -> Self {
        let [n, q] = powers.unwrap_or([0.0, 1.0]);
        // x^n dx = u^alpha du / q with u = x^q
        let nodes = gauss_jacobi((n + 1.0) / q - 1.0);
        let barycentric: [f64; NODES] = std::array::from_fn(|i| {
            (0..NODES)
                .filter(|j| *j != i)
                .map(|j| 1.0 / (nodes[i] - nodes[j]))
                .product()
        });
        let mut basis = Self {
            positions: std::array::from_fn(|i| {
                if i < NODES {
                    nodes[i].powf(1.0 / q)
                } else {
                    1.0
                }
            }),
            weights: F64x8::ZERO,
            at_start: F64x8::ZERO,
            at_end: F64x8::ZERO,
            series: Vec::new(),
            powers,
            barycentric,
        };
        basis.series = if powers.is_some() {
            singular_series(&nodes, n, q)
        } else {
            smooth_series(&nodes)
        };
        basis.weights = basis.series[0];
        basis.at_start = padded(basis.at(0.0));
        basis.at_end = padded(basis.at(1.0));
        basis
    }

    /// True where the nodes and functions are symmetric about the middle.
    pub fn is_mirrored(&self) -> bool {
        self.powers.is_none()
    }

    /// Returns the values of the seven functions at a point.
    pub fn at(&self, x: f64) -> [f64; NODES] {
        let [n, q] = self.powers.unwrap_or([0.0, 1.0]);
        if let Some(node) = self.positions[..NODES]
            .iter()
            .position(|position| *position == x)
        {
            return std::array::from_fn(|j| if j == node { 1.0 } else { 0.0 });
        }
        let (u, node) = (x.powf(q), |j: usize| self.positions[j].powf(q));
        let product: f64 = (0..NODES).map(|j| u - node(j)).product();
        std::array::from_fn(|j| {
            product * self.barycentric[j] / (u - node(j)) * (x / self.positions[j]).powf(n)
        })
    }
}

/// Pads the values with 0 in the last lane.
fn padded(values: [f64; NODES]) -> F64x8 {
    F64x8(std::array::from_fn(|j| {
        values.get(j).copied().unwrap_or(0.0)
    }))
}

/// Returns the Legendre coefficients by the quadrature of the nodes, which is exact to degree 13.
fn smooth_series(nodes: &[f64; NODES]) -> Vec<F64x8> {
    let weighted = nodes.map(|x| {
        let (s, n) = (2.0 * x - 1.0, NODES as f64);
        let values = legendre(x, NODES + 1);
        let slope = 2.0 * n * (s * values[NODES] - values[NODES - 1]) / (s * s - 1.0);
        let weight = 1.0 / (x * (1.0 - x) * slope * slope);
        values
            .iter()
            .map(|value| weight * value)
            .collect::<Vec<_>>()
    });
    (0..NODES)
        .map(|a| {
            F64x8(std::array::from_fn(|j| {
                weighted
                    .get(j)
                    .map_or(0.0, |row| (2 * a + 1) as f64 * row[a])
            }))
        })
        .collect()
}

/// Returns the Legendre coefficients, computed from the coefficients of the powers of `x`.
fn singular_series(nodes: &[f64; NODES], n: f64, q: f64) -> Vec<F64x8> {
    let powers: Vec<Vec<f64>> = (0..NODES)
        .map(|m| power_series(n + q * m as f64, SINGULAR_TERMS))
        .collect();
    let functions: [[f64; NODES]; NODES] =
        std::array::from_fn(|j| monomial_coefficients(nodes, j).map(|c| c * nodes[j].powf(-n / q)));
    let at = |a: usize, function: &[f64; NODES]| {
        function
            .iter()
            .zip(&powers)
            .map(|(c, power)| c * power[a])
            .sum()
    };
    (0..SINGULAR_TERMS)
        .map(|a| {
            F64x8(std::array::from_fn(|j| {
                functions.get(j).map_or(0.0, |function| at(a, function))
            }))
        })
        .collect()
}

/// Returns the Legendre coefficients of `x^p`: `(2 a + 1) int x^p P_a`, with
/// `int x^p P_a = int x^p P_{a-1} (p - a + 1) / (p + a + 1)`.
fn power_series(p: f64, terms: usize) -> Vec<f64> {
    let mut moment = 1.0 / (p + 1.0);
    let mut series = Vec::with_capacity(terms);
    for a in 0..terms {
        if a > 0 {
            moment *= (p - a as f64 + 1.0) / (p + a as f64 + 1.0);
        }
        series.push((2 * a + 1) as f64 * moment);
    }
    series
}

/// Returns the coefficients of the polynomial that is 1 at node `j` and 0 at the others.
fn monomial_coefficients(nodes: &[f64; NODES], j: usize) -> [f64; NODES] {
    let mut product = [0.0; NODES];
    product[0] = 1.0;
    for (_, node) in nodes.iter().enumerate().filter(|(i, _)| *i != j) {
        let scale = 1.0 / (nodes[j] - node);
        for m in (0..NODES).rev() {
            let below = if m > 0 { product[m - 1] } else { 0.0 };
            product[m] = scale * (below - node * product[m]);
        }
    }
    product
}

/// Returns the zeros of the polynomial of degree [`NODES`] orthogonal on `[0, 1]` with weight
/// `u^alpha`, by Newton with deflation.
fn gauss_jacobi(alpha: f64) -> [f64; NODES] {
    let mut zeros = [0.0; NODES];
    for j in 0..NODES {
        // Deflated by the previous zeros, Newton from the left finds the next one.
        let mut x = if j == 0 { 0.0 } else { zeros[j - 1] + 1e-3 };
        for _ in 0..200 {
            let [value, slope] = jacobi(alpha, x);
            let deflation: f64 = zeros[..j].iter().map(|z| 1.0 / (x - z)).sum();
            let step = value / (slope - value * deflation);
            x -= step;
            if step.abs() <= f64::EPSILON * x.abs() {
                break;
            }
        }
        zeros[j] = x;
    }
    zeros
}

/// Returns value and slope in `u` of the Jacobi polynomial `P^(0, alpha)` of degree [`NODES`]
/// shifted to `[0, 1]`.
fn jacobi(alpha: f64, u: f64) -> [f64; 2] {
    let s = 2.0 * u - 1.0;
    // Monic recurrence in s with (a, b) = (0, alpha) of the weight (1 - s)^a (1 + s)^b.
    let (mut p0, mut d0) = (1.0, 0.0);
    let (mut p1, mut d1) = (s - alpha / (alpha + 2.0), 1.0);
    for n in 1..NODES {
        let n = n as f64;
        let t = 2.0 * n + alpha;
        let shift = alpha * alpha / (t * (t + 2.0));
        let weight = 4.0 * n * n * (n + alpha) * (n + alpha) / (t * t * (t + 1.0) * (t - 1.0));
        let (p2, d2) = (
            (s - shift) * p1 - weight * p0,
            p1 + (s - shift) * d1 - weight * d0,
        );
        (p0, d0, p1, d1) = (p1, d1, p2, d2);
    }
    [p1, 2.0 * d1]
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;

    fn quadrature(basis: &BasisFunctions, f: impl Fn(f64) -> f64) -> f64 {
        (0..NODES)
            .map(|j| basis.weights.0[j] * f(basis.positions[j]))
            .sum()
    }

    #[test]
    fn smooth_integrates_degree_thirteen_and_interpolates_degree_six() {
        let b = &*SMOOTH_BASIS;
        for degree in 0..=13 {
            let sum = quadrature(b, |x| x.powi(degree));
            assert!(
                (sum - 1.0 / f64::from(degree + 1)).abs() < 4e-15,
                "degree {degree}: {sum}"
            );
        }
        for degree in 0..=6 {
            let at = |values: &[f64]| -> f64 {
                (0..NODES)
                    .map(|j| values[j] * b.positions[j].powi(degree))
                    .sum()
            };
            let (start, middle, end) = (at(&b.at_start.0), at(&b.at(0.3)), at(&b.at_end.0));
            assert!(
                (start - 0.0_f64.powi(degree)).abs() < 1e-12 && (end - 1.0).abs() < 1e-12,
                "degree {degree}"
            );
            assert!(
                (middle - 0.3_f64.powi(degree)).abs() < 1e-13,
                "degree {degree}"
            );
        }
    }

    #[test]
    fn onset_integrates_and_interpolates_its_powers() {
        for (exponent, step) in [(1.5, 0.5), (1.3, 1.0), (2.5, 0.5)] {
            let b = BasisFunctions::onset(exponent).unwrap();
            for m in 0..=13 {
                let power = exponent + step * f64::from(m);
                let sum = quadrature(&b, |x| x.powf(power));
                assert!(
                    (sum * (power + 1.0) - 1.0).abs() < 2e-11,
                    "power {power}: {sum}"
                );
            }
            for m in 0..=6 {
                let power = exponent + step * f64::from(m);
                let at: f64 = b
                    .at(0.3)
                    .iter()
                    .zip(&b.positions)
                    .map(|(b, x)| b * x.powf(power))
                    .sum();
                assert!((at - 0.3_f64.powf(power)).abs() < 1e-12, "power {power}");
            }
        }
        assert!(BasisFunctions::onset(1.0).is_none());
    }

    /// Beyond the stored terms, `x^1.5` has coefficients like `a^-4`; polynomials have no further
    /// terms. The largest error observed is 2.3e-5.
    #[test]
    fn series_sum_to_the_functions() {
        for (basis, allowed) in [
            (SMOOTH_BASIS.clone(), 1e-12),
            (BasisFunctions::onset(1.5).unwrap(), 3e-5),
        ] {
            for x in [0.11, 0.5, 0.97] {
                let powers = legendre(x, basis.series.len());
                for (j, value) in basis.at(x).into_iter().enumerate() {
                    let sum: f64 = basis
                        .series
                        .iter()
                        .zip(&powers)
                        .map(|(lane, p)| lane.0[j] * p)
                        .sum();
                    assert!(
                        (sum - value).abs() < allowed,
                        "function {j} at {x}: {sum} for {value}"
                    );
                }
            }
        }
    }
}
