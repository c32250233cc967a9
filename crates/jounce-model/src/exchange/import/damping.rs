//! A damping matrix in the coordinates of modes.

use super::reduced::between;
use jounce_linalg::Mat;
use jounce_sparse::SymmetricMatrix;
use std::f64::consts::TAU;

/// Damping between two modes, relative to the larger of their own, that the errors of the shapes
/// cause.
const SHAPE_ERROR: f64 = 1e-8;

/// `X^T D X`, without its roundoff.
pub(super) struct ModalDamping(Mat<f64>);

impl ModalDamping {
    pub(super) fn new(damping: &SymmetricMatrix, columns: &[Vec<f64>]) -> Self {
        Self(between(damping, columns))
    }

    /// Ratios `c_ii / (2 w_i)`; 0 for rigid-body modes.
    pub(super) fn ratios(&self, frequency_hz: &[f64]) -> Vec<f64> {
        let ratio = |(i, frequency_hz): (usize, &f64)| match *frequency_hz > 0.0 {
            true => self.0[(i, i)] / (2.0 * TAU * frequency_hz),
            false => 0.0,
        };
        frequency_hz.iter().enumerate().map(ratio).collect()
    }

    /// Rigid-body modes with damping: index and `c_ii`.
    pub(super) fn of_rigid(&self, frequency_hz: &[f64]) -> Vec<(usize, f64)> {
        let rigid = (0..frequency_hz.len()).filter(|mode| frequency_hz[*mode] == 0.0);
        rigid
            .map(|mode| (mode, self.0[(mode, mode)]))
            .filter(|(mode, damping)| damping.abs() > SHAPE_ERROR * self.largest(*mode))
            .collect()
    }

    /// Largest damping between a mode and any other, or its own.
    fn largest(&self, mode: usize) -> f64 {
        self.0.column(mode).amax()
    }

    /// Largest entry off the diagonal relative to the root of the product of both entries on it,
    /// or where one of these is 0, to the other.
    pub(super) fn coupling(&self) -> f64 {
        let mut largest: f64 = 0.0;
        for i in 0..self.0.nrows() {
            for j in 0..i {
                let own = [self.0[(i, i)].abs(), self.0[(j, j)].abs()];
                let larger = own[0].max(own[1]);
                let both = match own[0] * own[1] {
                    0.0 => larger,
                    product => product.sqrt(),
                };
                let between = self.0[(i, j)].abs();
                if between > SHAPE_ERROR * larger && both > 0.0 {
                    largest = largest.max(between / both);
                }
            }
        }
        largest
    }
}
