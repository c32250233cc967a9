//! The displacement under a unit of force at another angle of the period, by a table.
//!
//! ```text
//! K(x) = sum_(|n| <= N) G_n e^(i n x) = sum_r K^(r)(x_j) (x - x_j)^r / r!
//! ```
//!
//! by Taylor's series about the nearest place of a grid. On four places per harmonic its last term leaves `(pi / 4)^8 / 8! = 4e-6` of
//! the highest harmonic, which is itself the smallest: enough for Newton, whose residual does not come from here.

use crate::orbit::compliance::Grid;
use faer::c64;
use std::f64::consts::TAU;

/// Terms of the series.
const TERMS: usize = 8;

/// `K` on a grid.
#[derive(Debug)]
pub struct Response {
    /// Coefficients of the series in shares of the width, at each place.
    places: Vec<[f64; TERMS]>,
    /// Places per radian.
    per_radian: f64,
}

impl Response {
    /// Of a compliance up to its last harmonic; the grid must have four places per harmonic.
    pub fn new(compliance: &[c64], grid: &Grid) -> Self {
        let width = TAU / grid.samples as f64;
        let mut spectrum = compliance.to_vec();
        spectrum.resize(grid.samples / 2 + 1, c64::new(0.0, 0.0));
        let mut places = vec![[0.0; TERMS]; grid.samples];
        for term in 0..TERMS {
            let values = grid.values(&spectrum);
            places.iter_mut().zip(values).for_each(|(place, value)| place[term] = value);
            let share = width / (term + 1) as f64;
            spectrum.iter_mut().enumerate().for_each(|(n, g)| *g *= c64::new(0.0, n as f64 * share));
        }
        Self { places, per_radian: 1.0 / width }
    }

    /// An angle counted in places, within the period.
    pub fn place(&self, angle: f64) -> f64 {
        (angle / TAU).rem_euclid(1.0) * self.places.len() as f64
    }

    /// `K` between two places, of the force and of the displacement.
    pub fn value(&self, force: f64, displacement: f64) -> f64 {
        let ([a, b, c, d, e, f, g, h], x) = self.near(displacement - force);
        // In pairs: a chain of eight would wait for every link.
        let square = x * x;
        (a + b * x + (c + d * x) * square) + (e + f * x + (g + h * x) * square) * (square * square)
    }

    /// `K` and `dK / dx`, per rad.
    pub fn value_and_slope(&self, force: f64, displacement: f64) -> (f64, f64) {
        let (series, x) = self.near(displacement - force);
        let sums = series.iter().rev().fold((0.0, 0.0), |(sum, slope), term| (sum * x + term, slope * x + sum));
        (sums.0, sums.1 * self.per_radian)
    }

    /// The series of the nearest place, and the way from there, in widths.
    fn near(&self, apart: f64) -> (&[f64; TERMS], f64) {
        let count = self.places.len();
        let apart = if apart < 0.0 { apart + count as f64 } else { apart };
        let nearest = (apart + 0.5) as usize;
        (&self.places[if nearest >= count { nearest - count } else { nearest }], apart - nearest as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `1 + 2 sum_n r^n cos n x = (1 - r^2) / (1 - 2 r cos x + r^2)` (Poisson), here up to `r^N = 5e-7`.
    #[test]
    fn a_geometric_compliance_gives_the_kernel_of_poisson() {
        let (r, harmonics) = (0.8_f64, 64);
        let compliance: Vec<c64> = (0..=harmonics).map(|n| c64::new(r.powi(n), 0.0)).collect();
        let response = Response::new(&compliance, &Grid::new(4 * 64));
        for (force, displacement) in [(0.3, 1.1), (5.9, 0.2), (0.2, 7.0), (2.0, 2.0)] {
            let (value, slope) = response.value_and_slope(response.place(force), response.place(displacement));
            let x: f64 = displacement - force;
            let below = 1.0 - 2.0 * r * x.cos() + r * r;
            let exact = [(1.0 - r * r) / below, -(1.0 - r * r) * 2.0 * r * x.sin() / (below * below)];
            assert!((value - exact[0]).abs() < 2e-5 && (slope - exact[1]).abs() < 1e-3, "{x}: {value} {slope}, {exact:?}");
            assert!((response.value(response.place(force), response.place(displacement)) - value).abs() < 1e-13);
        }
    }
}
