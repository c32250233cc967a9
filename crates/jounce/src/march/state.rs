//! The padded state and the few products that marching is made of.

use super::collocation::NODES;
use super::kernel::Layout;
use super::lane::{Lane, WIDTH, fma};
use super::table::Table;

/// `sum_k columns_k y_k`: several outputs of a state at once.
#[inline(always)]
pub fn columns<const FMA: bool>(layout: &Layout, y: &[Lane], columns: &[Lane]) -> Lane {
    let (p, n) = (layout.pair_lanes, layout.pairs);
    let (u, v, r) = (&y[..p], &y[p..2 * p], &y[2 * p..]);
    // Four sums side by side, so that no addition waits for the one before it.
    let mut sums = [Lane::ZERO; 4];
    for k in 0..n {
        let even = 2 * (k & 1);
        sums[even] = sums[even].add_scaled::<FMA>(u[k / WIDTH].0[k % WIDTH], &columns[k]);
        sums[even + 1] = sums[even + 1].add_scaled::<FMA>(v[k / WIDTH].0[k % WIDTH], &columns[n + k]);
    }
    for k in 0..layout.reals {
        sums[0] = sums[0].add_scaled::<FMA>(r[k / WIDTH].0[k % WIDTH], &columns[2 * n + k]);
    }
    sums[0].add(&sums[1]).add(&sums[2].add(&sums[3]))
}

/// `sum_j push_j f_j`.
#[inline(always)]
pub fn pushed<const FMA: bool>(start: Lane, push: &[Lane; NODES], force: &Lane) -> Lane {
    let (mut even, mut odd) = (start, Lane::ZERO);
    for (j, push) in push.iter().enumerate() {
        if j % 2 == 0 {
            even = even.add_scaled::<FMA>(force.0[j], push);
        } else {
            odd = odd.add_scaled::<FMA>(force.0[j], push);
        }
    }
    even.add(&odd)
}

/// Row times state, both padded.
#[inline(always)]
pub fn dot<const FMA: bool>(row: &[Lane], y: &[Lane]) -> f64 {
    let mut sum = Lane::ZERO;
    for (row, y) in row.iter().zip(y) {
        sum = sum.add_product::<FMA>(row, y);
    }
    sum.sum()
}

/// Row times magnitudes of a state, both padded.
#[inline(always)]
pub fn dot_abs<const FMA: bool>(row: &[Lane], y: &[Lane]) -> f64 {
    let mut sum = Lane::ZERO;
    for (row, y) in row.iter().zip(y) {
        sum = sum.add_product::<FMA>(row, &y.map(f64::abs));
    }
    sum.sum()
}

/// Exact flow over the length of a table.
#[inline(always)]
pub fn flow<const FMA: bool>(layout: &Layout, y: &[Lane], table: &Table, out: &mut [Lane]) {
    let p = layout.pair_lanes;
    let [a, b, c, d] = &table.pair_flow;
    for k in 0..p {
        for i in 0..WIDTH {
            let (u, v) = (y[k].0[i], y[p + k].0[i]);
            out[k].0[i] = fma::<FMA>(a[k].0[i], u, b[k].0[i] * v);
            out[p + k].0[i] = fma::<FMA>(c[k].0[i], u, d[k].0[i] * v);
        }
    }
    for k in 0..layout.real_lanes {
        for i in 0..WIDTH {
            out[2 * p + k].0[i] = table.real_flow[k].0[i] * y[2 * p + k].0[i];
        }
    }
}

/// Adds the effect of the nodal forces at the end of a step.
#[inline(always)]
pub fn add_push<const FMA: bool>(table: &Table, force: &Lane, out: &mut [Lane]) {
    for (k, out) in out.iter_mut().enumerate() {
        let (mut even, mut odd) = (*out, Lane::ZERO);
        for j in 0..NODES {
            if j % 2 == 0 {
                even = even.add_scaled::<FMA>(force.0[j], &table.push[j][k]);
            } else {
                odd = odd.add_scaled::<FMA>(force.0[j], &table.push[j][k]);
            }
        }
        *out = even.add(&odd);
    }
}
