//! Local blocks over a step: their motion under the signals to which they are local, and the integrals
//! of their complete motion with each of these signals.
//!
//! With `B_0 = sum_z b_z u_z` and `B_1 = sum_z b_z s_z` of signals `u_z + s_z t`, the derivatives at
//! the start of a step are
//!
//! ```text
//! z_0 = y(0),   z_1 = A z_0 + B_0,   z_2 = A z_1 + B_1,   z_(j+1) = A z_j
//! ```
//!
//! and the Taylor series integrates to
//!
//! ```text
//! X_0 = int y dt = sum_j z_j h^(j+1) / (j+1)!,   X_1 = int t y dt = sum_j z_j (j+1) h^(j+2) / (j+2)!
//! V_z = int (u_z + s_z t) y dt = u_z X_0 + s_z X_1
//! ```
//!
//! with `B_0` and `B_1` of the signals to which a block is local. Under the others it follows, and they
//! add `int P dt` and `int t P dt` of its `P = c_0 + c_1 t`, with `c_0 = sum_z rest_z u_z + lag_z s_z`
//! and `c_1 = sum_z rest_z s_z`, to `X_0` and `X_1`.
//!
//! The motion `P` from rest under the local signals follows from its own `X_0` and the differential
//! equation: `P = A X_0 + B_0 h + B_1 h^2 / 2`. An impulse `p` at the time `t`, with `r = h - t`, adds
//! `A^j b p r^(j+1) / (j+1)!` to the terms of `X_0`, and `A^j b p (t r^(j+1) / (j+1)! + (j+1) r^(j+2) /
//! (j+2)!)` to those of `X_1`.

use super::block_sums::{Blocks, Pairs, Reals, add, add_to_signals, columns, load, scaled};
use super::tables::ExcitationTables;
use super::taylor_weights::TaylorWeights;
use crate::flow::Flow;
use jounce_model::plant::SignalSample;
use jounce_simd::{F64x8, LANES, Simd};

/// Forces at the nodes of a contact step: port, times and impulses.
pub(super) type NodalForces = (usize, [f64; LANES], F64x8);

/// A step of the local blocks.
pub(super) struct LocalStep<'s> {
    pub tables: &'s ExcitationTables,
    /// Largest `|eigenvalue|` of the blocks that are local to a signal that is not 0, rad/s.
    pub fastest_rad_s: f64,
    pub generator: &'s Flow,
    /// Value and slope of each signal at the start of the step.
    pub sizes: &'s [SignalSample],
    /// Contact forces on the step.
    pub nodes: &'s [NodalForces],
    pub length_s: f64,
}

/// `X_0` and `X_1` of a vector of blocks with `N` states each.
type Integrals<R, const N: usize> = [[R; N]; 2];

