//! Derivatives of the state by all start states and by the parameter at once.

use super::elimination::NodeSystem;
use super::parameters::first_vector;
use crate::flow::Flow;
use crate::flow::layout::StateLayout;
use crate::force_response::basis::NODES;
use jounce_linalg::Mat;
use jounce_simd::{F64x8, LANES, Simd};

/// Columns in groups of eight, one after the other: each group has one vector per state. The first
/// columns belong to the start states, the next one to the parameter.
///
/// Loops over vectors are written out: a closure inside an iterator would be compiled without the
/// vector instructions.
#[derive(Debug)]
pub struct Tangents {
    states: usize,
    /// Number of groups.
    pub width: usize,
    lanes: Vec<F64x8>,
}

impl Tangents {
    /// Returns the tangents of the start state, with empty columns for a number of groups of further
    /// parameters.
    pub fn identity(states: usize, groups: usize) -> Self {
        let width = first_vector(states) + groups;
        let mut lanes = vec![F64x8::ZERO; states * width];
        (0..states).for_each(|i| lanes[i / LANES * states + i].0[i % LANES] = 1.0);
        Self {
            states,
            width,
            lanes,
        }
    }

    /// Returns the derivative of a state by a start state, or by the parameter.
    pub fn entry(&self, state: usize, column: usize) -> f64 {
        self.lanes[column / LANES * self.states + state].0[column % LANES]
    }

