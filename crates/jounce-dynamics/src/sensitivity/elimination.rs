//! Small linear system of one contact step, for all columns at once.

use crate::force_response::basis::NODES;
use jounce_simd::{F64x8, LANES, Simd};

/// Nodes in one pass over right sides: all at once would exceed the registers of most machines.
pub const NODES_PER_PASS: usize = LANES / 2;

/// One vector for each node of a port.
pub type NodeVectors = [F64x8; NODES];

/// `A x = r` for the nodes of one or several ports.
#[derive(Debug)]
pub struct NodeSystem {
    ports: usize,
    /// Vectors of a right side.
    width: usize,
    /// Blocks of `A`, later of its inverse, for the rows of one port and the columns of another: a
    /// vector of rows for each column, last lane 0.
    blocks: Vec<NodeVectors>,
    /// Right sides, for each port one entry per vector.
    rights: Vec<NodeVectors>,
    /// Solutions, in the same order.
    solutions: Vec<NodeVectors>,
}

impl NodeSystem {
    /// Allocates for a number of ports and right sides of a number of vectors.
    pub fn new(ports: usize, width: usize) -> Self {
        const EMPTY: NodeVectors = [F64x8::ZERO; NODES];
        Self {
            ports,
            width,
            blocks: vec![EMPTY; ports * ports],
            rights: vec![EMPTY; ports * width],
            solutions: vec![EMPTY; ports * width],
        }
    }

    /// Returns the number of ports.
    pub fn ports(&self) -> usize {
        self.ports
    }

    /// Returns the columns of `A` of the nodes of a port `from`, for the nodes of a port `to`.
    #[inline(always)]
    pub fn block(&mut self, from: usize, to: usize) -> &mut NodeVectors {
        &mut self.blocks[from * self.ports + to]
    }

    /// Returns one vector of the right sides of a port.
    #[inline(always)]
    pub fn right(&mut self, port: usize, lane: usize) -> &mut NodeVectors {
        &mut self.rights[port * self.width + lane]
    }

    /// Returns one vector of the solutions of a port.
    #[inline(always)]
    pub fn solution(&self, port: usize, lane: usize) -> &NodeVectors {
        &self.solutions[port * self.width + lane]
    }

    /// Solves for all right sides; `A` is the identity minus a small integration operator.
    #[inline(always)]
    pub fn solve<W: Simd>(&mut self, w: W) {
        self.invert(w);
        for port in 0..self.ports {
            for lane in 0..self.width {
                self.multiply::<W, NODES_PER_PASS>(w, port, 0, lane);
                self.multiply::<W, { NODES - NODES_PER_PASS }>(w, port, NODES_PER_PASS, lane);
            }
        }
    }

    /// Computes one vector of the solutions of `COUNT` nodes of a port, from `first` on.
    #[inline(always)]
    fn multiply<W: Simd, const COUNT: usize>(
        &mut self,
        w: W,
        port: usize,
        first: usize,
        lane: usize,
    ) {
        let mut sums = [w.zero(); COUNT];
        for from in 0..self.ports {
            let columns = &self.blocks[from * self.ports + port];
            let rights = &self.rights[from * self.width + lane];
            for (column, right) in columns.iter().zip(rights) {
                let right = w.load(right);
                for (i, sum) in sums.iter_mut().enumerate() {
                    *sum = w.fma(w.splat(column.0[first + i]), right, *sum);
                }
            }
        }
        let solutions = &mut self.solutions[port * self.width + lane];
        for (solution, sum) in solutions[first..].iter_mut().zip(sums) {
            *solution = w.store(sum);
        }
    }

    /// Replaces `A` by its inverse, by elimination with row exchange.
    #[inline(always)]
    fn invert<W: Simd>(&mut self, w: W) {
        let mut exchanges = Vec::new();
        for port in 0..self.ports {
            for node in 0..NODES {
                let pivot = self.pivot((port, node));
                if pivot != (port, node) {
                    self.exchange_rows((port, node), pivot);
                    exchanges.push(((port, node), pivot));
                }
                self.eliminate(w, (port, node));
            }
        }
        for (node, pivot) in exchanges.into_iter().rev() {
            self.exchange_columns(node, pivot);
        }
    }

