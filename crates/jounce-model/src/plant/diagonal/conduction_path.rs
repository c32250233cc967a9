//! Separate coordinate for a conducting path, so a fast path causes no loss of accuracy in slow
//! states.
//!
//! Between the patches and their storage, in the roots of energies `u = sqrt(C) V`, a path of
//! conductance `g` contributes `-g d (d . u)` with `d = (1 / sqrt(C), -s / sqrt(C_s))`. In the
//! coordinates of the two nodes, the roundoff of `g / C_s` may exceed the rate by the load. Along
//! `d / |d|` the path is one diagonal entry, `-g |d|^2`, and across it zero.

use crate::plant::Electrical;
use jounce_linalg::Mat;

/// A rotation of the coordinates of two nodes, and the rate along the first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ConductionPath {
    /// State of the patches, which becomes the state along the path.
    first: usize,
    /// State of the storage, which becomes the state across the path; `None` for a battery.
    second: Option<usize>,
    cosine: f64,
    sine: f64,
    /// Rate along the path, 1/s.
    rate_per_s: f64,
}

impl ConductionPath {
    /// Returns the paths of all conducting diodes; `states` is the number of states before the
    /// nodes.
    pub fn of_all(electrical: &Electrical, states: usize) -> Vec<Self> {
        let of = |link: &crate::plant::circuit::electrical::Conductance| {
            let along = |node: usize, sign: f64| sign / electrical.nodes[node].capacitance_f.sqrt();
            let rows = [
                along(link.node, 1.0),
                link.to.map_or(0.0, |(other, sign)| along(other, -sign)),
            ];
            let length = rows[0].hypot(rows[1]);
            Self {
                first: states + link.node,
                second: link.to.map(|(other, _)| states + other),
                cosine: rows[0] / length,
                sine: rows[1] / length,
                rate_per_s: -link.conductance_per_ohm * length * length,
            }
        };
        electrical.links.iter().map(of).collect()
    }

    /// Returns a matrix without the path in the coordinates of the path, and with it.
    pub fn enter(&self, matrix: &mut Mat<f64>) {
        if let Some(second) = self.second {
            for j in 0..matrix.ncols() {
                (matrix[(self.first, j)], matrix[(second, j)]) =
                    self.rotated(matrix[(self.first, j)], matrix[(second, j)]);
            }
            self.enter_columns(matrix);
        }
        matrix[(self.first, self.first)] += self.rate_per_s;
    }

    /// Converts rows on roots of energies to rows on the coordinates of the path.
    fn enter_columns(&self, rows: &mut Mat<f64>) {
        let Some(second) = self.second else { return };
        for i in 0..rows.nrows() {
            (rows[(i, self.first)], rows[(i, second)]) =
                self.rotated(rows[(i, self.first)], rows[(i, second)]);
        }
    }

    /// Converts columns in the coordinates of the path to roots of energies.
    pub fn leave(&self, columns: &mut Mat<f64>) {
        let Some(second) = self.second else { return };
        for j in 0..columns.ncols() {
            (columns[(self.first, j)], columns[(second, j)]) =
                self.rotated_back(columns[(self.first, j)], columns[(second, j)]);
        }
    }

    /// Converts rows on the coordinates of the path to rows on roots of energies.
    pub fn leave_columns(&self, rows: &mut Mat<f64>) {
        let Some(second) = self.second else { return };
        for i in 0..rows.nrows() {
            (rows[(i, self.first)], rows[(i, second)]) =
                self.rotated_back(rows[(i, self.first)], rows[(i, second)]);
        }
    }

    fn rotated(&self, u: f64, v: f64) -> (f64, f64) {
        (
            self.cosine * u + self.sine * v,
            self.cosine * v - self.sine * u,
        )
    }

    fn rotated_back(&self, along: f64, across: f64) -> (f64, f64) {
        (
            self.cosine * along - self.sine * across,
            self.sine * along + self.cosine * across,
        )
    }
}
