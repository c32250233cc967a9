//! Tabulated displacement under a unit of force at another angle of the period.
//!
//! ```text
//! K(x) = sum_(|n| <= N) G_n e^(i n x) = sum_r K^(r)(x_j) (x - x_j)^r / r!
//! ```
//!
//! Taylor's series about the nearest grid point interpolates the table. On four points per harmonic
//! its last term leaves `(pi / 4)^6 / 6! = 3e-4` of the highest harmonic, which is the smallest.
//! That is enough for Newton, because the residual is computed separately.

use super::fourier_grid::FourierGrid;
use jounce_linalg::c64;
use jounce_simd::{Simd, Task, widest};
use std::array;
use std::f64::consts::TAU;

/// Terms of the series.
const SERIES_TERMS: usize = 6;

/// `K` on a grid.
#[derive(Debug)]
pub struct ComplianceTable {
    /// Coefficients of the series in powers of the distance by the grid width, at each point; the
    /// first point is repeated at the end.
    points: Vec<[f64; SERIES_TERMS]>,
    /// Grid points per radian.
    per_radian: f64,
}

impl ComplianceTable {
    /// Tabulates a compliance up to its last harmonic; the grid must have four points per harmonic.
    pub fn new(compliance: &[c64], grid: &FourierGrid) -> Self {
        let width = TAU / grid.samples as f64;
        let mut spectrum = compliance.to_vec();
        spectrum.resize(grid.samples / 2 + 1, c64::new(0.0, 0.0));
        let series: [Vec<f64>; SERIES_TERMS] = array::from_fn(|term| {
            let values = grid.values(&spectrum);
            let share = width / (term + 1) as f64;
            spectrum
                .iter_mut()
                .enumerate()
                .for_each(|(n, g)| *g *= c64::new(0.0, n as f64 * share));
            values
        });
        let terms = series.each_ref().map(|values| &values[..grid.samples]);
        let mut points = Vec::with_capacity(grid.samples + 1);
        points.extend((0..grid.samples).map(|j| terms.map(|values| values[j])));
        points.push(points[0]);
        Self {
            points,
            per_radian: 1.0 / width,
        }
    }

    /// Converts an angle to grid points within the period.
    pub fn point_index(&self, angle: f64) -> f64 {
        (angle / TAU).rem_euclid(1.0) * self.count()
    }

    /// Computes the force of a stop at its nodes under a unit of force at an angle, times a factor.
    pub fn column(&self, force: f64, factor: f64, nodes: &NodePlaces, column: &mut [f64]) {
        widest(ComplianceColumn {
            response: self,
            force,
            factor,
            nodes,
            column,
        });
    }

    fn count(&self) -> f64 {
        (self.points.len() - 1) as f64
    }

    /// Returns the series of the nearest grid point, and the distance from there in grid widths.
    #[inline(always)]
    fn near(&self, distance: f64) -> (&[f64; SERIES_TERMS], f64) {
        let distance = if distance < 0.0 {
            distance + self.count()
        } else {
            distance
        };
        let nearest = (distance + 0.5) as u32 as usize;
        (
            &self.points[nearest.min(self.points.len() - 1)],
            distance - nearest as f64,
        )
    }
}

/// Nodes of a stop in grid points of [`ComplianceTable`], with the slopes of its law.
#[derive(Debug)]
pub struct NodePlaces {
    /// Positions in grid points.
    pub at: Vec<f64>,
    /// `J`, N/m.
    pub stiffness_n_m: Vec<f64>,
    /// `J' w / p`, N/m, by a rate per rad; empty where the law does not depend on the rate.
    pub damping_n_m: Vec<f64>,
}

/// One column over the nodes.
struct ComplianceColumn<'a> {
    response: &'a ComplianceTable,
    force: f64,
    factor: f64,
    nodes: &'a NodePlaces,
    column: &'a mut [f64],
}

impl Task for ComplianceColumn<'_> {
    type Output = ();

    #[inline(always)]
    fn run<W: Simd>(self, w: W) {
        let Self {
            response,
            force,
            factor,
            nodes,
            column,
        } = self;
        for ((entry, point), stiffness_n_m) in
            column.iter_mut().zip(&nodes.at).zip(&nodes.stiffness_n_m)
        {
            let ([a, b, c, d, e, f], x) = response.near(point - force);
            // In pairs, which shortens the chain of dependent operations.
            let (first, second, third) = (
                w.fma_one(*b, x, *a),
                w.fma_one(*d, x, *c),
                w.fma_one(*f, x, *e),
            );
            let square = x * x;
            *entry = factor
                * stiffness_n_m
                * w.fma_one(third, square * square, w.fma_one(second, square, first));
        }
        for ((entry, point), damping_n_m) in
            column.iter_mut().zip(&nodes.at).zip(&nodes.damping_n_m)
        {
            let (series, x) = response.near(point - force);
            let mut slope = 0.0;
            for r in (1..SERIES_TERMS).rev() {
                slope = w.fma_one(slope, x, r as f64 * series[r]);
            }
            *entry += factor * damping_n_m * response.per_radian * slope;
        }
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
        let response = ComplianceTable::new(&compliance, &FourierGrid::new(4 * 64));
        for (force, displacement) in [(0.3, 1.1), (5.9, 0.2), (0.2, 7.0), (2.0, 2.0)] {
            let nodes = |stiffness: f64, damping: Vec<f64>| NodePlaces {
                at: vec![response.point_index(displacement)],
                stiffness_n_m: vec![stiffness],
                damping_n_m: damping,
            };
            let [value, slope] = [nodes(1.0, Vec::new()), nodes(0.0, vec![1.0])].map(|nodes| {
                let mut column = [f64::NAN];
                response.column(response.point_index(force), 1.0, &nodes, &mut column);
                column[0]
            });
            let x: f64 = displacement - force;
            let below = 1.0 - 2.0 * r * x.cos() + r * r;
            let exact = [
                (1.0 - r * r) / below,
                -(1.0 - r * r) * 2.0 * r * x.sin() / (below * below),
            ];
            assert!(
                (value - exact[0]).abs() < 2e-5 && (slope - exact[1]).abs() < 1e-3,
                "{x}: {value} {slope}, {exact:?}"
            );
        }
    }
}
