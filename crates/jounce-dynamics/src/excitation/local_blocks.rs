//! Local blocks over a step: their motion under the signals, and its integrals with each signal.
//!
//! With `B_0 = sum_z b_z u_z` and `B_1 = sum_z b_z s_z` of signals `u_z + s_z t`, and `U_k` the
//! `k`-th integral of a signal from the start of the step,
//!
//! ```text
//! P = sum_j A^(j-1) (B_0 h^j / j! + B_1 h^(j+1) / (j+1)!)
//! V = sum_k (-A)^k (U_(k+1)(h) y(h) - B_0 int U_(k+1) dt - B_1 int U_(k+1) t dt - b int U_(k+1) f dt)
//! ```
//!
//! Both sums are evaluated from their last term, each vector of blocks in registers.

use super::repeated_integrals::{orders, powers, repeated, repeated_products};
use super::tables::LocalTables;
use crate::flow::Flow;
use jounce_model::plant::{LOCAL_TERMS, SignalSample};
use jounce_simd::{F64x8, LANES, Simd};
use smallvec::SmallVec;

/// Forces at the nodes of a contact step: port, times and impulses.
pub(super) type NodalForces = (usize, [f64; LANES], F64x8);

/// Weights of the terms of `V` for one signal: of `y(h)`, `B_0`, `B_1`.
type Weights = [[f64; 3]; LOCAL_TERMS];

/// A step of the local blocks.
pub(super) struct LocalStep<'s> {
    pub tables: &'s LocalTables,
    pub generator: &'s Flow,
    /// Value and slope of each signal at the start of the step.
    pub sizes: &'s [SignalSample],
    /// Contact forces on the step.
    pub nodes: &'s [NodalForces],
    pub length_s: f64,
}

/// A vector of blocks: their rates, and which states it holds.
struct Blocks<R> {
    rates: [R; 4],
    /// Vectors of `u` and of `v`; equal for single rates, whose `v` is not used.
    lanes: [usize; 2],
    is_pair: bool,
}

impl LocalStep<'_> {
    /// Adds `P` to the state at the end of the step, and then `V` of each signal to its sum.
    #[inline(always)]
    pub fn pass<W: Simd>(&self, w: W, y: &mut [F64x8], sums: &mut [Vec<F64x8>]) {
        let orders = orders(self.tables.fastest_rad_s * self.length_s);
        let powers = powers(self.length_s);
        let weights: SmallVec<[(usize, Weights); 2]> = (self.sizes.iter().enumerate())
            .filter(|(_, size)| **size != [0.0; 2])
            .map(|(signal, size)| {
                let mut weights = [[0.0; 3]; LOCAL_TERMS];
                for (k, weights) in weights.iter_mut().enumerate().take(orders) {
                    *weights = repeated_products(*size, &powers, k + 1, self.length_s);
                }
                (signal, weights)
            })
            .collect();
        if weights.is_empty() {
            return;
        }
        for (blocks, is_local) in self.blocks(w) {
            let columns = blocks.lanes.map(|lane| self.columns(w, lane));
            let mut at_end = blocks.lanes.map(|lane| w.load(&y[lane]));
            let motion = self.motion(w, &blocks, columns, &powers[..orders + 2]);
            let count = if blocks.is_pair { 2 } else { 1 };
            for i in 0..count {
                at_end[i] = w.add(at_end[i], motion[i]);
                y[blocks.lanes[i]] = w.store(at_end[i]);
                at_end[i] = w.mul(at_end[i], is_local);
            }
            for (signal, weights) in &weights {
                let weights = &weights[..orders];
                let mut sum = integral(w, &blocks, (at_end, columns), weights);
                if !self.nodes.is_empty() {
                    let forced = self.forced_integral(w, &blocks, (*signal, orders));
                    sum = [0, 1].map(|i| w.sub(sum[i], forced[i]));
                }
                for i in 0..count {
                    let out = &mut sums[*signal][blocks.lanes[i]];
                    *out = w.store(w.add(w.load(out), sum[i]));
                }
            }
        }
    }

    /// Iterates over the vectors with local blocks; the second value is 1 for each local one.
    #[inline(always)]
    fn blocks<W: Simd>(&self, w: W) -> impl Iterator<Item = (Blocks<W::Register>, W::Register)> {
        let pairs = self.generator.pair_lanes();
        self.tables.vectors.iter().map(move |(k, is_local)| {
            let is_pair = *k < pairs;
            let (rates, lanes) = if is_pair {
                (self.generator.entries(w, *k), [*k, pairs + *k])
            } else {
                let rate = self.generator.real_entries(w, *k - pairs);
                ([rate, w.zero(), w.zero(), w.zero()], [pairs + *k; 2])
            };
            let blocks = Blocks {
                rates,
                lanes,
                is_pair,
            };
            (blocks, w.load(is_local))
        })
    }

    /// Returns `B_0` and `B_1` in a vector of states.
    #[inline(always)]
    fn columns<W: Simd>(&self, w: W, lane: usize) -> [W::Register; 2] {
        let mut sums = [w.zero(); 2];
        for (column, size) in self.tables.columns.iter().zip(self.sizes) {
            let column = w.load(&column[lane]);
            sums = [0, 1].map(|i| w.fma(w.splat(size[i]), column, sums[i]));
        }
        sums
    }

    /// Returns `P`.
    #[inline(always)]
    fn motion<W: Simd>(
        &self,
        w: W,
        blocks: &Blocks<W::Register>,
        columns: [[W::Register; 2]; 2],
        powers: &[f64],
    ) -> [W::Register; 2] {
        let mut sum = [w.zero(); 2];
        for pair in powers[1..].windows(2).rev() {
            let (by_value, by_slope) = (w.splat(pair[0]), w.splat(pair[1]));
            let next = blocks.apply(w, sum);
            sum = [0, 1].map(|i| {
                let [value, slope] = columns[i];
                w.fma(by_value, value, w.fma(by_slope, slope, next[i]))
            });
        }
        sum
    }

    /// Returns `sum_k (-A)^k b int U_(k+1) f dt` of the contact forces.
    #[inline(always)]
    fn forced_integral<W: Simd>(
        &self,
        w: W,
        blocks: &Blocks<W::Register>,
        (signal, orders): (usize, usize),
    ) -> [W::Register; 2] {
        let mut sum = [w.zero(); 2];
        for order in (1..=orders).rev() {
            let next = blocks.apply(w, sum);
            sum = next.map(|next| w.sub(w.zero(), next));
            for (port, times_s, weighted) in self.nodes {
                let weighted_force: f64 = (times_s.iter().zip(weighted.0))
                    .map(|(t, force)| force * repeated(self.sizes[signal], order, *t))
                    .sum();
                let force = &self.tables.forces[*port];
                sum = [0, 1].map(|i| {
                    let column = w.load(&force[blocks.lanes[i]]);
                    w.fma(w.splat(weighted_force), column, sum[i])
                });
            }
        }
        sum
    }
}

