//! Derivatives of the state by all start states and by the parameter at once.

use super::parameters::first_vector;
use jounce_linalg::Mat;
use jounce_simd::{F64x8, LANES, Simd};

/// Nodes in one pass over the tangents.
pub const NODES_PER_PASS: usize = LANES / 2;

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

    /// Adds to the parameter column of a row.
    #[inline(always)]
    pub fn drift(&self, row: &mut [F64x8], by: f64) {
        row[self.states / LANES].0[self.states % LANES] += by;
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
        self.drift(&mut sums, drift);
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

/// Computes `sum += factor values`.
#[inline(always)]
pub fn add_scaled<W: Simd>(w: W, sum: &mut [F64x8], factor: f64, values: &[F64x8]) {
    let factor = w.splat(factor);
    for (sum, value) in sum.iter_mut().zip(values) {
        *sum = w.store(w.fma(factor, w.load(value), w.load(sum)));
    }
}

/// Computes `row *= factor`.
#[inline(always)]
pub fn scale<W: Simd>(w: W, row: &mut [F64x8], factor: f64) {
    for lane in row {
        *lane = w.store(w.mul(w.splat(factor), w.load(lane)));
    }
}

/// Sums a group of tangents by the factors of some nodes, from `first` on.
#[inline(always)]
pub fn sums<W: Simd>(
    w: W,
    factors: &[F64x8],
    group: &[F64x8],
    first: usize,
) -> [W::Register; NODES_PER_PASS] {
    let mut sums = [w.zero(); NODES_PER_PASS];
    for (factor, value) in factors.iter().zip(group) {
        let value = w.load(value);
        for (i, sum) in sums.iter_mut().enumerate() {
            *sum = w.fma(w.splat(factor.0[first + i]), value, *sum);
        }
    }
    sums
}
