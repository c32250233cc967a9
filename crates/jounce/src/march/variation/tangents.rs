//! Derivatives of the state by all start states and by the parameter at once.

use crate::wide::{Lane, WIDTH, Wide};
use faer::MatRef;

/// Columns in groups of eight, one after the other: in each group one lane per state. The columns belong to the start states, the one
/// after them to the parameter.
///
/// Loops over lanes are written out: a closure inside an iterator would be compiled without the vector instructions.
#[derive(Debug)]
pub struct Tangents {
    states: usize,
    /// Groups.
    pub width: usize,
    lanes: Vec<Lane>,
}

impl Tangents {
    /// Those of the start itself.
    pub fn identity(states: usize) -> Self {
        let width = (states + 1).div_ceil(WIDTH);
        let mut lanes = vec![Lane::ZERO; states * width];
        (0..states).for_each(|i| lanes[i / WIDTH * states + i].0[i % WIDTH] = 1.0);
        Self { states, width, lanes }
    }

    /// Derivative of a state by a start state, or by the parameter.
    pub fn entry(&self, state: usize, column: usize) -> f64 {
        self.lanes[column / WIDTH * self.states + state].0[column % WIDTH]
    }

    /// The groups, one lane per state in each.
    pub fn groups(&self) -> std::slice::ChunksExact<'_, Lane> {
        self.lanes.chunks_exact(self.states.max(1))
    }

    /// The same, to be changed.
    pub fn groups_mut(&mut self) -> std::slice::ChunksExactMut<'_, Lane> {
        self.lanes.chunks_exact_mut(self.states.max(1))
    }

    /// Adds to the number of the parameter in a row.
    #[inline(always)]
    pub fn drift(&self, row: &mut [Lane], by: f64) {
        row[self.states / WIDTH].0[self.states % WIDTH] += by;
    }

    /// `row . dy` for every column, and what the parameter adds to it.
    #[inline(always)]
    pub fn along<W: Wide>(&self, w: W, row: &[f64], drift: f64) -> Vec<Lane> {
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

    /// `dy += factor column (x) row`.
    #[inline(always)]
    pub fn add_product<W: Wide>(&mut self, w: W, column: &[f64], factor: f64, row: &[Lane]) {
        for (group, lane) in self.lanes.chunks_exact_mut(self.states.max(1)).zip(row) {
            let lane = w.mul(w.splat(factor), w.load(lane));
            for (own, entry) in group.iter_mut().zip(column) {
                *own = w.store(w.fma(w.splat(*entry), lane, w.load(own)));
            }
        }
    }

    /// Turns the two rows of pair `k`.
    #[inline(always)]
    pub fn turn<W: Wide>(&mut self, w: W, k: usize, entries: [f64; 4]) {
        let [a, b, c, d] = [w.splat(entries[0]), w.splat(entries[1]), w.splat(entries[2]), w.splat(entries[3])];
        for group in self.lanes.chunks_exact_mut(self.states.max(1)) {
            let (x, y) = (w.load(&group[2 * k]), w.load(&group[2 * k + 1]));
            group[2 * k] = w.store(w.fma(a, x, w.mul(b, y)));
            group[2 * k + 1] = w.store(w.fma(c, x, w.mul(d, y)));
        }
    }

    /// `dy = matrix dy`.
    pub fn transform(&mut self, matrix: MatRef<f64>) {
        let mut before = vec![Lane::ZERO; self.states];
        for group in self.lanes.chunks_exact_mut(self.states.max(1)) {
            before.copy_from_slice(group);
            for (i, own) in group.iter_mut().enumerate() {
                let add = |sum: Lane, (j, lane): (usize, &Lane)| sum.add_scaled(matrix[(i, j)], lane);
                *own = before.iter().enumerate().fold(Lane::ZERO, add);
            }
        }
    }

    /// Shrinks the row of a real state.
    #[inline(always)]
    pub fn decay<W: Wide>(&mut self, w: W, state: usize, factor: f64) {
        for group in self.lanes.chunks_exact_mut(self.states.max(1)) {
            group[state] = w.store(w.mul(w.splat(factor), w.load(&group[state])));
        }
    }
}

/// `sum += factor values`.
#[inline(always)]
pub fn add_scaled<W: Wide>(w: W, sum: &mut [Lane], factor: f64, values: &[Lane]) {
    let factor = w.splat(factor);
    for (sum, value) in sum.iter_mut().zip(values) {
        *sum = w.store(w.fma(factor, w.load(value), w.load(sum)));
    }
}

/// `row *= factor`.
#[inline(always)]
pub fn scale<W: Wide>(w: W, row: &mut [Lane], factor: f64) {
    for lane in row {
        *lane = w.store(w.mul(w.splat(factor), w.load(lane)));
    }
}
