//! Following blocks over a piece of the signals: the integrals of their states with each signal that
//! they follow.
//!
//! On a piece from `0` to `h`, with `y' = A y + B_0 + B_1 t + sum b f` (see [`super::local_blocks`]),
//!
//! ```text
//! X_0 = int y dt   = A^-1 ([y] - B_0 h - B_1 h^2 / 2 - sum b int f dt)
//! X_1 = int t y dt = A^-1 (h y(h) - X_0 - B_0 h^2 / 2 - B_1 h^3 / 3 - sum b int t f dt)
//! V_z = int (u_z + s_z t) y dt = u_z X_0 + s_z X_1
//! ```

use super::block_sums::{Blocks, Pairs, Reals, add, add_to_signals, columns, load, scaled};
use super::tables::ExcitationTables;
use jounce_model::plant::SignalSample;
use jounce_simd::{F64x8, Simd};

/// A piece of the signals.
pub(super) struct SignalPiece<'s> {
    pub tables: &'s ExcitationTables,
    /// Value and slope of each signal at its start.
    pub sizes: &'s [SignalSample],
    /// For each port, `int f dt` (N s) and `int t f dt` (N s^2) of its force.
    pub forces: &'s [[f64; 2]],
    pub length_s: f64,
}

impl SignalPiece<'_> {
    /// Adds `V` of each signal to its sum; the states at both ends have their forced part.
    #[inline(always)]
    pub fn close<W: Simd>(&self, w: W, [start, end]: [&[F64x8]; 2], sums: &mut [Vec<F64x8>]) {
        let inverse = &self.tables.inverse;
        let pairs = inverse.pair_lanes();
        for k in 0..pairs {
            let blocks = Pairs(inverse.entries(w, k));
            self.close_blocks(w, [k, pairs + k], blocks, [start, end], sums);
        }
        for k in 0..inverse.real_lanes() {
            let blocks = Reals(inverse.real_entries(w, k));
            self.close_blocks(w, [2 * pairs + k], blocks, [start, end], sums);
        }
    }

    /// Adds the integrals of the states in `lanes`; the blocks are those of `A^-1`.
    #[inline(always)]
    fn close_blocks<W: Simd, const N: usize>(
        &self,
        w: W,
        lanes: [usize; N],
        blocks: impl Blocks<W, N>,
        [start, end]: [&[F64x8]; 2],
        sums: &mut [Vec<F64x8>],
    ) {
        let h = self.length_s;
        let signals = self.tables.signals.iter().map(|signal| &signal.column);
        let [by_value, by_slope] = columns(w, lanes, signals, self.sizes);
        let (start, end) = (load(w, lanes, start), load(w, lanes, end));
        let none = [w.zero(); N];
        let mut change = add(w, end, scaled(w, -1.0, start, none));
        let mut moment = scaled(w, h, end, none);
        change = scaled(w, -h, by_value, scaled(w, -0.5 * h * h, by_slope, change));
        let third = -h * h * h / 3.0;
        moment = scaled(
            w,
            -0.5 * h * h,
            by_value,
            scaled(w, third, by_slope, moment),
        );
        for (force, [impulse, turning]) in self.tables.forces.iter().zip(self.forces) {
            if [*impulse, *turning] != [0.0; 2] {
                let force = load(w, lanes, force);
                change = scaled(w, -impulse, force, change);
                moment = scaled(w, -turning, force, moment);
            }
        }
        let first = blocks.apply(w, change);
        let second = blocks.apply(w, scaled(w, -1.0, first, moment));
        let follow = (self.tables.signals.iter()).map(|signal| &signal.is_following[lanes[0]]);
        add_to_signals(w, lanes, [first, second], (self.sizes, follow), sums);
    }
}
