//! One contact step, linearised.

use super::drift::driven;
use super::elimination::{NodeRows, eliminate};
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
    times_s: [f64; NODES],
    /// Velocity and acceleration of the port under the drive.
    driven: [[f64; 2]; NODES],
    slopes: [Slopes; NODES],
    /// Force at the end of the step, N.
    end_force_n: f64,
}

impl Linearisation<'_> {
    /// Passes one step in contact.
    #[inline(always)]
    pub(super) fn contact<W: Wide, L: ContactLaw>(
        &mut self,
        w: W,
        law: L,
        segment: &Segment,
        (shape, force): (Shape, [f64; NODES]),
        after: &[f64],
    ) {
        let kernel = self.kernel;
        let level = Kernel::level_within(segment.length_s);
        let odd;
        let table = if Kernel::length_s(level) == segment.length_s {
            kernel.table(0, shape, level)
        } else {
            odd = Table::new(kernel, 0, kernel.basis(0, shape), segment.length_s);
            &odd
        };
        let nodes = self.nodes(w, law, table, segment, shape, &force);
        let shift_s = if shape == Shape::Onset { self.onset_shift(w, segment) } else { None };
        let mut right = self.right_sides(w, table, &nodes, &force, L::RATE_DEPENDENT);
        if let Some(shift_s) = &shift_s {
            for i in 0..NODES {
                let ([speed, acceleration], slopes) = (nodes.driven[i], nodes.slopes[i]);
                add_scaled(w, &mut right[i], slopes.stiffness_n_m * speed + slopes.damping_n_s_m * acceleration, shift_s);
            }
        }
        eliminate(w, &mut matrix(table, &nodes.slopes), &mut right);
        self.flow_of(w, table);
        let layout = kernel.layout;
        for (state, row) in self.tangents.rows_mut().enumerate() {
            let (lane, place) = layout.place(state);
            for (push, right) in table.push[lane].iter().zip(&right) {
                add_scaled(w, row, push.0[place], right);
            }
        }
        if let Some(shift_s) = &shift_s {
            let (block, port) = (&kernel.plant.diagonal.block, &kernel.plant.ports[0]);
            let rate: Vec<f64> = block.apply(after).iter().zip(&port.force).map(|(rate, b)| rate + b * nodes.end_force_n).collect();
            self.tangents.add_product(w, &rate, -1.0, shift_s);
        }
    }

    /// Slopes of the law at the nodes of a step.
    #[inline(always)]
    fn nodes<W: Wide, L: ContactLaw>(
        &self,
        w: W,
        law: L,
        table: &Table,
        segment: &Segment,
        shape: Shape,
        force: &[f64; NODES],
    ) -> Nodes {
        let (kernel, layout) = (self.kernel, self.kernel.layout);
        let y = layout.pack(&segment.state);
        let force = Lane(std::array::from_fn(|i| force.get(i).copied().unwrap_or(0.0)));
        let free = columns(w, &layout, &y, &table.displacement.columns, w.splat(-kernel.plant.system.stops[0].gap_m));
        let depth = w.store(pushed(w, free, &table.displacement.push, &force));
        let free = columns(w, &layout, &y, &table.velocity.columns, w.zero());
        let rate = w.store(pushed(w, free, &table.velocity.push, &force));
        let times_s: [f64; WIDTH] = kernel.basis(0, shape).places.map(|x| segment.start_s + segment.length_s * x);
        let driven = times_s.map(|time_s| driven(&kernel.plant, time_s));
        let at = |i: usize| (depth.0[i] + driven[i][0], rate.0[i] + driven[i][1]);
        let slopes = std::array::from_fn(|i| match at(i) {
            (depth, rate) if depth > 0.0 => law.slopes(depth, rate),
            // Past the surface the force is zero whatever the state.
            _ => Slopes { stiffness_n_m: 0.0, damping_n_s_m: 0.0 },
        });
        let (depth, rate) = at(NODES);
        Nodes {
            times_s: std::array::from_fn(|i| times_s[i]),
            driven: std::array::from_fn(|i| [driven[i][1], driven[i][2]]),
            slopes,
            end_force_n: law.force_n(depth, rate),
        }
    }

    /// `J (C dy + dw) + J' (C' dy + dv) + F k`.
    #[inline(always)]
    fn right_sides<W: Wide>(&self, w: W, table: &Table, nodes: &Nodes, force: &[f64; NODES], rate_dependent: bool) -> NodeRows {
        let layout = self.kernel.layout;
        let mut right: NodeRows = std::array::from_fn(|_| self.tangents.blank());
        for (state, row) in self.tangents.rows().enumerate() {
            let column = layout.column(state);
            let (place, speed) = (&table.displacement.columns[column].0, &table.velocity.columns[column].0);
            for i in 0..NODES {
                let mut factor = nodes.slopes[i].stiffness_n_m * place[i];
                if rate_dependent {
                    factor += nodes.slopes[i].damping_n_s_m * speed[i];
                }
                add_scaled(w, &mut right[i], factor, row);
            }
        }
        for i in 0..NODES {
            let [dw, dv] = self.drift.of_port(&self.kernel.plant, nodes.times_s[i]);
            let own = nodes.slopes[i].stiffness_n_m * dw + nodes.slopes[i].damping_n_s_m * dv + self.drift.force_relative * force[i];
            self.tangents.drift(&mut right[i], own);
        }
        right
    }

    #[inline(always)]
    fn flow_of<W: Wide>(&mut self, w: W, table: &Table) {
        let layout = self.kernel.layout;
        (0..layout.pairs).for_each(|k| self.tangents.turn(w, k, table.flow.pair(k)));
        (0..layout.reals).for_each(|k| self.tangents.decay(w, 2 * layout.pairs + k, table.flow.real(k)));
    }
}

/// `I - J D - J' D'`.
#[inline(always)]
fn matrix(table: &Table, slopes: &[Slopes; NODES]) -> [[f64; NODES]; NODES] {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let (place, speed) = (table.displacement.push[j].0[i], table.velocity.push[j].0[i]);
            f64::from(u8::from(i == j)) - slopes[i].stiffness_n_m * place - slopes[i].damping_n_s_m * speed
        })
    })
}
