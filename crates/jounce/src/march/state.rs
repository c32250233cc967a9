//! The few products that marching is made of.

use super::basis::NODES;
use super::layout::Layout;
use crate::wide::{Lane, WIDTH, Wide};

/// `start + sum_k columns_k y_k`: an output at eight instants.
#[inline(always)]
pub fn columns<W: Wide>(w: W, layout: &Layout, y: &[Lane], columns: &[Lane], start: W::Register) -> W::Register {
    let (p, n) = (layout.pair_lanes, layout.pairs);
    let (of_u, rest) = columns.split_at(n);
    let (of_v, of_r) = rest.split_at(n);
    let u = weighted(w, &y[..p], of_u, start);
    let v = weighted(w, &y[p..2 * p], of_v, w.zero());
    weighted(w, &y[2 * p..], of_r, w.add(u, v))
}

/// `start + sum_k columns_k y_k` over states that lie side by side.
#[inline(always)]
fn weighted<W: Wide>(w: W, y: &[Lane], columns: &[Lane], start: W::Register) -> W::Register {
    // Two sums side by side, so that no addition waits for the one before it.
    let (mut even, mut odd) = (start, w.zero());
    for (lane, columns) in y.iter().zip(columns.chunks(WIDTH)) {
        if let Ok(columns) = <&[Lane; WIDTH]>::try_from(columns) {
            for i in 0..WIDTH / 2 {
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

/// Nodal forces, each in all places of a register.
#[inline(always)]
pub fn spread<W: Wide>(w: W, force: &Lane) -> [W::Register; NODES] {
    let mut spread = [w.zero(); NODES];
    for (everywhere, force) in spread.iter_mut().zip(&force.0) {
        *everywhere = w.splat(*force);
    }
    spread
}

/// `start + sum_j push_j f_j`.
#[inline(always)]
pub fn pushed<W: Wide>(w: W, start: W::Register, push: &[Lane; NODES], force: &Lane) -> W::Register {
    pushed_by(w, start, push, &spread(w, force))
}

/// The same for forces that push more than once.
#[inline(always)]
pub fn pushed_by<W: Wide>(w: W, start: W::Register, push: &[Lane; NODES], force: &[W::Register; NODES]) -> W::Register {
    let (mut even, mut odd) = (start, w.zero());
    for i in 0..NODES / 2 {
        even = w.fma(force[2 * i], w.load(&push[2 * i]), even);
        odd = w.fma(force[2 * i + 1], w.load(&push[2 * i + 1]), odd);
    }
    even = w.fma(force[NODES - 1], w.load(&push[NODES - 1]), even);
    w.add(even, odd)
}

/// Row times state, both padded.
#[inline(always)]
pub fn dot<W: Wide>(w: W, row: &[Lane], y: &[Lane]) -> f64 {
    let mut sum = w.zero();
    for (row, y) in row.iter().zip(y) {
        sum = w.fma(w.load(row), w.load(y), sum);
    }
    w.sum(sum)
}

/// Row times magnitudes of a state, both padded.
#[inline(always)]
pub fn dot_abs<W: Wide>(w: W, row: &[Lane], y: &[Lane]) -> f64 {
    let mut sum = w.zero();
    for (row, y) in row.iter().zip(y) {
        sum = w.fma(w.load(row), w.abs(w.load(y)), sum);
    }
    w.sum(sum)
}

/// Magnitudes of a row times those of a state, both padded.
#[inline(always)]
pub fn dot_of_magnitudes<W: Wide>(w: W, row: &[Lane], y: &[Lane]) -> f64 {
    let mut sum = w.zero();
    for (row, y) in row.iter().zip(y) {
        sum = w.fma(w.abs(w.load(row)), w.abs(w.load(y)), sum);
    }
    w.sum(sum)
}
