//! Exact flow of all blocks at once: by a table over a step level, by the power series over a short
//! time.

pub(crate) mod layout;
mod propagation;
pub(crate) mod row;
pub(crate) mod state;

use jounce_model::plant::BlockDiagonal;
use jounce_simd::{F64x8, LANES, Simd};
use layout::StateLayout;

/// Entries `a, b, c, d` of the 2 x 2 blocks, then the 1 x 1 blocks, in padded vectors: a flow, or
/// its generator.
#[derive(Debug, Clone, Default)]
pub struct Flow {
    pairs: [Vec<F64x8>; 4],
    reals: Vec<F64x8>,
}

/// Largest `|lambda| t` of the power series of a flow.
pub const MAX_SERIES_ARGUMENT: f64 = 0.125;

/// Size of the first omitted term of the power series.
const NEGLIGIBLE_TERM: f64 = 3e-20;

/// Largest number of pairs of terms of the power series after the first two, reached at
/// [`MAX_SERIES_ARGUMENT`].
const MAX_SERIES_PAIRS: usize = 6;

/// Factors from one term to the next of equal parity: `1 / (n (n - 1))` for `n = 2, 4, ..` and for
/// `n = 3, 5, ..`.
const SERIES_FACTORS: [[f64; 2]; MAX_SERIES_PAIRS] = {
    let mut factors = [[1.0; 2]; MAX_SERIES_PAIRS];
    let mut m = 0;
    while m < MAX_SERIES_PAIRS {
        let n = (2 * m + 2) as f64;
        factors[m] = [1.0 / (n * (n - 1.0)), 1.0 / (n * (n + 1.0))];
        m += 1;
    }
    factors
};

/// Returns the factors needed for a largest `|lambda| t` of `size`.
#[inline(always)]
fn factors(size: f64) -> &'static [[f64; 2]] {
    let (mut count, mut next) = (0, size * size);
    while next > 2.0 * NEGLIGIBLE_TERM && count < MAX_SERIES_PAIRS {
        count += 1;
        next *= size * size * SERIES_FACTORS[count.min(MAX_SERIES_PAIRS - 1)][0];
    }
    &SERIES_FACTORS[..count]
}

impl Flow {
    /// Returns `e^{A t}`.
    pub fn over(block: &BlockDiagonal, layout: &StateLayout, time_s: f64) -> Self {
        Self::of(
            layout,
            block.pairs.iter().map(|pair| pair.flow(time_s)),
            block.reals.iter().map(|rate| (rate * time_s).exp()),
        )
    }

    /// Returns `A`.
    pub fn generator(block: &BlockDiagonal, layout: &StateLayout) -> Self {
        Self::of(
            layout,
            block
                .pairs
                .iter()
                .map(jounce_model::plant::BlockPair::matrix),
            block.reals.iter().copied(),
        )
    }

    /// Returns `A^-1`, with 0 for the blocks of omitted states.
    pub fn inverse(block: &BlockDiagonal, layout: &StateLayout, omitted: &[bool]) -> Self {
        let unless = |omitted: bool, value: f64| if omitted { 0.0 } else { value };
        let (paired, single) = omitted.split_at(2 * block.pairs.len());
        let pairs = block.pairs.iter().zip(paired.chunks_exact(2));
        let reals = block.reals.iter().zip(single);
        Self::of(
            layout,
            pairs.map(|(pair, omitted)| {
                let [a, b, c, d] = pair.matrix();
                [d, -b, -c, a].map(|entry| unless(omitted[0], entry / (a * d - b * c)))
            }),
            reals.map(|(rate, omitted)| unless(*omitted, 1.0 / rate)),
        )
    }

    fn of(
        layout: &StateLayout,
        pairs: impl Iterator<Item = [f64; 4]>,
        reals: impl Iterator<Item = f64>,
    ) -> Self {
        let lanes = || vec![F64x8::ZERO; layout.pair_lanes];
        let mut flow = Self {
            pairs: [lanes(), lanes(), lanes(), lanes()],
            reals: vec![F64x8::ZERO; layout.real_lanes],
        };
        for (k, entries) in pairs.enumerate() {
            for (lanes, entry) in flow.pairs.iter_mut().zip(entries) {
                lanes[k / LANES].0[k % LANES] = entry;
            }
        }
        for (k, entry) in reals.enumerate() {
            flow.reals[k / LANES].0[k % LANES] = entry;
        }
        flow
    }

    /// Returns the vectors of the entries `a, b, c, d` of a vector of pairs.
    #[inline(always)]
    pub fn pair_vectors(&self, k: usize) -> [&F64x8; 4] {
        let [a, b, c, d] = &self.pairs;
        [&a[k], &b[k], &c[k], &d[k]]
    }

    /// Returns a vector of reals.
    #[inline(always)]
    pub fn real_vector(&self, k: usize) -> &F64x8 {
        &self.reals[k]
    }

    /// Returns the number of vectors of pairs.
    #[inline(always)]
    pub(crate) fn pair_lanes(&self) -> usize {
        self.pairs[0].len()
    }

    /// Returns the number of vectors of reals.
    #[inline(always)]
    pub(crate) fn real_lanes(&self) -> usize {
        self.reals.len()
    }

    /// Returns the entries `a, b, c, d` of a vector of pairs.
    #[inline(always)]
    pub(crate) fn entries<W: Simd>(&self, w: W, k: usize) -> [W::Register; 4] {
        let [a, b, c, d] = &self.pairs;
        [w.load(&a[k]), w.load(&b[k]), w.load(&c[k]), w.load(&d[k])]
    }

