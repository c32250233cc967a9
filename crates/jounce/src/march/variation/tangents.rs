//! Derivatives of the state by all start states and by the parameter at once.

use crate::wide::{Lane, WIDTH, Wide};

/// One row of lanes per state; its numbers belong to the start states, the one after them to the parameter.
#[derive(Debug)]
pub struct Tangents {
    states: usize,
    /// Lanes per row.
    width: usize,
    rows: Vec<Lane>,
}

impl Tangents {
    /// Those of the start itself.
    pub fn identity(states: usize) -> Self {
        let width = (states + 1).div_ceil(WIDTH);
        let mut rows = vec![Lane::ZERO; states * width];
        (0..states).for_each(|i| rows[i * width + i / WIDTH].0[i % WIDTH] = 1.0);
        Self { states, width, rows }
    }

    /// Derivative of a state by a start state, or by the parameter.
    pub fn entry(&self, state: usize, column: usize) -> f64 {
        self.rows[state * self.width + column / WIDTH].0[column % WIDTH]
    }

    /// Zeros for one row.
    pub fn blank(&self) -> Vec<Lane> {
        vec![Lane::ZERO; self.width]
    }

    /// All rows in the order of the states.
    #[inline(always)]
    pub fn rows(&self) -> std::slice::ChunksExact<'_, Lane> {
        self.rows.chunks_exact(self.width)
    }

    /// The same, to be changed.
    #[inline(always)]
    pub fn rows_mut(&mut self) -> std::slice::ChunksExactMut<'_, Lane> {
        self.rows.chunks_exact_mut(self.width)
    }

    /// Adds to the number of the parameter in a row.
    #[inline(always)]
    pub fn drift(&self, row: &mut [Lane], by: f64) {
        row[self.states / WIDTH].0[self.states % WIDTH] += by;
    }

    /// `row . dy` for every column, and what the parameter adds to it.
    #[inline(always)]
    pub fn along<W: Wide>(&self, w: W, row: &[f64], drift: f64) -> Vec<Lane> {
        let mut sum = self.blank();
        row.iter().zip(self.rows()).for_each(|(factor, values)| add_scaled(w, &mut sum, *factor, values));
        self.drift(&mut sum, drift);
        sum
    }

    /// `dy += factor column (x) row`.
    #[inline(always)]
    pub fn add_product<W: Wide>(&mut self, w: W, column: &[f64], factor: f64, row: &[Lane]) {
        self.rows_mut().zip(column).for_each(|(own, entry)| add_scaled(w, own, factor * entry, row));
    }

    /// Turns the two rows of pair `k`.
    #[inline(always)]
    pub fn turn<W: Wide>(&mut self, w: W, k: usize, entries: [f64; 4]) {
        let [a, b, c, d] = entries.map(|entry| w.splat(entry));
        let (low, high) = self.rows.split_at_mut((2 * k + 1) * self.width);
        for (u, v) in low[2 * k * self.width..].iter_mut().zip(high.iter_mut()) {
            let (x, y) = (w.load(u), w.load(v));
            *u = w.store(w.fma(a, x, w.mul(b, y)));
            *v = w.store(w.fma(c, x, w.mul(d, y)));
        }
    }

    /// Shrinks the row of a real state.
    #[inline(always)]
    pub fn decay<W: Wide>(&mut self, w: W, state: usize, factor: f64) {
        scale(w, &mut self.rows[state * self.width..(state + 1) * self.width], factor);
    }
}

/// `sum += factor values`.
#[inline(always)]
pub fn add_scaled<W: Wide>(w: W, sum: &mut [Lane], factor: f64, values: &[Lane]) {
    let factor = w.splat(factor);
    sum.iter_mut().zip(values).for_each(|(sum, value)| *sum = w.store(w.fma(factor, w.load(value), w.load(sum))));
}

/// `row *= factor`.
#[inline(always)]
pub fn scale<W: Wide>(w: W, row: &mut [Lane], factor: f64) {
    row.iter_mut().for_each(|lane| *lane = w.store(w.mul(w.splat(factor), w.load(lane))));
}
