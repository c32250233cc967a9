//! An Euler-Bernoulli element of any degree, in strain coordinates.
//!
//! On an element of length `l` (half length `h = l/2`, `x` from -1 to 1) the curvature is a sum of
//! Legendre polynomials and the displacement its double integral:
//!
//! ```text
//! curvature(x)    = sum_j c_j P_j(x),                       j = 0 .. terms-1, 1/m
//! slope(x)        = slope_0 + h sum_j c_j I[P_j](x)
//! displacement(x) = displacement_0 + h (1 + x) slope_0 + h^2 sum_j c_j II[P_j](x)
//! s_j             = sqrt(EI l / (2j + 1)) c_j               so that the strain energy is sum_j s_j^2 / 2
//! ```
//!
//! `I` integrates from the start of the element: `I[P_0] = P_0 + P_1`, `I[P_j] = (P_(j+1) -
//! P_(j-1)) / (2j + 1)`. Only `c_0` and `c_1` move the far end: two terms give the cubic Hermite
//! element, every further term is a hierarchical internal function. Thus `terms` gives the space of
//! all piecewise polynomials of degree `terms + 1` with continuous slope. No numerical quadrature
//! is used: Legendre coefficients of the displacement give the kinetic energy as a sum of squares.
//!
//! Source: hierarchical beam functions as in Szabo & Babuska, Finite Element Analysis (1991), ch.
//! 3, written for the curvature.

use super::section::CrossSection;

/// A segment of a beam with one polynomial.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::structure) struct Element {
    pub start_m: f64,
    pub length_m: f64,
    pub section: CrossSection,
    /// Number of Legendre polynomials of the curvature, at least 2; the displacement is of degree
    /// `terms + 1`.
    pub terms: usize,
}

impl Element {
    fn half_m(&self) -> f64 {
        self.length_m / 2.0
    }

    /// `c_j / s_j`
    fn curvature_per_strain(&self, j: usize) -> f64 {
        (order_weight(j) / (self.section.bending_stiffness_n_m2 * self.length_m)).sqrt()
    }

    /// Change of slope from start to end per strain coordinate 0; no other coordinate changes the
    /// slope.
    pub fn end_slope(&self) -> f64 {
        self.length_m * self.curvature_per_strain(0)
    }

    /// Displacement of the end per strain coordinates 0 and 1 with the start held; no other
    /// coordinate moves the end.
    pub fn end_displacement(&self) -> [f64; 2] {
        let square_m2 = self.half_m() * self.half_m();
        [
            2.0 * square_m2 * self.curvature_per_strain(0),
            -2.0 / 3.0 * square_m2 * self.curvature_per_strain(1),
        ]
    }

    /// Returns the Legendre coefficients `(order, coefficient)` of the displacement per strain
    /// coordinate `j` with the start held.
    pub fn displacement_orders(&self, j: usize) -> [(usize, f64); 3] {
        let scale = self.half_m() * self.half_m() * self.curvature_per_strain(j);
        twice_integrated(j).map(|(order, weight)| (order, weight * scale))
    }

    /// Returns the displacement at `offset_m` from the start per strain coordinate with the start
    /// held.
    pub fn displacement(&self, offset_m: f64) -> Vec<f64> {
        let legendre = legendre(offset_m / self.half_m() - 1.0, self.terms + 2);
        let at = |j| {
            self.displacement_orders(j)
                .iter()
                .map(|(order, weight)| weight * legendre[*order])
                .sum()
        };
        (0..self.terms).map(at).collect()
    }

    /// Returns the slope at `offset_m` from the start per strain coordinate with the start held.
    pub fn slope(&self, offset_m: f64) -> Vec<f64> {
        let legendre = legendre(offset_m / self.half_m() - 1.0, self.terms + 1);
        let integral = |j: usize| {
            integral(j)
                .iter()
                .map(|(order, weight)| weight * legendre[*order])
                .sum::<f64>()
        };
        (0..self.terms)
            .map(|j| self.half_m() * self.curvature_per_strain(j) * integral(j))
            .collect()
    }

