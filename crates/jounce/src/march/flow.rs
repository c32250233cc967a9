//! Exact flow of all blocks at once: over a level length by a table, over a short time by its power series.

use super::layout::Layout;
use crate::plant::Block;
use crate::wide::{Lane, WIDTH, Wide};

/// Entries `a, b, c, d` of the 2 x 2 blocks, then the 1 x 1 blocks, in padded lanes: a flow, or its generator.
#[derive(Debug, Clone)]
pub struct Flow {
    pairs: [Vec<Lane>; 4],
    reals: Vec<Lane>,
}

/// Terms of the power series ...
const TERMS: usize = 11;

/// ... which are enough while `|lambda| t` is below this: the first left out is `(1/8)^12 / 12! = 3e-20`.
pub const SHORT: f64 = 0.125;

impl Flow {
    /// `e^{A t}`.
    pub fn over(block: &Block, layout: &Layout, time_s: f64) -> Self {
        Self::of(layout, block.pairs.iter().map(|pair| pair.flow(time_s)), block.reals.iter().map(|rate| (rate * time_s).exp()))
    }

    /// `A` itself.
    pub fn generator(block: &Block, layout: &Layout) -> Self {
        Self::of(layout, block.pairs.iter().map(crate::plant::Pair::matrix), block.reals.iter().copied())
    }

    fn of(layout: &Layout, pairs: impl Iterator<Item = [f64; 4]>, reals: impl Iterator<Item = f64>) -> Self {
        let lanes = || vec![Lane::ZERO; layout.pair_lanes];
        let mut flow = Self { pairs: [lanes(), lanes(), lanes(), lanes()], reals: vec![Lane::ZERO; layout.real_lanes] };
        for (k, entries) in pairs.enumerate() {
            for (lanes, entry) in flow.pairs.iter_mut().zip(entries) {
                lanes[k / WIDTH].0[k % WIDTH] = entry;
            }
        }
        for (k, entry) in reals.enumerate() {
            flow.reals[k / WIDTH].0[k % WIDTH] = entry;
        }
        flow
    }

    /// Entries `a, b, c, d` of pair `k`.
    #[inline(always)]
    pub fn pair(&self, k: usize) -> [f64; 4] {
        std::array::from_fn(|entry| self.pairs[entry][k / WIDTH].0[k % WIDTH])
    }

    /// Entry of real `k`.
    #[inline(always)]
    pub fn real(&self, k: usize) -> f64 {
        self.reals[k / WIDTH].0[k % WIDTH]
    }

    #[inline(always)]
    fn entries<W: Wide>(&self, w: W, k: usize) -> [W::Register; 4] {
        let [a, b, c, d] = &self.pairs;
        [w.load(&a[k]), w.load(&b[k]), w.load(&c[k]), w.load(&d[k])]
    }

    /// Applies the blocks to a state.
    #[inline(always)]
    pub fn apply<W: Wide>(&self, w: W, y: &[Lane], out: &mut [Lane]) {
        let p = self.pairs[0].len();
        for k in 0..p {
            let (u, v) = (w.load(&y[k]), w.load(&y[p + k]));
            let [a, b, c, d] = self.entries(w, k);
            out[k] = w.store(w.fma(a, u, w.mul(b, v)));
            out[p + k] = w.store(w.fma(c, u, w.mul(d, v)));
        }
        for (k, rate) in self.reals.iter().enumerate() {
            out[2 * p + k] = w.store(w.mul(w.load(rate), w.load(&y[2 * p + k])));
        }
    }

    /// `e^{A t} y` in place, for a generator `A` and a short time of either sign, by Horner's scheme.
    #[inline(always)]
    pub fn glide<W: Wide>(&self, w: W, time_s: f64, y: &mut [Lane]) {
        let p = self.pairs[0].len();
        for k in 0..p {
            let (u, v) = (w.load(&y[k]), w.load(&y[p + k]));
            let [a, b, c, d] = self.entries(w, k);
            let time = w.splat(time_s);
            let (a, b, c, d) = (w.mul(time, a), w.mul(time, b), w.mul(time, c), w.mul(time, d));
            let (mut sum_u, mut sum_v) = (u, v);
            for n in (1..=TERMS).rev() {
                let share = w.splat(1.0 / n as f64);
                let (next_u, next_v) = (w.fma(a, sum_u, w.mul(b, sum_v)), w.fma(c, sum_u, w.mul(d, sum_v)));
                (sum_u, sum_v) = (w.fma(share, next_u, u), w.fma(share, next_v, v));
            }
            (y[k], y[p + k]) = (w.store(sum_u), w.store(sum_v));
        }
        for (k, rate) in self.reals.iter().enumerate() {
            let start = w.load(&y[2 * p + k]);
            let rate = w.mul(w.splat(time_s), w.load(rate));
            let mut sum = start;
            for n in (1..=TERMS).rev() {
                sum = w.fma(w.splat(1.0 / n as f64), w.mul(rate, sum), start);
            }
            y[2 * p + k] = w.store(sum);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plant::Pair;
    use crate::wide::Portable;

    #[test]
    fn series_and_closed_form_agree() {
        let block =
            Block { pairs: vec![Pair::Oscillatory { decay: -3.0, frequency: 900.0 }, Pair::Jordan { rate: -40.0 }], reals: vec![-700.0] };
        let layout = Layout { pairs: 2, reals: 1, pair_lanes: 1, real_lanes: 1 };
        let start = [1.0, -0.3, 0.7, 2.0, 1.5];
        for time_s in [1.3e-4, -1.3e-4, 1e-9] {
            let mut y = layout.pack(&start);
            Flow::generator(&block, &layout).glide(Portable::new(), time_s, &mut y);
            for (a, b) in layout.unpack(&y).iter().zip(block.flow(time_s, &start)) {
                assert!((a - b).abs() < 4e-16 * 3.0, "{a} {b}");
            }
        }
    }
}
