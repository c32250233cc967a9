//! Derivatives of the state by all start states and by the parameter at once.

use crate::wide::{Lane, WIDTH, Wide};

/// One row of lanes per state; its numbers belong to the start states, the one after them to the parameter.
///
/// Loops over lanes are written out: a closure inside an iterator would be compiled without the vector instructions.
#[derive(Debug)]
pub struct Tangents {
    states: usize,
    /// Lanes per row.
    pub width: usize,
    /// Row after row.
    pub lanes: Vec<Lane>,
}

impl Tangents {
    /// Those of the start itself.
    pub fn identity(states: usize) -> Self {
        let width = (states + 1).div_ceil(WIDTH);
        let mut lanes = vec![Lane::ZERO; states * width];
        (0..states).for_each(|i| lanes[i * width + i / WIDTH].0[i % WIDTH] = 1.0);
        Self { states, width, lanes }
    }

    /// Derivative of a state by a start state, or by the parameter.
    pub fn entry(&self, state: usize, column: usize) -> f64 {
        self.lanes[state * self.width + column / WIDTH].0[column % WIDTH]
    }

    /// Adds to the number of the parameter in a row.
    #[inline(always)]
    pub fn drift(&self, row: &mut [Lane], by: f64) {
        row[self.states / WIDTH].0[self.states % WIDTH] += by;
    }

    /// `row . dy` for every column, and what the parameter adds to it.
    #[inline(always)]
    pub fn along<W: Wide>(&self, w: W, row: &[f64], drift: f64) -> Vec<Lane> {
        let mut sum = vec![Lane::ZERO; self.width];
        for (factor, values) in row.iter().zip(self.lanes.chunks_exact(self.width)) {
            add_scaled(w, &mut sum, *factor, values);
        }
        self.drift(&mut sum, drift);
        sum
    }

    /// `dy += factor column (x) row`.
    #[inline(always)]
    pub fn add_product<W: Wide>(&mut self, w: W, column: &[f64], factor: f64, row: &[Lane]) {
        for (own, entry) in self.lanes.chunks_exact_mut(self.width).zip(column) {
            add_scaled(w, own, factor * entry, row);
        }
    }

    /// Turns the two rows of pair `k`.
    #[inline(always)]
    pub fn turn<W: Wide>(&mut self, w: W, k: usize, entries: [f64; 4]) {
        let [a, b, c, d] = [w.splat(entries[0]), w.splat(entries[1]), w.splat(entries[2]), w.splat(entries[3])];
        let (low, high) = self.lanes.split_at_mut((2 * k + 1) * self.width);
        for (u, v) in low[2 * k * self.width..].iter_mut().zip(high) {
            let (x, y) = (w.load(u), w.load(v));
            *u = w.store(w.fma(a, x, w.mul(b, y)));
            *v = w.store(w.fma(c, x, w.mul(d, y)));
        }
    }

    /// Shrinks the row of a real state.
    #[inline(always)]
    pub fn decay<W: Wide>(&mut self, w: W, state: usize, factor: f64) {
        scale(w, &mut self.lanes[state * self.width..(state + 1) * self.width], factor);
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
