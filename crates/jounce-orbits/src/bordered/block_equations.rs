//! `M - I` with a border, in block coordinates of even size.
//!
//! ```text
//! [D (M - I) D^-1   D T^-1 W^-1 b] (v)   (D T^-1 W^-1 r)
//! [row W T D^-1     corner       ] (p) = (last         ),   u = W T D^-1 v
//! ```
//!
//! `T` maps block coordinates to physical ones; `D` scales each by the square root of its energy.
//! No product of two matrices is needed, which would dominate the cost of a point of the curve.

use super::border::{Border, Bordered, BorderedSolution};
use jounce_linalg::Mat;
use jounce_model::plant::{Diagonal, product};

/// Derivative of the equations of an orbit by its state, factored with the first requested border.
#[derive(Debug)]
pub struct BlockEquations {
    first: Border,
    factored: Bordered,
    /// `D`.
    sizes: Vec<f64>,
}

/// Map between energy coordinates of a scale and block coordinates.
#[derive(Debug, Clone, Copy)]
pub struct EnergyCoordinates<'c> {
    /// `T` and its inverse.
    pub diagonal: &'c Diagonal,
    /// `W`.
    pub scale: &'c [f64],
}

impl BlockEquations {
    /// Factors a period map in block coordinates, with the border `[R_u b; row corner]` in energy
    /// coordinates.
    pub fn new(
        map: &Mat<f64>,
        by: &[f64],
        (row, corner): (&[f64], f64),
        coordinates: EnergyCoordinates,
    ) -> Self {
        let n = row.len();
        let sizes: Vec<f64> = (0..n).map(|j| coordinates.size(j)).collect();
        let mut matrix = map.clone();
        for j in 0..n {
            let column = jounce_linalg::column_mut(&mut matrix, j);
            column[j] -= 1.0;
            column
                .iter_mut()
                .zip(&sizes)
                .for_each(|(entry, size)| *entry *= size / sizes[j]);
        }
        let (block, column) = (
            coordinates.row(row, &sizes),
            coordinates.inwards(by, &sizes),
        );
        Self {
            first: Border::new((row, corner)),
            factored: Bordered::new(&matrix, &column, (&block, corner)),
            sizes,
        }
    }

    /// Solves `[R_u b; row corner] (du, dp) = (right, last)`.
    pub fn solve(
        &self,
        border: (&[f64], f64),
        right: (&[f64], f64),
        coordinates: EnergyCoordinates,
    ) -> BorderedSolution {
        self.first.other(border, right, |right, last| {
            let (unknown, parameter) = self
                .factored
                .solve(&coordinates.inwards(right, &self.sizes), last)?;
            Some((coordinates.outwards(&unknown, &self.sizes), parameter))
        })
    }
}

impl EnergyCoordinates<'_> {
    /// Returns the length, in energy coordinates, of a unit of block coordinate `j`.
    fn size(&self, j: usize) -> f64 {
        let column = jounce_linalg::column(&self.diagonal.to_physical, j);
        column
            .iter()
            .zip(self.scale)
            .map(|(x, w)| (x * w).powi(2))
            .sum::<f64>()
            .sqrt()
            .max(f64::MIN_POSITIVE)
    }

    /// Computes `D T^-1 W^-1 u`.
    fn inwards(&self, u: &[f64], sizes: &[f64]) -> Vec<f64> {
        let physical: Vec<f64> = u.iter().zip(self.scale).map(|(u, w)| u / w).collect();
        let block = product(&self.diagonal.from_physical, &physical);
        block.iter().zip(sizes).map(|(v, size)| v * size).collect()
    }

    /// Computes `W T D^-1 v`.
    fn outwards(&self, v: &[f64], sizes: &[f64]) -> Vec<f64> {
        let block: Vec<f64> = v.iter().zip(sizes).map(|(v, size)| v / size).collect();
        let physical = product(&self.diagonal.to_physical, &block);
        physical
            .iter()
            .zip(self.scale)
            .map(|(x, w)| x * w)
            .collect()
    }

    /// Computes `row W T D^-1`.
    fn row(&self, row: &[f64], sizes: &[f64]) -> Vec<f64> {
        let physical: Vec<f64> = row.iter().zip(self.scale).map(|(r, w)| r * w).collect();
        let along = |j: usize| {
            jounce_linalg::column(&self.diagonal.to_physical, j)
                .iter()
                .zip(&physical)
                .map(|(x, r)| x * r)
                .sum::<f64>()
        };
        sizes
            .iter()
            .enumerate()
            .map(|(j, size)| along(j) / size)
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bordered::border::solve_bordered;
    use jounce_model::plant::BlockDiagonal;

    /// Compares with the equations in energy coordinates, under the first border and under another
    /// one.
    #[test]
    fn block_coordinates_give_the_solution_in_energy_coordinates() {
        let rows = [[1.0, 2.0, 0.0], [0.0, 1.0, -1.0], [3.0, 0.0, 1.0]];
        let inverse = [[1.0, -2.0, -2.0], [-3.0, 1.0, 1.0], [-3.0, 6.0, 1.0]];
        let to_physical = Mat::from_fn(3, 3, |i, j| rows[i][j]);
        let from_physical = Mat::from_fn(3, 3, |i, j| inverse[i][j] / -5.0);
        let diagonal = Diagonal {
            block: BlockDiagonal::default(),
            to_physical,
            from_physical,
        };
        let scale = [4.0, 1.0, 0.1];
        let map = Mat::from_fn(3, 3, |i, j| {
            [[0.6, -0.7, 0.1], [0.7, 0.6, 0.0], [0.2, 0.0, 1e-3]][i][j]
        });
        let full = &diagonal.to_physical * &map * &diagonal.from_physical;
        let energy = Mat::from_fn(3, 3, |i, j| {
            full[(i, j)] * scale[i] / scale[j] - f64::from(u8::from(i == j))
        });
        let coordinates = EnergyCoordinates {
            diagonal: &diagonal,
            scale: &scale,
        };
        let (by, right) = ([0.3, -2.0, 1.0], [1.0, 0.5, -0.2]);
        let equations = BlockEquations::new(&map, &by, (&[1.0, 2.0, 3.0], 0.5), coordinates);
        for (row, corner) in [([1.0, 2.0, 3.0], 0.5), ([0.0, -1.0, 0.2], 2.0)] {
            let computed = equations
                .solve((&row, corner), (&right, 0.7), coordinates)
                .unwrap_or_default();
            let exact =
                solve_bordered(&energy, &by, (&row, corner), (&right, 0.7)).unwrap_or_default();
            let difference = computed
                .0
                .iter()
                .zip(&exact.0)
                .map(|(a, b)| (a - b).abs())
                .fold((computed.1 - exact.1).abs(), f64::max);
            let size = exact
                .0
                .iter()
                .fold(exact.1.abs(), |max, x| max.max(x.abs()));
            assert!(
                exact.0.len() == 3 && difference < 1e-12 * size,
                "{computed:?} {exact:?}"
            );
        }
    }
}
