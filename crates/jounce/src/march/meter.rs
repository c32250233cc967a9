//! What the contact force of a step does to an energy meter.

use super::basis::NODES;
use super::layout::Layout;
use super::response::Response;
use super::state::pushed_by;
use crate::wide::{Lane, Wide};

/// `integral f (row . y) dt` over a step, for the state `y` at its start and the nodal forces `f`.
#[derive(Debug, Clone)]
pub struct Meter {
    /// Share of the free motion: lanes of the state per unit nodal force.
    free: Vec<[Lane; NODES]>,
    /// Share of the force itself, one lane per force node.
    push: [Lane; NODES],
}

impl Meter {
    /// Of a row integrated over the step against each function of the basis.
    pub fn new(layout: &Layout, integrated: &Response) -> Self {
        let mut free = vec![[Lane::ZERO; NODES]; layout.lanes()];
        for state in 0..layout.states() {
            let (lane, place) = layout.place(state);
            let column = &integrated.columns[layout.column(state)];
            (0..NODES).for_each(|j| free[lane][j].0[place] = column.0[j]);
        }
        Self { free, push: integrated.push }
    }

    /// The integral; `force` in a lane, its last place 0, and spread.
    #[inline(always)]
    pub fn read<W: Wide>(&self, w: W, y: &[Lane], force: &Lane, spread: &[W::Register; NODES]) -> f64 {
        let mut sum = w.mul(pushed_by(w, w.zero(), &self.push, spread), w.load(force));
        for (y, free) in y.iter().zip(&self.free) {
            sum = w.fma(pushed_by(w, w.zero(), free, spread), w.load(y), sum);
        }
        w.sum(sum)
    }
}