impl<R: Copy> Blocks<R> {
    /// Returns `A x`.
    #[inline(always)]
    fn apply<W: Simd<Register = R>>(&self, w: W, [u, v]: [R; 2]) -> [R; 2] {
        let [a, b, c, d] = self.rates;
        if self.is_pair {
            [w.fma(a, u, w.mul(b, v)), w.fma(c, u, w.mul(d, v))]
        } else {
            [w.mul(a, u), v]
        }
    }
}

/// Returns `V` without contact forces.
#[inline(always)]
fn integral<W: Simd>(
    w: W,
    blocks: &Blocks<W::Register>,
    (at_end, columns): ([W::Register; 2], [[W::Register; 2]; 2]),
    weights: &[[f64; 3]],
) -> [W::Register; 2] {
    let mut sum = [w.zero(); 2];
    for weights in weights.iter().rev() {
        let [end, value, slope] = weights.map(|weight| w.splat(weight));
        let next = blocks.apply(w, sum);
        sum = [0, 1].map(|i| {
            let [by_value, by_slope] = columns[i];
            let taken = w.fma(value, by_value, w.fma(slope, by_slope, next[i]));
            w.sub(w.mul(end, at_end[i]), taken)
        });
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flow::layout::StateLayout;
    use jounce_model::plant::{BlockDiagonal, BlockPair, NEGLIGIBLE_TERM};
    use jounce_simd::Portable;

    const START: [f64; 6] = [0.3, -0.2, 0.5, 0.1, -0.7, 0.4];
    const COLUMNS: [[f64; 6]; 2] = [
        [1.0, -0.4, 0.3, 0.8, 0.5, -1.2],
        [0.2, 0.9, -0.6, 0.1, 1.1, 0.7],
    ];
    const FORCE: [f64; 6] = [-0.5, 0.3, 0.8, -0.1, 0.2, 0.6];
    const SIZES: [SignalSample; 2] = [[0.7, -300.0], [-1.1, 0.0]];
    const LENGTH_S: f64 = 1e-3;
    const IMPULSE: f64 = 0.02;

    fn block() -> BlockDiagonal {
        let oscillates = BlockPair::Oscillatory {
            decay: -3.0,
            frequency: 180.0,
        };
        BlockDiagonal {
            pairs: vec![oscillates, BlockPair::Jordan { rate: -40.0 }],
            reals: vec![-2.0, 0.0],
        }
    }

    /// Integrates state and `int u_k y dt` over half of the step with 1000 steps of the classical
    /// Runge-Kutta method.
    fn integrate(block: &BlockDiagonal, from_s: f64, state: &mut [Vec<f64>; 3]) {
        let h = 0.5 * LENGTH_S / 1000.0;
        let rate = |t: f64, y: &[f64]| -> [Vec<f64>; 3] {
            let signals = SIZES.map(|[u, s]| u + s * t);
            let mut rate = block.apply(y);
            for (column, u) in COLUMNS.iter().zip(signals) {
                rate.iter_mut().zip(column).for_each(|(r, b)| *r += b * u);
            }
            let products = signals.map(|u| y.iter().map(|y| u * y).collect());
            let [first, second] = products;
            [rate, first, second]
        };
        let shifted = |y: &[f64], rate: &[f64], by: f64| -> Vec<f64> {
            y.iter().zip(rate).map(|(y, rate)| y + by * rate).collect()
        };
        for k in 0..1000 {
            let t = from_s + h * f64::from(k);
            let y = state[0].clone();
            let one = rate(t, &y);
            let two = rate(t + 0.5 * h, &shifted(&y, &one[0], 0.5 * h));
            let three = rate(t + 0.5 * h, &shifted(&y, &two[0], 0.5 * h));
            let four = rate(t + h, &shifted(&y, &three[0], h));
            for (part, state) in state.iter_mut().enumerate() {
                for (i, x) in state.iter_mut().enumerate() {
                    let middle = two[part][i] + three[part][i];
                    *x += h / 6.0 * (one[part][i] + 2.0 * middle + four[part][i]);
                }
            }
        }
    }

    /// Comparison with a Runge-Kutta solution, with an impulse in the middle of the step.
    #[test]
    fn a_step_is_that_of_the_differential_equation() {
        let block = block();
        let mut wanted = [START.to_vec(), vec![0.0; 6], vec![0.0; 6]];
        integrate(&block, 0.0, &mut wanted);
        (wanted[0].iter_mut().zip(FORCE)).for_each(|(y, b)| *y += IMPULSE * b);
        integrate(&block, 0.5 * LENGTH_S, &mut wanted);

        let layout = StateLayout {
            pairs: 2,
            reals: 2,
            pair_lanes: 1,
            real_lanes: 1,
        };
        let pushed = block.flow(0.5 * LENGTH_S, &FORCE.map(|b| IMPULSE * b));
        let free = block.flow(LENGTH_S, &START);
        let sum: Vec<f64> = free.iter().zip(pushed).map(|(y, more)| y + more).collect();
        let mut y = layout.pack(&sum);
        let mut sums = vec![vec![F64x8::ZERO; layout.lanes()]; 2];
        let tables = LocalTables {
            vectors: vec![(0, F64x8([1.0; LANES])), (1, F64x8([1.0; LANES]))],
            columns: COLUMNS.map(|column| layout.pack(&column)).to_vec(),
            forces: vec![layout.pack(&FORCE)],
            fastest_rad_s: 180.1,
        };
        let mut weighted = F64x8::ZERO;
        weighted.0[3] = IMPULSE;
        let step = LocalStep {
            tables: &tables,
            generator: &Flow::generator(&block, &layout),
            sizes: &SIZES,
            nodes: &[(0, [0.5 * LENGTH_S; LANES], weighted)],
            length_s: LENGTH_S,
        };
        step.pass(Portable::new(), &mut y, &mut sums);
        for (computed, wanted) in [&y, &sums[0], &sums[1]].into_iter().zip(&wanted) {
            for (a, b) in layout.unpack(computed).iter().zip(wanted) {
                assert!((a - b).abs() < 1e-12 * b.abs(), "{a} {b}");
            }
        }
    }

    #[test]
    fn the_sums_end_where_their_terms_no_longer_count() {
        let omitted = |size: f64, orders: usize| {
            let factorial: f64 = (1..=orders + 1).map(|n| n as f64).product();
            2.0 * orders as f64 * size.powi(orders as i32 - 1) / factorial
        };
        for size in [0.5, 0.2, 1e-3] {
            let count = orders(size);
            assert!(
                omitted(size, count) <= NEGLIGIBLE_TERM
                    && omitted(size, count - 1) > NEGLIGIBLE_TERM,
                "{size}: {count}"
            );
        }
        assert_eq!(orders(0.0), 2);
        assert!(orders(0.5) <= LOCAL_TERMS);
    }
}
