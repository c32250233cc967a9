//! The rows and bounds that prove a flight step free of contact (see [`super::certificate`]).

use super::kernel::{Kernel, Layout};
use super::lane::Lane;
use crate::plant::Pair;

/// What a flight step evaluates at its end: displacement and velocity of the port, in full and of the slow blocks alone.
#[derive(Debug, Clone)]
pub struct FlightTable {
    /// One lane per state in column order: `[w, w', w_slow, w'_slow, 0, ..]`.
    pub columns: Vec<Lane>,
    /// Factor per state (padded layout) of the bound on the fourth derivative of the slow part.
    pub slow_fourth: Vec<Lane>,
    /// Factor per state (padded layout) of the bound on the fast part itself.
    pub fast_bound: Vec<Lane>,
    /// True where some block is fast at this length.
    pub has_fast: bool,
}

/// `|lambda| h` above which a block counts as fast: where its own size is a better bound than its Hermite remainder.
const FAST: f64 = 4.4;

impl FlightTable {
    /// For steps of one length.
    pub(super) fn new(kernel: &Kernel, layout: &Layout, displacement: &[f64], velocity: &[f64], h: f64) -> Self {
        let block = &kernel.plant.diagonal.block;
        let n = block.len();
        let (mut fourth, mut bound, mut slow) = (vec![0.0; n], vec![0.0; n], vec![true; n]);
        for (k, pair) in block.pairs.iter().enumerate() {
            let row = [displacement[2 * k], displacement[2 * k + 1]];
            let (gain, speed) = Kernel::fourth_derivative(pair, row, h);
            let is_slow = speed * h < FAST || matches!(pair, Pair::Jordan { .. });
            for s in 0..2 {
                slow[2 * k + s] = is_slow;
                if is_slow {
                    fourth[2 * k + s] = gain[s];
                } else {
                    bound[2 * k + s] = row[0].hypot(row[1]);
                }
            }
        }
        let first = 2 * block.pairs.len();
        for (k, rate) in block.reals.iter().enumerate() {
            slow[first + k] = rate.abs() * h < FAST;
            let gain = displacement[first + k].abs();
            if slow[first + k] {
                fourth[first + k] = gain * rate.powi(4);
            } else {
                bound[first + k] = gain;
            }
        }
        let columns = (layout.column_order().into_iter())
            .map(|s| {
                let (w, v) = (displacement[s], velocity[s]);
                let kept = if slow[s] { 1.0 } else { 0.0 };
                Lane([w, v, kept * w, kept * v, 0.0, 0.0, 0.0, 0.0])
            })
            .collect();
        FlightTable { columns, slow_fourth: layout.pack(&fourth), fast_bound: layout.pack(&bound), has_fast: slow.contains(&false) }
    }
}
