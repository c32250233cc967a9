//! The small linear system of one contact step, for all columns at once.

use super::tangents::{add_scaled, scale};
use crate::march::basis::NODES;
use crate::wide::{Lane, Wide};

/// `A x = r` for seven nodes: per node a row with its entries of `A` in one lane, and those of `r` in the lanes after it.
#[derive(Debug)]
pub struct NodeSystem {
    stride: usize,
    rows: Vec<Lane>,
}

impl NodeSystem {
    /// Room for right sides of a number of lanes.
    pub fn new(width: usize) -> Self {
        Self { stride: width + 1, rows: vec![Lane::ZERO; NODES * (width + 1)] }
    }

    /// Row of `A` of a node.
    #[inline(always)]
    pub fn matrix(&mut self, node: usize) -> &mut Lane {
        &mut self.rows[node * self.stride]
    }

    /// Right side of a node; after [`NodeSystem::solve`] its solution.
    #[inline(always)]
    pub fn right(&mut self, node: usize) -> &mut [Lane] {
        &mut self.rows[node * self.stride + 1..(node + 1) * self.stride]
    }

    /// One lane of all right sides, or of the solution.
    #[inline(always)]
    pub fn column<W: Wide>(&self, w: W, lane: usize) -> [W::Register; NODES] {
        let mut column = [w.zero(); NODES];
        for (node, own) in column.iter_mut().enumerate() {
            *own = w.load(&self.rows[node * self.stride + 1 + lane]);
        }
        column
    }

    /// Solves in place by elimination with row exchange; `A` is the identity less a small integration.
    #[inline(always)]
    pub fn solve<W: Wide>(&mut self, w: W) {
        let stride = self.stride;
        for k in 0..NODES {
            let mut pivot = k;
            for i in k + 1..NODES {
                if self.rows[i * stride].0[k].abs() > self.rows[pivot * stride].0[k].abs() {
                    pivot = i;
                }
            }
            if pivot > k {
                let (low, high) = self.rows.split_at_mut(pivot * stride);
                low[k * stride..(k + 1) * stride].swap_with_slice(&mut high[..stride]);
            }
            let inverse = 1.0 / self.rows[k * stride].0[k];
            scale(w, &mut self.rows[k * stride..(k + 1) * stride], inverse);
            let (below, rest) = self.rows.split_at_mut(k * stride);
            let (own, above) = rest.split_at_mut(stride);
            for row in below.chunks_exact_mut(stride).chain(above.chunks_exact_mut(stride)) {
                add_scaled(w, row, -row[0].0[k], own);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wide::Portable;

    #[test]
    fn solves_a_matrix_that_needs_its_rows_exchanged() {
        let entry = |i: usize, j: usize| if (i + j) % NODES == 1 { 3.0 } else { 0.1 * (i * j) as f64 / 40.0 };
        let solution = |j: usize| Lane(std::array::from_fn(|c| (j * 3 + c) as f64 - 4.0));
        let mut system = NodeSystem::new(1);
        for i in 0..NODES {
            *system.matrix(i) = Lane(std::array::from_fn(|j| if j < NODES { entry(i, j) } else { 0.0 }));
            system.right(i)[0] = (0..NODES).fold(Lane::ZERO, |sum, j| sum.add_scaled(entry(i, j), &solution(j)));
        }
        system.solve(Portable::new());
        for j in 0..NODES {
            let found = system.right(j)[0];
            assert!(found.0.iter().zip(solution(j).0).all(|(a, b)| (a - b).abs() < 1e-12), "row {j}: {found:?}");
        }
    }
}
