//! One contact step, linearised.

use super::drift::DrivenNodes;
use super::linearisation::Linearisation;
use super::tangents::add_scaled;
use crate::contact::{ContactLaw, Slopes};
use crate::march::basis::NODES;
use crate::march::kernel::{Kernel, Shape};
use crate::march::state::{columns, pushed};
use crate::march::table::Table;
use crate::march::trajectory::Segment;
use crate::wide::{Lane, WIDTH, Wide};

/// The law along a step.
struct Nodes {
    driven: DrivenNodes,
    /// `J` and `J'` at the nodes, last place 0.
    stiffness_n_m: Lane,
    damping_n_s_m: Lane,
    /// Force at the nodes and at the end of the step, N.
    force_n: Lane,
}

impl Linearisation<'_> {
    /// Passes one step in contact; `after` is the state at its end.
    #[inline(always)]
    pub(super) fn contact<W: Wide, L: ContactLaw>(&mut self, w: W, law: L, segment: &Segment, force: (Shape, [f64; NODES]), after: &[f64]) {
        let (kernel, shape) = (self.kernel, force.0);
        let level = Kernel::level_within(segment.length_s);
        let odd;
        let (table, level) = if Kernel::length_s(level) == segment.length_s {
            (kernel.table(0, shape, level), Some(level))
        } else {
            odd = Table::new(kernel, 0, kernel.basis(0, shape), segment.length_s);
            (&odd, None)
        };
        let driven = self.driven(w, (shape, level), segment);
        let nodes = self.nodes(w, law, table, segment, driven, force.1);
        let shift_s = if shape == Shape::Onset { self.onset_shift(w, segment) } else { None };
        self.right_sides::<W, L>(w, table, &nodes);
        let (stiffness, damping, driven) = (w.load(&nodes.stiffness_n_m), w.load(&nodes.damping_n_s_m), &nodes.driven);
        let by_force = w.mul(w.splat(self.drift.force_relative), w.load(&nodes.force_n));
        let moved = w.fma(stiffness, w.load(&driven.penetration_drift_m), by_force);
        let own = w.store(w.fma(damping, w.load(&driven.rate_drift_m_s), moved));
        let passed = w.fma(stiffness, w.load(&driven.velocity_m_s), w.mul(damping, w.load(&driven.acceleration_m_s2)));
        let passed = w.store(passed);
        for i in 0..NODES {
            let right = self.system.right(i);
            self.tangents.drift(right, own.0[i]);
            if let Some(shift_s) = &shift_s {
                add_scaled(w, right, passed.0[i], shift_s);
            }
            *self.system.matrix(i) = row(table, i, nodes.stiffness_n_m.0[i], nodes.damping_n_s_m.0[i]);
        }
        self.system.solve(w);
        self.advance(w, table);
        if let Some(shift_s) = &shift_s {
            let (block, port) = (&kernel.plant.diagonal.block, &kernel.plant.ports[0]);
            let end_n = nodes.force_n.0[NODES];
            let rate: Vec<f64> = block.apply(after).iter().zip(&port.force).map(|(rate, b)| rate + b * end_n).collect();
            self.tangents.add_product(w, &rate, -1.0, shift_s);
        }
    }

    /// The law at the nodes of a step.
    #[inline(always)]
    fn nodes<W: Wide, L: ContactLaw>(
        &mut self,
        w: W,
        law: L,
        table: &Table,
        segment: &Segment,
        driven: DrivenNodes,
        force: [f64; NODES],
    ) -> Nodes {
        let (kernel, layout) = (self.kernel, self.kernel.layout);
        layout.pack_into(&segment.state, &mut self.packed);
        let mut force_n = Lane::ZERO;
        force_n.0[..NODES].copy_from_slice(&force);
        let start = w.sub(w.load(&driven.displacement_m), w.splat(kernel.plant.system.stops[0].gap_m));
        let free = columns(w, &layout, &self.packed, &table.displacement.columns, start);
        let depth = w.store(pushed(w, free, &table.displacement.push, &force_n));
        let mut rate = Lane::ZERO;
        if L::RATE_DEPENDENT {
            let free = columns(w, &layout, &self.packed, &table.velocity.columns, w.load(&driven.velocity_m_s));
            rate = w.store(pushed(w, free, &table.velocity.push, &force_n));
        }
        let mut nodes = Nodes { driven, stiffness_n_m: Lane::ZERO, damping_n_s_m: Lane::ZERO, force_n };
        for i in 0..NODES {
            // Past the surface the force is zero whatever the state.
            if L::BOTH_SIDES || depth.0[i] > 0.0 {
                let Slopes { stiffness_n_m, damping_n_s_m } = law.slopes(depth.0[i], rate.0[i]);
                (nodes.stiffness_n_m.0[i], nodes.damping_n_s_m.0[i]) = (stiffness_n_m, damping_n_s_m);
            }
        }
        nodes.force_n.0[NODES] = law.force_n(depth.0[NODES], rate.0[NODES]);
        nodes
    }

    /// `J C dy + J' C' dy`.
    #[inline(always)]
    fn right_sides<W: Wide, L: ContactLaw>(&mut self, w: W, table: &Table, nodes: &Nodes) {
        let layout = self.kernel.layout;
        let (stiffness, damping) = (w.load(&nodes.stiffness_n_m), w.load(&nodes.damping_n_s_m));
        for (state, factor) in self.factors.iter_mut().enumerate() {
            let column = layout.column(state);
            let mut sum = w.mul(stiffness, w.load(&table.displacement.columns[column]));
            if L::RATE_DEPENDENT {
                sum = w.fma(damping, w.load(&table.velocity.columns[column]), sum);
            }
            *factor = w.store(sum);
        }
        for (lane, group) in self.tangents.groups().enumerate() {
            let mut sums = [w.zero(); NODES];
            for (factor, value) in self.factors.iter().zip(group) {
                let value = w.load(value);
                for (sum, factor) in sums.iter_mut().zip(&factor.0) {
                    *sum = w.fma(w.splat(*factor), value, *sum);
                }
            }
            for (i, sum) in sums.into_iter().enumerate() {
                self.system.right(i)[lane] = w.store(sum);
            }
        }
    }

    /// `dy = e^{A h} dy + B X`.
    #[inline(always)]
    fn advance<W: Wide>(&mut self, w: W, table: &Table) {
        let layout = self.kernel.layout;
        for (lane, group) in self.tangents.groups_mut().enumerate() {
            let solution = self.system.column(w, lane);
            let (paired, reals) = group.split_at_mut(2 * layout.pairs);
            for (k, pair) in paired.chunks_exact_mut(2).enumerate() {
                let ([a, b, c, d], place) = (table.flow.pair(k), k % WIDTH);
                let (push_u, push_v) = (&table.push[k / WIDTH], &table.push[layout.pair_lanes + k / WIDTH]);
                let (u, v) = (w.load(&pair[0]), w.load(&pair[1]));
                let mut next_u = w.fma(w.splat(a), u, w.mul(w.splat(b), v));
                let mut next_v = w.fma(w.splat(c), u, w.mul(w.splat(d), v));
                for ((by_u, by_v), x) in push_u.iter().zip(push_v).zip(solution) {
                    next_u = w.fma(w.splat(by_u.0[place]), x, next_u);
                    next_v = w.fma(w.splat(by_v.0[place]), x, next_v);
                }
                (pair[0], pair[1]) = (w.store(next_u), w.store(next_v));
            }
            for (k, row) in reals.iter_mut().enumerate() {
                let (push, place) = (&table.push[2 * layout.pair_lanes + k / WIDTH], k % WIDTH);
                let mut next = w.mul(w.splat(table.flow.real(k)), w.load(row));
                for (by, x) in push.iter().zip(solution) {
                    next = w.fma(w.splat(by.0[place]), x, next);
                }
                *row = w.store(next);
            }
        }
    }
}

/// A row of `I - J D - J' D'`.
#[inline(always)]
fn row(table: &Table, i: usize, stiffness_n_m: f64, damping_n_s_m: f64) -> Lane {
    let mut row = Lane::ZERO;
    for j in 0..NODES {
        row.0[j] = -stiffness_n_m * table.displacement.push[j].0[i] - damping_n_s_m * table.velocity.push[j].0[i];
    }
    row.0[i] += 1.0;
    row
}