    /// Returns the curvature at `offset_m` from the start per strain coordinate, 1/m.
    pub fn curvature(&self, offset_m: f64) -> Vec<f64> {
        let legendre = legendre(offset_m / self.half_m() - 1.0, self.terms);
        (0..self.terms)
            .map(|j| self.curvature_per_strain(j) * legendre[j])
            .collect()
    }

    /// Returns the factor that converts Legendre coefficient `order` of a displacement to the root
    /// of twice its kinetic energy at 1 rad/s.
    pub fn mass_weight(&self, order: usize) -> f64 {
        (self.section.mass_per_length_kg_m * self.length_m / order_weight(order)).sqrt()
    }
}

/// `2j + 1`
fn order_weight(j: usize) -> f64 {
    (2 * j + 1) as f64
}

/// Returns `I[P_j]` as a sum of Legendre polynomials.
fn integral(j: usize) -> [(usize, f64); 2] {
    match j {
        0 => [(0, 1.0), (1, 1.0)],
        _ => [
            (j - 1, -1.0 / order_weight(j)),
            (j + 1, 1.0 / order_weight(j)),
        ],
    }
}

/// Returns `II[P_j]` as a sum of Legendre polynomials.
fn twice_integrated(j: usize) -> [(usize, f64); 3] {
    let n = 2.0 * j as f64;
    let (middle, above) = (
        -2.0 / ((n - 1.0) * (n + 3.0)),
        1.0 / ((n + 1.0) * (n + 3.0)),
    );
    match j {
        0 => [(0, middle), (1, 1.0), (2, above)],
        1 => [(0, -1.0 / 3.0), (1, middle), (3, above)],
        _ => [
            (j - 2, 1.0 / ((n + 1.0) * (n - 1.0))),
            (j, middle),
            (j + 2, above),
        ],
    }
}

/// Returns `P_0(x) .. P_(count-1)(x)` by the three-term recurrence.
fn legendre(x: f64, count: usize) -> Vec<f64> {
    let mut values = vec![1.0, x];
    for j in 1..count.saturating_sub(1) {
        let n = j as f64;
        values.push(((2.0 * n + 1.0) * x * values[j] - n * values[j - 1]) / (n + 1.0));
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    fn element(terms: usize) -> Element {
        let section = CrossSection {
            bending_stiffness_n_m2: 0.15,
            mass_per_length_kg_m: 0.08,
            neutral_axis_m: 0.0,
            coated_m: [0.0; 2],
        };
        Element {
            start_m: 0.0,
            length_m: 0.2,
            section,
            terms,
        }
    }

    /// Curvature from third-order differences would lose digits; composite Simpson checks the
    /// integrals instead.
    #[test]
    fn slope_and_displacement_integrate_the_curvature() {
        let element = element(9);
        let panels = 4000;
        let step_m = element.length_m / panels as f64;
        for j in 0..element.terms {
            let curvature = |offset_m: f64| {
                element.curvature_per_strain(j)
                    * legendre(offset_m / element.half_m() - 1.0, element.terms + 1)[j]
            };
            let (mut slope, mut displacement) = (0.0, 0.0);
            for panel in 0..panels {
                let start_m = panel as f64 * step_m;
                let mid = step_m / 6.0
                    * (curvature(start_m)
                        + 4.0 * curvature(start_m + step_m / 2.0)
                        + curvature(start_m + step_m));
                let half = step_m / 12.0
                    * (curvature(start_m)
                        + 4.0 * curvature(start_m + step_m / 4.0)
                        + curvature(start_m + step_m / 2.0));
                displacement += step_m / 6.0 * (slope + 4.0 * (slope + half) + slope + mid);
                slope += mid;
                if panel == 2600 {
                    assert!(
                        (slope - element.slope(start_m + step_m)[j]).abs() < 1e-11,
                        "{j}"
                    );
                    assert!(
                        (displacement - element.displacement(start_m + step_m)[j]).abs() < 1e-11,
                        "{j}"
                    );
                }
            }
            let end = element.end_displacement();
            assert!(
                (slope - if j == 0 { element.end_slope() } else { 0.0 }).abs() < 1e-11,
                "{j}"
            );
            assert!(
                (displacement - end.get(j).copied().unwrap_or(0.0)).abs() < 1e-11,
                "{j}"
            );
        }
    }
}