impl LocalStep<'_> {
    /// Adds `P` to the state at the end of the step, and then `V` of each signal to its sum.
    #[inline(always)]
    pub fn pass<W: Simd>(&self, w: W, start: &[F64x8], y: &mut [F64x8], sums: &mut [Vec<F64x8>]) {
        if self.sizes.iter().all(|size| *size == [0.0; 2]) {
            return;
        }
        let weights = TaylorWeights::of(self.fastest_rad_s, self.length_s);
        let pairs = self.generator.pair_lanes();
        for vector in &self.tables.local {
            let (k, driven) = (vector.index, vector.driven(self.sizes));
            if driven == F64x8::ZERO {
                continue;
            }
            let local = (vector.is_local.as_slice(), w.load(&driven));
            if k < pairs {
                let blocks = Pairs(self.generator.entries(w, k));
                let lanes = [k, pairs + k];
                self.pass_blocks(w, &weights, (lanes, local), blocks, (start, y, sums));
            } else {
                let blocks = Reals(self.generator.real_entries(w, k - pairs));
                let lanes = [pairs + k];
                self.pass_blocks(w, &weights, (lanes, local), blocks, (start, y, sums));
            }
        }
    }

    /// Passes a vector of blocks with states in `lanes`; `is_local` is 1 in those that are local to
    /// each signal, `driven` in those that are local to one that is not 0.
    #[inline(always)]
    fn pass_blocks<W: Simd, const N: usize>(
        &self,
        w: W,
        weights: &TaylorWeights,
        (lanes, (is_local, driven)): ([usize; N], (&[F64x8], W::Register)),
        blocks: impl Blocks<W, N>,
        (start, y, sums): (&[F64x8], &mut [F64x8], &mut [Vec<F64x8>]),
    ) {
        let length = w.splat(self.length_s);
        let half = w.splat(0.5 * self.length_s);
        let signals = self.tables.signals.iter().map(|signal| &signal.local);
        let [by_value, by_slope] = columns(w, lanes, signals, self.sizes);
        let at_start = lanes.map(|lane| w.mul(driven, w.load(&start[lane])));
        let free = free_integrals(w, weights.terms(), at_start, blocks);
        let first = blocks.apply(w, by_value);
        let second = add(w, first, by_slope);
        // The series of the signals begins with `z_1 = B_0` and `z_2 = A B_0 + B_1`.
        let terms = weights.terms();
        let forced = free_integrals(w, &terms[2..], second, blocks);
        let forced = [0, 1].map(|m| scaled(w, terms[1][m], by_value, forced[m]));
        let motion = blocks.apply(w, forced[0]);
        for (i, lane) in lanes.into_iter().enumerate() {
            let by_signals = w.fma(length, w.fma(half, by_slope[i], by_value[i]), motion[i]);
            y[lane] = w.store(w.add(w.load(&y[lane]), by_signals));
        }
        let following = self.following_integrals(w, lanes, driven);
        let mut all = [0, 1].map(|m| add(w, add(w, free[m], forced[m]), following[m]));
        for (port, times_s, impulses) in self.nodes {
            let force = load(w, lanes, &self.tables.forces[*port]).map(|b| w.mul(driven, b));
            let weights = TaylorWeights::of_impulses(self.length_s, times_s, &impulses.0);
            let forced = free_integrals(w, &weights[..terms.len()], force, blocks);
            all = [0, 1].map(|m| add(w, all[m], forced[m]));
        }
        add_to_signals(w, lanes, all, (self.sizes, is_local.iter()), sums);
    }

    /// Returns `int P dt` and `int t P dt` of the motion that follows signals, in the driven blocks.
    #[inline(always)]
    fn following_integrals<W: Simd, const N: usize>(
        &self,
        w: W,
        lanes: [usize; N],
        driven: W::Register,
    ) -> Integrals<W::Register, N> {
        let none = [w.zero(); N];
        let mut coefficients = [none; 2];
        for (signal, [value, slope]) in self.tables.signals.iter().zip(self.sizes) {
            let [rest, lag] = [&signal.rest, &signal.lag]
                .map(|column| load(w, lanes, column).map(|c| w.mul(driven, c)));
            let by_slope = scaled(w, *slope, lag, coefficients[0]);
            coefficients[0] = scaled(w, *value, rest, by_slope);
            coefficients[1] = scaled(w, *slope, rest, coefficients[1]);
        }
        let h = self.length_s;
        let integral = |[by_value, by_slope]: [f64; 2]| {
            scaled(
                w,
                by_value,
                coefficients[0],
                scaled(w, by_slope, coefficients[1], none),
            )
        };
        [[h, 0.5 * h * h], [0.5 * h * h, h * h * h / 3.0]].map(integral)
    }
}

