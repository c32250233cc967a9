//! Basic products of the integration.

use super::layout::StateLayout;
use crate::force_response::basis::NODES;
use jounce_simd::{F64x8, LANES, Simd};

/// Returns `start + sum_k columns_k y_k`: an output at eight instants.
#[inline(always)]
pub fn columns<W: Simd>(
    w: W,
    layout: &StateLayout,
    y: &[F64x8],
    columns: &[F64x8],
    start: W::Register,
) -> W::Register {
    let (p, n) = (layout.pair_lanes, layout.pairs);
    let (of_u, rest) = columns.split_at(n);
    let (of_v, of_r) = rest.split_at(n);
    let u = weighted(w, &y[..p], of_u, start);
    let v = weighted(w, &y[p..2 * p], of_v, w.zero());
    weighted(w, &y[2 * p..], of_r, w.add(u, v))
}

/// Returns `start + sum_k columns_k y_k` over contiguous states.
#[inline(always)]
fn weighted<W: Simd>(w: W, y: &[F64x8], columns: &[F64x8], start: W::Register) -> W::Register {
    // Two sums in parallel, so that no addition waits for the previous one.
    let (mut even, mut odd) = (start, w.zero());
    for (lane, columns) in y.iter().zip(columns.chunks(LANES)) {
        if let Ok(columns) = <&[F64x8; LANES]>::try_from(columns) {
            for i in 0..LANES / 2 {
                even = w.fma(w.splat(lane.0[2 * i]), w.load(&columns[2 * i]), even);
                odd = w.fma(w.splat(lane.0[2 * i + 1]), w.load(&columns[2 * i + 1]), odd);
            }
        } else {
            for (value, column) in lane.0.iter().zip(columns) {
                even = w.fma(w.splat(*value), w.load(column), even);
            }
        }
    }
    w.add(even, odd)
}

/// Broadcasts each nodal force to all lanes of a register.
#[inline(always)]
pub fn spread<W: Simd>(w: W, force: &F64x8) -> [W::Register; NODES] {
    let mut spread = [w.zero(); NODES];
    for (everywhere, force) in spread.iter_mut().zip(&force.0) {
        *everywhere = w.splat(*force);
    }
    spread
}

/// Returns `start + sum_j push_j f_j`.
#[inline(always)]
pub fn add_force_response<W: Simd>(
    w: W,
    start: W::Register,
    push: &[F64x8; NODES],
    force: &F64x8,
) -> W::Register {
    add_spread_response(w, start, push, &spread(w, force))
}

/// Returns `start + sum_j push_j f_j` for broadcast forces that are used more than once.
#[inline(always)]
pub fn add_spread_response<W: Simd>(
    w: W,
    start: W::Register,
    push: &[F64x8; NODES],
    force: &[W::Register; NODES],
) -> W::Register {
    let (mut even, mut odd) = (start, w.zero());
    for i in 0..NODES / 2 {
        even = w.fma(force[2 * i], w.load(&push[2 * i]), even);
        odd = w.fma(force[2 * i + 1], w.load(&push[2 * i + 1]), odd);
    }
    even = w.fma(force[NODES - 1], w.load(&push[NODES - 1]), even);
    w.add(even, odd)
}

/// Returns row times state, both padded.
#[inline(always)]
pub fn dot<W: Simd>(w: W, row: &[F64x8], y: &[F64x8]) -> f64 {
    let mut sum = w.zero();
    for (row, y) in row.iter().zip(y) {
        sum = w.fma(w.load(row), w.load(y), sum);
    }
    w.sum(sum)
}

/// Returns row times magnitudes of a state, both padded.
#[inline(always)]
pub fn dot_abs<W: Simd>(w: W, row: &[F64x8], y: &[F64x8]) -> f64 {
    let mut sum = w.zero();
    for (row, y) in row.iter().zip(y) {
        sum = w.fma(w.load(row), w.abs(w.load(y)), sum);
    }
    w.sum(sum)
}

/// Returns magnitudes of a row times magnitudes of a state, both padded.
#[inline(always)]
pub fn dot_of_magnitudes<W: Simd>(w: W, row: &[F64x8], y: &[F64x8]) -> f64 {
    let mut sum = w.zero();
    for (row, y) in row.iter().zip(y) {
        sum = w.fma(w.abs(w.load(row)), w.abs(w.load(y)), sum);
    }
    w.sum(sum)
}
