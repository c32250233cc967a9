//! The small linear system of one contact step, for all columns at once.

use super::tangents::{add_scaled, scale};
use crate::march::basis::NODES;
use crate::wide::{Lane, Wide};

/// A row of lanes per node.
pub type NodeRows = [Vec<Lane>; NODES];

/// Solves in place by elimination with row exchange; the matrix is the identity less a small integration.
#[inline(always)]
pub fn eliminate<W: Wide>(w: W, matrix: &mut [[f64; NODES]; NODES], right: &mut NodeRows) {
    for k in 0..NODES {
        let pivot = (k..NODES).max_by(|i, j| matrix[*i][k].abs().total_cmp(&matrix[*j][k].abs())).unwrap_or(k);
        matrix.swap(k, pivot);
        right.swap(k, pivot);
        let inverse = 1.0 / matrix[k][k];
        let (row, own) = (matrix[k], std::mem::take(&mut right[k]));
        for i in 0..NODES {
            let factor = matrix[i][k] * inverse;
            if i != k && factor != 0.0 {
                (k..NODES).for_each(|j| matrix[i][j] -= factor * row[j]);
                add_scaled(w, &mut right[i], -factor, &own);
            }
        }
        right[k] = own;
    }
    for k in 0..NODES {
        scale(w, &mut right[k], 1.0 / matrix[k][k]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wide::Portable;

    #[test]
    fn solves_a_matrix_that_needs_its_rows_exchanged() {
        let entry = |i: usize, j: usize| if (i + j) % NODES == 1 { 3.0 } else { 0.1 * (i * j) as f64 / 40.0 };
        let mut matrix: [[f64; NODES]; NODES] = std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)));
        let solution = |j: usize| Lane(std::array::from_fn(|c| (j * 3 + c) as f64 - 4.0));
        let mut right: NodeRows =
            std::array::from_fn(|i| vec![(0..NODES).fold(Lane::ZERO, |sum, j| sum.add_scaled(entry(i, j), &solution(j)))]);
        eliminate(Portable::new(), &mut matrix, &mut right);
        for (j, row) in right.iter().enumerate() {
            assert!(row[0].0.iter().zip(solution(j).0).all(|(a, b)| (a - b).abs() < 1e-12), "row {j}: {row:?}");
        }
    }
}
