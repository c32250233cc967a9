//! Layout of a state in SIMD vectors.

use jounce_model::plant::Plant;
use jounce_simd::{F64x8, LANES};

/// `u` of all pairs, then `v` of all pairs, then the reals, each padded to complete vectors.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StateLayout {
    /// Number of pairs.
    pub pairs: usize,
    /// Number of reals.
    pub reals: usize,
    /// Vectors of `u` (and of `v`).
    pub pair_lanes: usize,
    /// Vectors of the reals.
    pub real_lanes: usize,
}

impl StateLayout {
    /// Returns the layout of a plant.
    pub fn of(plant: &Plant) -> Self {
        let block = &plant.diagonal.block;
        let (pairs, reals) = (block.pairs.len(), block.reals.len());
        Self {
            pairs,
            reals,
            pair_lanes: pairs.div_ceil(LANES),
            real_lanes: reals.div_ceil(LANES),
        }
    }

    /// Returns the number of states.
    pub fn states(&self) -> usize {
        2 * self.pairs + self.reals
    }

    /// Returns the number of vectors of a state.
    pub fn lanes(&self) -> usize {
        2 * self.pair_lanes + self.real_lanes
    }

    /// Returns vector and lane of state number `state` in block order `u0, v0, u1, ...`.
    pub fn locate(&self, state: usize) -> (usize, usize) {
        let (base, index) = match state.checked_sub(2 * self.pairs) {
            Some(real) => (2 * self.pair_lanes, real),
            None => ((state % 2) * self.pair_lanes, state / 2),
        };
        (base + index / LANES, index % LANES)
    }

    /// Converts block order to padded vectors.
    pub fn pack(&self, values: &[f64]) -> Vec<F64x8> {
        let mut lanes = vec![F64x8::ZERO; self.lanes()];
        self.pack_into(values, &mut lanes);
        lanes
    }

    /// Converts block order into vectors whose padding is already zero.
    #[inline(always)]
    pub fn pack_into(&self, values: &[f64], lanes: &mut [F64x8]) {
        let (paired, reals) = values.split_at(2 * self.pairs);
        for (k, pair) in paired.chunks_exact(2).enumerate() {
            lanes[k / LANES].0[k % LANES] = pair[0];
            lanes[self.pair_lanes + k / LANES].0[k % LANES] = pair[1];
        }
        for (k, real) in reals.iter().enumerate() {
            lanes[2 * self.pair_lanes + k / LANES].0[k % LANES] = *real;
        }
    }

    /// Converts padded vectors to block order.
    pub fn unpack(&self, lanes: &[F64x8]) -> Vec<f64> {
        let mut values = vec![0.0; self.states()];
        self.unpack_into(lanes, &mut values);
        values
    }

    /// Converts padded vectors into values in block order.
    pub fn unpack_into(&self, lanes: &[F64x8], values: &mut [f64]) {
        let (u, rest) = lanes.split_at(self.pair_lanes);
        let (v, reals) = rest.split_at(self.pair_lanes);
        let (paired, single) = values.split_at_mut(2 * self.pairs);
        for ((values, u), v) in paired.chunks_mut(2 * LANES).zip(u).zip(v) {
            for (pair, (u, v)) in values.chunks_exact_mut(2).zip(u.0.iter().zip(v.0)) {
                (pair[0], pair[1]) = (*u, v);
            }
        }
        for (values, lane) in single.chunks_mut(LANES).zip(reals) {
            values.copy_from_slice(&lane.0[..values.len()]);
        }
    }

    /// Returns the position of a state in column order `u0, u1, .., v0, v1, .., r0, ..`, in which
    /// states meet their columns.
    pub fn column(&self, state: usize) -> usize {
        if state < 2 * self.pairs {
            (state % 2) * self.pairs + state / 2
        } else {
            state
        }
    }
}