    /// Returns the row of the largest entry of the column of a node, from the row of this node on.
    #[inline(always)]
    fn pivot(&self, (port, node): (usize, usize)) -> (usize, usize) {
        let (mut pivot, mut largest, mut first) = ((port, node), 0.0, node);
        for to in port..self.ports {
            let column = &self.blocks[port * self.ports + to][node].0;
            for (row, entry) in column.iter().enumerate().skip(first) {
                if entry.abs() > largest {
                    (pivot, largest) = ((to, row), entry.abs());
                }
            }
            first = 0;
        }
        pivot
    }

    #[cold]
    fn exchange_rows(&mut self, (port, node): (usize, usize), (other, pivot): (usize, usize)) {
        for from in 0..self.ports {
            let (row, exchanged) = (from * self.ports + port, from * self.ports + other);
            for j in 0..NODES {
                let upper = self.blocks[row][j].0[node];
                self.blocks[row][j].0[node] = self.blocks[exchanged][j].0[pivot];
                self.blocks[exchanged][j].0[pivot] = upper;
            }
        }
    }

    #[cold]
    fn exchange_columns(&mut self, (port, node): (usize, usize), (other, pivot): (usize, usize)) {
        for to in 0..self.ports {
            let column = self.blocks[port * self.ports + to][node];
            let exchanged = &mut self.blocks[other * self.ports + to][pivot];
            let exchanged = std::mem::replace(exchanged, column);
            self.blocks[port * self.ports + to][node] = exchanged;
        }
    }

    /// Eliminates the unknown of a node from all other rows, in place.
    #[inline(always)]
    fn eliminate<W: Simd>(&mut self, w: W, (port, node): (usize, usize)) {
        let ports = self.ports;
        let diagonal = &mut self.blocks[port * ports + port][node].0[node];
        let inverse = 1.0 / std::mem::replace(diagonal, 0.0);
        for from in 0..ports {
            let mut scaled = [0.0; NODES];
            for (scaled, column) in scaled.iter_mut().zip(&self.blocks[from * ports + port]) {
                *scaled = column.0[node] * inverse;
            }
            for to in 0..ports {
                let factors = w.load(&self.blocks[port * ports + to][node]);
                for (column, scaled) in self.blocks[from * ports + to].iter_mut().zip(&scaled) {
                    *column = w.store(w.fma(factors, w.splat(-scaled), w.load(column)));
                }
            }
            for (column, scaled) in self.blocks[from * ports + port].iter_mut().zip(scaled) {
                column.0[node] = scaled;
            }
        }
        for column in &mut self.blocks[port * ports..(port + 1) * ports] {
            column[node] = w.store(w.mul(w.load(&column[node]), w.splat(-inverse)));
        }
        self.blocks[port * ports + port][node].0[node] = inverse;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use jounce_simd::Portable;

    #[test]
    fn solves_a_matrix_that_needs_its_rows_exchanged() {
        for ports in 1..=3 {
            let count = ports * NODES;
            let entry = |i: usize, j: usize| {
                if (i + j) % count == 1 {
                    3.0
                } else {
                    0.1 * (i * j) as f64 / 40.0 / ports.pow(2) as f64
                }
            };
            let solution = |j: usize| F64x8(std::array::from_fn(|c| (j * 3 + c) as f64 - 4.0));
            let mut system = NodeSystem::new(ports, 1);
            for i in 0..count {
                for j in 0..count {
                    let block = system.block(j / NODES, i / NODES);
                    block[j % NODES].0[i % NODES] = entry(i, j);
                }
                system.right(i / NODES, 0)[i % NODES] = (0..count).fold(F64x8::ZERO, |sum, j| {
                    sum.add_scaled(entry(i, j), &solution(j))
                });
            }
            system.solve(Portable::new());
            for j in 0..count {
                let computed = system.solution(j / NODES, 0)[j % NODES];
                let pairs = computed.0.iter().zip(solution(j).0);
                let error = pairs.fold(0.0_f64, |max, (a, b)| max.max((a - b).abs()));
                assert!(error < 1e-12 * count as f64, "row {j}: {computed:?}");
            }
        }
    }
}