/// Returns `sum_j weights_j A^j state`.
#[inline(always)]
fn free_integrals<W: Simd, const N: usize>(
    w: W,
    weights: &[[f64; 2]],
    mut state: [W::Register; N],
    blocks: impl Blocks<W, N>,
) -> Integrals<W::Register, N> {
    let mut sums = [[w.zero(); N]; 2];
    for [first, second] in weights {
        sums[0] = scaled(w, *first, state, sums[0]);
        sums[1] = scaled(w, *second, state, sums[1]);
        state = blocks.apply(w, state);
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::excitation::tables::{LocalVector, SignalColumns};
    use crate::flow::layout::StateLayout;
    use jounce_model::plant::{BlockDiagonal, BlockPair};
    use jounce_simd::Portable;

    const START: [f64; 6] = [0.3, -0.2, 0.5, 0.1, -0.7, 0.4];
    const COLUMNS: [[f64; 6]; 2] = [
        [1.0, -0.4, 0.3, 0.8, 0.5, -1.2],
        [0.2, 0.9, -0.6, 0.1, 1.1, 0.7],
    ];
    const FORCE: [f64; 6] = [-0.5, 0.3, 0.8, -0.1, 0.2, 0.6];
    const SIZES: [SignalSample; 2] = [[0.7, -300.0], [-1.1, 200.0]];
    const LENGTH_S: f64 = 1e-3;
    const IMPULSE: f64 = 0.02;

    fn block() -> BlockDiagonal {
        let oscillates = BlockPair::Oscillatory {
            decay: -3.0,
            frequency: 180.0,
        };
        BlockDiagonal {
            pairs: vec![oscillates, BlockPair::FreeBody { rate: -40.0 }],
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

    const LAYOUT: StateLayout = StateLayout {
        pairs: 2,
        reals: 2,
        pair_lanes: 1,
        real_lanes: 1,
    };

    /// Tables of two signals; `is_local` are the states that are local to each.
    fn tables(block: &BlockDiagonal, is_local: &[[bool; 6]; 2]) -> ExcitationTables {
        let indicator = |states: [bool; 6]| LAYOUT.pack(&states.map(|is| f64::from(u8::from(is))));
        let signal = |(column, is_local): (&[f64; 6], &[bool; 6])| {
            let rest: Vec<f64> = block.solve(column, is_local).iter().map(|x| -x).collect();
            let local: [f64; 6] =
                std::array::from_fn(|i| if is_local[i] { column[i] } else { 0.0 });
            SignalColumns {
                column: LAYOUT.pack(column),
                lag: LAYOUT.pack(&block.solve(&rest, is_local)),
                rest: LAYOUT.pack(&rest),
                local: LAYOUT.pack(&local),
                is_following: indicator(is_local.map(|is| !is)),
            }
        };
        let vector = |(index, lane): (usize, usize)| LocalVector {
            index,
            is_local: is_local.map(|states| indicator(states)[lane]).to_vec(),
        };
        ExcitationTables {
            signals: COLUMNS.iter().zip(is_local).map(signal).collect(),
            local: [(0, 0), (1, 2)].map(vector).into(),
            forces: vec![LAYOUT.pack(&FORCE)],
            ..ExcitationTables::default()
        }
    }

    /// Returns the part of the state that follows signals, a time after the start of the step.
    fn following(tables: &ExcitationTables, after_s: f64) -> Vec<f64> {
        let mut state = vec![F64x8::ZERO; LAYOUT.lanes()];
        for (signal, [value, slope]) in tables.signals.iter().zip(SIZES) {
            for (state, (rest, lag)) in state.iter_mut().zip(signal.rest.iter().zip(&signal.lag)) {
                let by_value = state.add_scaled(value + slope * after_s, rest);
                *state = by_value.add_scaled(slope, lag);
            }
        }
        LAYOUT.unpack(&state)
    }

    /// Comparison with a Runge-Kutta solution, with an impulse in the middle of the step.
    fn check_step(is_local: &[[bool; 6]; 2]) {
        let block = block();
        let mut wanted = [START.to_vec(), vec![0.0; 6], vec![0.0; 6]];
        integrate(&block, 0.0, &mut wanted);
        (wanted[0].iter_mut().zip(FORCE)).for_each(|(y, b)| *y += IMPULSE * b);
        integrate(&block, 0.5 * LENGTH_S, &mut wanted);

        let tables = tables(&block, is_local);
        let start = following(&tables, 0.0);
        let start: Vec<f64> = START.iter().zip(start).map(|(y, part)| y - part).collect();
        let pushed = block.flow(0.5 * LENGTH_S, &FORCE.map(|b| IMPULSE * b));
        let free = block.flow(LENGTH_S, &start);
        let sum: Vec<f64> = free.iter().zip(pushed).map(|(y, more)| y + more).collect();
        let mut y = LAYOUT.pack(&sum);
        let mut sums = vec![vec![F64x8::ZERO; LAYOUT.lanes()]; 2];
        let mut weighted = F64x8::ZERO;
        weighted.0[3] = IMPULSE;
        let step = LocalStep {
            tables: &tables,
            fastest_rad_s: 180.1,
            generator: &Flow::generator(&block, &LAYOUT),
            sizes: &SIZES,
            nodes: &[(0, [0.5 * LENGTH_S; LANES], weighted)],
            length_s: LENGTH_S,
        };
        step.pass(Portable::new(), &LAYOUT.pack(&start), &mut y, &mut sums);
        let at_end = LAYOUT.unpack(&y);
        let scale = at_end.iter().fold(1.0_f64, |max, y| max.max(y.abs()));
        for (i, part) in following(&tables, LENGTH_S).iter().enumerate() {
            let error = (at_end[i] + part - wanted[0][i]).abs();
            assert!(error < 1e-12 * (scale + part.abs()), "{i}: {error}");
        }
        for ((sum, wanted), is_local) in sums.iter().zip(&wanted[1..]).zip(is_local) {
            for (i, sum) in LAYOUT.unpack(sum).into_iter().enumerate() {
                // Following blocks add their integrals once per piece.
                let wanted = if is_local[i] { wanted[i] } else { 0.0 };
                let error = (sum - wanted).abs();
                assert!(error <= 1e-12 * wanted.abs(), "{i}: {sum} {wanted}");
            }
        }
    }

    #[test]
    fn a_step_is_that_of_the_differential_equation() {
        check_step(&[[true; 6]; 2]);
    }

    /// The oscillating block and the decaying one follow the second signal.
    #[test]
    fn a_block_that_is_local_to_one_signal_may_follow_another() {
        check_step(&[[true; 6], [false, false, true, true, false, true]]);
    }
}