    /// Returns the groups, one vector per state in each.
    pub fn groups(&self) -> std::slice::ChunksExact<'_, F64x8> {
        self.lanes.chunks_exact(self.states.max(1))
    }

    /// Returns the mutable groups.
    pub fn groups_mut(&mut self) -> std::slice::ChunksExactMut<'_, F64x8> {
        self.lanes.chunks_exact_mut(self.states.max(1))
    }

    /// Returns vector and lane of the parameter column.
    #[inline(always)]
    pub fn drift_column(&self) -> (usize, usize) {
        (self.states / LANES, self.states % LANES)
    }

    /// Computes `row . dy` for every column, plus the contribution of the parameter.
    #[inline(always)]
    pub fn along<W: Simd>(&self, w: W, row: &[f64], drift: f64) -> Vec<F64x8> {
        let mut sums = Vec::with_capacity(self.width);
        for group in self.groups() {
            let mut sum = w.zero();
            for (factor, lane) in row.iter().zip(group) {
                sum = w.fma(w.splat(*factor), w.load(lane), sum);
            }
            sums.push(w.store(sum));
        }
        let (lane, column) = self.drift_column();
        sums[lane].0[column] += drift;
        sums
    }

    /// Computes `dy += factor column (x) row`.
    #[inline(always)]
    pub fn add_product<W: Simd>(&mut self, w: W, column: &[f64], factor: f64, row: &[F64x8]) {
        for (group, lane) in self.lanes.chunks_exact_mut(self.states.max(1)).zip(row) {
            let lane = w.mul(w.splat(factor), w.load(lane));
            for (sum, entry) in group.iter_mut().zip(column) {
                *sum = w.store(w.fma(w.splat(*entry), lane, w.load(sum)));
            }
        }
    }

    /// Rotates the two rows of pair `k`.
    #[inline(always)]
    pub fn turn<W: Simd>(&mut self, w: W, k: usize, entries: [f64; 4]) {
        let [a, b, c, d] = [
            w.splat(entries[0]),
            w.splat(entries[1]),
            w.splat(entries[2]),
            w.splat(entries[3]),
        ];
        for group in self.lanes.chunks_exact_mut(self.states.max(1)) {
            let (x, y) = (w.load(&group[2 * k]), w.load(&group[2 * k + 1]));
            group[2 * k] = w.store(w.fma(a, x, w.mul(b, y)));
            group[2 * k + 1] = w.store(w.fma(c, x, w.mul(d, y)));
        }
    }

    /// Computes `dy = e^{A h} dy + B X` of a step; `push` is `B` of one port, `X` the solutions of
    /// its nodes.
    #[inline(always)]
    pub fn step<W: Simd>(
        &mut self,
        w: W,
        layout: &StateLayout,
        flow: &Flow,
        push: &[[F64x8; NODES]],
        system: &NodeSystem,
    ) {
        let (of_u, rest) = push.split_at(layout.pair_lanes);
        let (of_v, of_r) = rest.split_at(layout.pair_lanes);
        for (lane, group) in self.groups_mut().enumerate() {
            let solutions = system.solution(0, lane);
            let (paired, reals) = group.split_at_mut(2 * layout.pairs);
            let vectors = paired.chunks_mut(2 * LANES).zip(of_u.iter().zip(of_v));
            for (at, (rows, (by_u, by_v))) in vectors.enumerate() {
                let [a, b, c, d] = flow.pair_vectors(at);
                for (k, pair) in (0..LANES).zip(rows.chunks_exact_mut(2)) {
                    let (u, v) = (w.load(&pair[0]), w.load(&pair[1]));
                    let mut next_u = w.fma(w.splat(a.0[k]), u, w.mul(w.splat(b.0[k]), v));
                    let mut next_v = w.fma(w.splat(c.0[k]), u, w.mul(w.splat(d.0[k]), v));
                    for j in 0..NODES {
                        let x = w.load(&solutions[j]);
                        next_u = w.fma(w.splat(by_u[j].0[k]), x, next_u);
                        next_v = w.fma(w.splat(by_v[j].0[k]), x, next_v);
                    }
                    (pair[0], pair[1]) = (w.store(next_u), w.store(next_v));
                }
            }
            for (at, (rows, by)) in reals.chunks_mut(LANES).zip(of_r).enumerate() {
                let decay = flow.real_vector(at);
                for (k, row) in (0..LANES).zip(rows) {
                    let mut next = w.mul(w.splat(decay.0[k]), w.load(row));
                    for j in 0..NODES {
                        next = w.fma(w.splat(by[j].0[k]), w.load(&solutions[j]), next);
                    }
                    *row = w.store(next);
                }
            }
        }
    }

    /// Adds `B X` of a further port, by its index among the ports in contact.
    #[inline(always)]
    pub fn push<W: Simd>(
        &mut self,
        w: W,
        layout: &StateLayout,
        push: &[[F64x8; NODES]],
        (system, port): (&NodeSystem, usize),
    ) {
        for (lane, group) in self.groups_mut().enumerate() {
            let solutions = system.solution(port, lane);
            for (state, row) in group.iter_mut().enumerate() {
                let (at, index) = layout.locate(state);
                let mut next = w.load(row);
                for (by, x) in push[at].iter().zip(solutions) {
                    next = w.fma(w.splat(by.0[index]), w.load(x), next);
                }
                *row = w.store(next);
            }
        }
    }

    /// Computes `dy = matrix dy`.
    pub fn transform(&mut self, matrix: &Mat<f64>) {
        let mut before = vec![F64x8::ZERO; self.states];
        for group in self.lanes.chunks_exact_mut(self.states.max(1)) {
            before.copy_from_slice(group);
            for (i, lane_sum) in group.iter_mut().enumerate() {
                let add =
                    |sum: F64x8, (j, lane): (usize, &F64x8)| sum.add_scaled(matrix[(i, j)], lane);
                *lane_sum = before.iter().enumerate().fold(F64x8::ZERO, add);
            }
        }
    }

    /// Scales the row of a real state.
    #[inline(always)]
    pub fn decay<W: Simd>(&mut self, w: W, state: usize, factor: f64) {
        for group in self.lanes.chunks_exact_mut(self.states.max(1)) {
            group[state] = w.store(w.mul(w.splat(factor), w.load(&group[state])));
        }
    }
}

/// Computes `row *= factor`.
#[inline(always)]
pub fn scale<W: Simd>(w: W, row: &mut [F64x8], factor: f64) {
    for lane in row {
        *lane = w.store(w.mul(w.splat(factor), w.load(lane)));
    }
}

/// Sums a group of tangents by the factors of `COUNT` nodes, from `first` on.
#[inline(always)]
pub fn sums<W: Simd, const COUNT: usize>(
    w: W,
    factors: &[F64x8],
    group: &[F64x8],
    first: usize,
) -> [W::Register; COUNT] {
    let mut sums = [w.zero(); COUNT];
    for (factor, value) in factors.iter().zip(group) {
        let value = w.load(value);
        for (i, sum) in sums.iter_mut().enumerate() {
            *sum = w.fma(w.splat(factor.0[first + i]), value, *sum);
        }
    }
    sums
}
