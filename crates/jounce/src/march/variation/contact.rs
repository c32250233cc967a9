//! One contact step, linearised.

use super::drift::Driven;
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
    driven: [Driven; WIDTH],
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
        let table = if Kernel::length_s(level) == segment.length_s {
            kernel.table(0, shape, level)
        } else {
            odd = Table::new(kernel, 0, kernel.basis(0, shape), segment.length_s);
            &odd
        };
        let nodes = self.nodes(w, law, table, segment, force);
        let shift_s = if shape == Shape::Onset { self.onset_shift(w, segment) } else { None };
        self.right_sides::<W, L>(w, table, &nodes);
        for i in 0..NODES {
            let (driven, right) = (&nodes.driven[i], self.system.right(i));
            let (stiffness, damping) = (nodes.stiffness_n_m.0[i], nodes.damping_n_s_m.0[i]);
            let by_force = self.drift.force_relative * nodes.force_n.0[i];
            let own = stiffness * driven.penetration_drift_m + damping * driven.rate_drift_m_s + by_force;
            self.tangents.drift(right, own);
            if let Some(shift_s) = &shift_s {
                add_scaled(w, right, stiffness * driven.velocity_m_s + damping * driven.acceleration_m_s2, shift_s);
            }
            *self.system.matrix(i) = row(table, i, stiffness, damping);
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
        &self,
        w: W,
        law: L,
        table: &Table,
        segment: &Segment,
        (shape, force): (Shape, [f64; NODES]),
    ) -> Nodes {
        let (kernel, layout) = (self.kernel, self.kernel.layout);
        let y = layout.pack(&segment.state);
        let mut force_n = Lane::ZERO;
        force_n.0[..NODES].copy_from_slice(&force);
        let free = columns(w, &layout, &y, &table.displacement.columns, w.splat(-kernel.plant.system.stops[0].gap_m));
        let depth = w.store(pushed(w, free, &table.displacement.push, &force_n));
        let free = columns(w, &layout, &y, &table.velocity.columns, w.zero());
        let rate = w.store(pushed(w, free, &table.velocity.push, &force_n));
        let mut nodes = Nodes { driven: [Driven::default(); WIDTH], stiffness_n_m: Lane::ZERO, damping_n_s_m: Lane::ZERO, force_n };
        for (i, place) in kernel.basis(0, shape).places.into_iter().enumerate() {
            let driven = self.drift.driven(&kernel.plant, segment.start_s + segment.length_s * place);
            let (depth, rate) = (depth.0[i] + driven.displacement_m, rate.0[i] + driven.velocity_m_s);
            nodes.driven[i] = driven;
            if i == NODES {
                nodes.force_n.0[i] = law.force_n(depth, rate);
            } else if L::BOTH_SIDES || depth > 0.0 {
                // Past the surface the force is zero whatever the state.
                let Slopes { stiffness_n_m, damping_n_s_m } = law.slopes(depth, rate);
                (nodes.stiffness_n_m.0[i], nodes.damping_n_s_m.0[i]) = (stiffness_n_m, damping_n_s_m);
            }
        }
        nodes
    }

    /// `J C dy + J' C' dy`.
    #[inline(always)]
    fn right_sides<W: Wide, L: ContactLaw>(&mut self, w: W, table: &Table, nodes: &Nodes) {
        let (layout, width) = (self.kernel.layout, self.tangents.width);
        let (stiffness, damping) = (w.load(&nodes.stiffness_n_m), w.load(&nodes.damping_n_s_m));
        for (state, factor) in self.factors.iter_mut().enumerate() {
            let column = layout.column(state);
            let mut sum = w.mul(stiffness, w.load(&table.displacement.columns[column]));
            if L::RATE_DEPENDENT {
                sum = w.fma(damping, w.load(&table.velocity.columns[column]), sum);
            }
            *factor = w.store(sum);
        }
        for lane in 0..width {
            let mut sums = [w.zero(); NODES];
            for (factor, row) in self.factors.iter().zip(self.tangents.lanes.chunks_exact(width)) {
                let value = w.load(&row[lane]);
                for (sum, factor) in sums.iter_mut().zip(factor.0) {
                    *sum = w.fma(w.splat(factor), value, *sum);
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
        let (layout, width) = (self.kernel.layout, self.tangents.width);
        for k in 0..layout.pairs {
            self.tangents.turn(w, k, table.flow.pair(k));
        }
        for k in 0..layout.reals {
            self.tangents.decay(w, 2 * layout.pairs + k, table.flow.real(k));
        }
        for lane in 0..width {
            let solution = self.system.column(w, lane);
            for (state, row) in self.tangents.lanes.chunks_exact_mut(width).enumerate() {
                let (at, place) = layout.place(state);
                let mut sum = w.load(&row[lane]);
                for (push, x) in table.push[at].iter().zip(solution) {
                    sum = w.fma(w.splat(push.0[place]), x, sum);
                }
                row[lane] = w.store(sum);
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
