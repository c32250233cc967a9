//! Row or column of the state with its crossed form.
//!
//! Every block of a flow has the form `e^{A t} = a I + b N` with a constant `N`
//! ([`BlockPair::crossing`](jounce_model::plant::BlockPair::crossing)); `b = 0` for a single rate.
//! So for a row `r` and a column `c` of a pair
//!
//! ```text
//! r e^{A t} y = a r y + b (r N) y,
//! e^{A t} c   = a c   + b N c:
//! ```
//!
//! the effect of a force on the state, and of the motion on any meter of its work, are both
//! integrals of `a` and `b`.

use super::layout::StateLayout;
use jounce_model::plant::BlockDiagonal;
use jounce_simd::{F64x8, LANES, Simd};

/// Row or column in the form of the module.
#[derive(Debug, Clone)]
pub struct FlowRow {
    /// Per vector of pairs: factors of `a`, for `u` and for `v`, then factors of `b`.
    pub pairs: Vec<[F64x8; 4]>,
    /// Single rates.
    pub reals: Vec<F64x8>,
}

impl FlowRow {
    /// Converts a row in block coordinates.
    pub fn row(layout: &StateLayout, block: &BlockDiagonal, row: &[f64]) -> Self {
        Self::new(layout, block, row, |[a, b, c, d], [u, v]| {
            [u * a + v * c, u * b + v * d]
        })
    }

    /// Converts a column in block coordinates.
    pub fn column(layout: &StateLayout, block: &BlockDiagonal, column: &[f64]) -> Self {
        Self::new(layout, block, column, |[a, b, c, d], [u, v]| {
            [a * u + b * v, c * u + d * v]
        })
    }

    fn new(
        layout: &StateLayout,
        block: &BlockDiagonal,
        values: &[f64],
        cross: impl Fn([f64; 4], [f64; 2]) -> [f64; 2],
    ) -> Self {
        let mut pairs = vec![[F64x8::ZERO; 4]; layout.pair_lanes];
        let (paired, reals) = values.split_at(2 * layout.pairs);
        for ((k, pair), uv) in block.pairs.iter().enumerate().zip(paired.chunks_exact(2)) {
            let ([straight_u, straight_v], [crossed_u, crossed_v]) =
                ([uv[0], uv[1]], cross(pair.crossing(), [uv[0], uv[1]]));
            for (lane, value) in pairs[k / LANES]
                .iter_mut()
                .zip([straight_u, straight_v, crossed_u, crossed_v])
            {
                lane.0[k % LANES] = value;
            }
        }
        let mut lanes = vec![F64x8::ZERO; layout.real_lanes];
        reals
            .iter()
            .enumerate()
            .for_each(|(k, real)| lanes[k / LANES].0[k % LANES] = *real);
        Self {
            pairs,
            reals: lanes,
        }
    }

    /// Reads a state whose blocks have moved by integrals of `a`, of `b`, and of single rates,
    /// vector by vector. The lanes of the returned register are not yet summed.
    #[inline(always)]
    pub fn read<W: Simd>(&self, w: W, integrals: &[F64x8], y: &[F64x8]) -> W::Register {
        let p = self.pairs.len();
        let (mut straight, mut crossed) = (w.zero(), w.zero());
        for (k, [along_u, along_v, across_u, across_v]) in self.pairs.iter().enumerate() {
            let (u, v) = (w.load(&y[k]), w.load(&y[p + k]));
            let along = w.fma(w.load(along_u), u, w.mul(w.load(along_v), v));
            let across = w.fma(w.load(across_u), u, w.mul(w.load(across_v), v));
            straight = w.fma(w.load(&integrals[k]), along, straight);
            crossed = w.fma(w.load(&integrals[p + k]), across, crossed);
        }
        for (k, row) in self.reals.iter().enumerate() {
            straight = w.fma(
                w.load(&integrals[2 * p + k]),
                w.mul(w.load(row), w.load(&y[2 * p + k])),
                straight,
            );
        }
        w.add(straight, crossed)
    }
}