    /// Returns the entries of a vector of reals.
    #[inline(always)]
    pub(crate) fn real_entries<W: Simd>(&self, w: W, k: usize) -> W::Register {
        w.load(&self.reals[k])
    }

    /// Applies the blocks to a state.
    #[inline(always)]
    pub fn apply<W: Simd>(&self, w: W, y: &[F64x8], out: &mut [F64x8]) {
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

    /// Propagates a state along flows, one after the other, and then over a short time of either
    /// sign, by the power series of this generator with even and odd powers in parallel.
    /// `fastest_rad_s` bounds its eigenvalues; their product with the time is at most
    /// [`MAX_SERIES_ARGUMENT`].
    ///
    /// Each vector remains in registers throughout.
    #[inline(always)]
    pub fn carry<W: Simd>(
        &self,
        w: W,
        flows: &[&Flow],
        (short_s, fastest_rad_s): (f64, f64),
        y: &mut [F64x8],
    ) {
        let p = self.pairs[0].len();
        let factors = factors(short_s * fastest_rad_s);
        let time = w.splat(short_s);
        for k in 0..p {
            let (mut u, mut v) = (w.load(&y[k]), w.load(&y[p + k]));
            for flow in flows {
                (u, v) = applied(w, flow.entries(w, k), u, v);
            }
            let z = self.entries(w, k).map(|entry| w.mul(time, entry));
            let square = squared(w, z);
            let (first_u, first_v) = applied(w, z, u, v);
            let (mut even_u, mut even_v, mut odd_u, mut odd_v) = (u, v, first_u, first_v);
            for [even, odd] in factors.iter().rev() {
                let (even, odd) = (w.splat(*even), w.splat(*odd));
                let ((a, b), (c, d)) = (
                    applied(w, square, even_u, even_v),
                    applied(w, square, odd_u, odd_v),
                );
                (even_u, even_v) = (w.fma(even, a, u), w.fma(even, b, v));
                (odd_u, odd_v) = (w.fma(odd, c, first_u), w.fma(odd, d, first_v));
            }
            (y[k], y[p + k]) = (w.store(w.add(even_u, odd_u)), w.store(w.add(even_v, odd_v)));
        }
        for (k, rate) in self.reals.iter().enumerate() {
            let mut start = w.load(&y[2 * p + k]);
            for flow in flows {
                start = w.mul(w.load(&flow.reals[k]), start);
            }
            let z = w.mul(time, w.load(rate));
            let (square, first) = (w.mul(z, z), w.mul(z, start));
            let (mut even, mut odd) = (start, first);
            for [by_even, by_odd] in factors.iter().rev() {
                even = w.fma(w.splat(*by_even), w.mul(square, even), start);
                odd = w.fma(w.splat(*by_odd), w.mul(square, odd), first);
            }
            y[2 * p + k] = w.store(w.add(even, odd));
        }
    }
}

/// Multiplies blocks by states.
#[inline(always)]
fn applied<W: Simd>(
    w: W,
    [a, b, c, d]: [W::Register; 4],
    u: W::Register,
    v: W::Register,
) -> (W::Register, W::Register) {
    (w.fma(a, u, w.mul(b, v)), w.fma(c, u, w.mul(d, v)))
}

/// Squares blocks.
#[inline(always)]
fn squared<W: Simd>(w: W, [a, b, c, d]: [W::Register; 4]) -> [W::Register; 4] {
    let (cross, trace) = (w.mul(b, c), w.add(a, d));
    [
        w.fma(a, a, cross),
        w.mul(b, trace),
        w.mul(c, trace),
        w.fma(d, d, cross),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use jounce_model::plant::BlockPair;
    use jounce_simd::Portable;

    #[test]
    fn series_and_closed_form_agree() {
        let block = BlockDiagonal {
            pairs: vec![
                BlockPair::Oscillatory {
                    decay: -3.0,
                    frequency: 900.0,
                },
                BlockPair::Jordan { rate: -40.0 },
                BlockPair::FreeBody { rate: -60.0 },
            ],
            reals: vec![-700.0],
        };
        let layout = StateLayout {
            pairs: 3,
            reals: 1,
            pair_lanes: 1,
            real_lanes: 1,
        };
        let start = [1.0, -0.3, 0.7, 2.0, 0.4, 0.9, 1.5];
        // Up to the complete range of the series, and after two flows.
        for (time_s, long_s) in [(1.3e-4, 0.0), (-1.3e-4, 0.0), (1e-9, 0.0), (1.3e-4, 0.004)] {
            let mut y = layout.pack(&start);
            let halves = [0.25, 0.75].map(|share| Flow::over(&block, &layout, share * long_s));
            Flow::generator(&block, &layout).carry(
                Portable::new(),
                &[&halves[0], &halves[1]],
                (time_s, 900.1),
                &mut y,
            );
            for (a, b) in layout
                .unpack(&y)
                .iter()
                .zip(block.flow(time_s + long_s, &start))
            {
                assert!((a - b).abs() < 4e-16 * 3.0, "{a} {b}");
            }
        }
    }

    #[test]
    fn the_series_ends_where_its_terms_no_longer_count() {
        let omitted = |size: f64, count: usize| {
            (1..=2 * count + 2).fold(1.0, |term, n| term * size / n as f64)
        };
        for size in [MAX_SERIES_ARGUMENT, 0.03, 1e-3] {
            let count = factors(size).len();
            assert!(
                omitted(size, count) <= NEGLIGIBLE_TERM
                    && omitted(size, count - 1) > NEGLIGIBLE_TERM,
                "{size}: {count}"
            );
        }
        assert_eq!(
            (factors(MAX_SERIES_ARGUMENT).len(), factors(0.0).len()),
            (MAX_SERIES_PAIRS, 0)
        );
    }
}
