//! Small linear system of one contact step, for all columns at once.

use super::tangents::{add_scaled, scale};
use crate::force_response::basis::NODES;
use jounce_simd::{F64x8, Simd};

/// `A x = r` for the nodes of one or several ports: each node has a row with its entries of `A`,
/// one vector per port, followed by its entries of `r`.
#[derive(Debug)]
pub struct NodeSystem {
    ports: usize,
    stride: usize,
    rows: Vec<F64x8>,
}

impl NodeSystem {
    /// Allocates for a number of ports and right sides of a number of vectors.
    pub fn new(ports: usize, width: usize) -> Self {
        Self {
            ports,
            stride: width + ports,
            rows: vec![F64x8::ZERO; ports * NODES * (width + ports)],
        }
    }

    /// Returns the number of ports.
    pub fn ports(&self) -> usize {
        self.ports
    }

    /// Returns the row of `A` of a node, for the nodes of one port.
    #[inline(always)]
    pub fn matrix(&mut self, node: usize, port: usize) -> &mut F64x8 {
        &mut self.rows[node * self.stride + port]
    }

    /// Returns the right side of a node; after [`NodeSystem::solve`] its solution.
    #[inline(always)]
    pub fn right(&mut self, node: usize) -> &mut [F64x8] {
        &mut self.rows[node * self.stride + self.ports..(node + 1) * self.stride]
    }

    /// Returns one vector of all right sides of a port, or of their solution.
    #[inline(always)]
    pub fn column<W: Simd>(&self, w: W, port: usize, lane: usize) -> [W::Register; NODES] {
        let mut column = [w.zero(); NODES];
        for (node, entry) in column.iter_mut().enumerate() {
            *entry = w.load(&self.rows[(port * NODES + node) * self.stride + self.ports + lane]);
        }
        column
    }

    /// Solves in place by elimination with row exchange; `A` is the identity minus a small
    /// integration operator.
    #[inline(always)]
    pub fn solve<W: Simd>(&mut self, w: W) {
        let (stride, count) = (self.stride, self.ports * NODES);
        for k in 0..count {
            let (at, node) = (k / NODES, k % NODES);
            let mut pivot = k;
            for i in k + 1..count {
                if self.rows[i * stride + at].0[node].abs()
                    > self.rows[pivot * stride + at].0[node].abs()
                {
                    pivot = i;
                }
            }
            if pivot > k {
                let (low, high) = self.rows.split_at_mut(pivot * stride);
                low[k * stride..(k + 1) * stride].swap_with_slice(&mut high[..stride]);
            }
            let inverse = 1.0 / self.rows[k * stride + at].0[node];
            scale(w, &mut self.rows[k * stride..(k + 1) * stride], inverse);
            let (below, rest) = self.rows.split_at_mut(k * stride);
            let (pivot_rows, above) = rest.split_at_mut(stride);
            for row in below
                .chunks_exact_mut(stride)
                .chain(above.chunks_exact_mut(stride))
            {
                add_scaled(w, row, -row[at].0[node], pivot_rows);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use jounce_simd::Portable;

    #[test]
    fn solves_a_matrix_that_needs_its_rows_exchanged() {
        let entry = |i: usize, j: usize| {
            if (i + j) % NODES == 1 {
                3.0
            } else {
                0.1 * (i * j) as f64 / 40.0
            }
        };
        let solution = |j: usize| F64x8(std::array::from_fn(|c| (j * 3 + c) as f64 - 4.0));
        let mut system = NodeSystem::new(1, 1);
        for i in 0..NODES {
            *system.matrix(i, 0) = F64x8(std::array::from_fn(|j| {
                if j < NODES { entry(i, j) } else { 0.0 }
            }));
            system.right(i)[0] = (0..NODES).fold(F64x8::ZERO, |sum, j| {
                sum.add_scaled(entry(i, j), &solution(j))
            });
        }
        system.solve(Portable::new());
        for j in 0..NODES {
            let computed = system.right(j)[0];
            assert!(
                computed
                    .0
                    .iter()
                    .zip(solution(j).0)
                    .all(|(a, b)| (a - b).abs() < 1e-12),
                "row {j}: {computed:?}"
            );
        }
    }
}
