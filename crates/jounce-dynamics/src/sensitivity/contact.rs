//! Linearised contact step for all ports in contact at once.

use super::elimination::NodeSystem;
use super::parameter_sensitivity::DrivenNodeMotion;
use super::parameters::NodeLaws;
use super::tangents::{NODES_PER_PASS, add_scaled, sums};
use super::variational_integration::VariationalIntegration;
use crate::flow::state::{add_force_response, columns};
use crate::force_response::basis::NODES;
use crate::kernel::{ForceBasis, Kernel};
use crate::record::trajectory::TrajectorySegment;
use crate::tables::joint::{JointTables, StepLength};
use jounce_model::contact::{ContactLaw, Slopes};
use jounce_simd::{F64x8, LANES, Simd};

/// Law of a port along a step.
struct LawNodes {
    driven: DrivenNodeMotion,
    /// `J` and `J'` at the nodes, last lane 0.
    stiffness_n_m: F64x8,
    damping_n_s_m: F64x8,
    /// Force at the nodes and at the end of the step, N.
    force_n: F64x8,
    /// Penetration (m) and rate (m/s) there.
    depth_m: F64x8,
    rate_m_s: F64x8,
}

impl LawNodes {
    /// Returns the law at the nodes for the parameters of a port in contact, by its index.
    fn at(&self, kernel: &Kernel, (port, shape): (usize, ForceBasis), index: usize) -> NodeLaws {
        NodeLaws {
            port,
            index,
            positions: kernel.basis(port, shape).positions,
            slopes: [self.stiffness_n_m, self.damping_n_s_m],
            depth: self.depth_m,
            rate: self.rate_m_s,
        }
    }
}

impl VariationalIntegration<'_, '_> {
    /// Passes one step in contact; `after` is the state at its end.
    #[inline(always)]
    pub(super) fn contact<W: Simd>(&mut self, w: W, segment: &TrajectorySegment, after: &[f64]) {
        let kernel = self.kernel;
        let ports: Vec<(usize, ForceBasis)> = segment
            .forces
            .iter()
            .map(|force| (force.port, force.shape))
            .collect();
        let level = Kernel::level_within(segment.length_s);
        let odd;
        let tables = if Kernel::length_s(level) == segment.length_s {
            kernel.tables(level)
        } else {
            odd = self
                .odd_tables
                .of(kernel, segment.conduction_state, segment.length_s);
            &odd
        };
        let tables = JointTables::new(kernel, &ports, StepLength { tables, level });
        if self.system.ports() != ports.len() {
            self.system = NodeSystem::new(ports.len(), self.tangents.width);
        }
        kernel.layout.pack_into(&segment.state, &mut self.packed);
        let mut nodes: Vec<LawNodes> = Vec::with_capacity(ports.len());
        for index in 0..ports.len() {
            nodes.push(self.nodes(w, &tables, segment, index));
        }
        // Contacts that start at the same instant share the shift of the first: see the limits of the module.
        let entering = ports.iter().find(|(_, shape)| *shape == ForceBasis::Onset);
        let shift_s = entering.and_then(|(port, _)| self.onset_shift(w, segment, *port));
        self.solve(w, &tables, segment, &nodes, shift_s.as_deref());
        if let Some(shift_s) = &shift_s {
            let rate = self.rate(segment.start_s + segment.length_s, after, &segment.forces);
            self.tangents.add_product(w, &rate, -1.0, shift_s);
        }
    }

    /// Solves the equations of the nodes, and advances the tangents.
    #[inline(always)]
    fn solve<W: Simd>(
        &mut self,
        w: W,
        tables: &JointTables,
        segment: &TrajectorySegment,
        nodes: &[LawNodes],
        shift_s: Option<&[F64x8]>,
    ) {
        let kernel = self.kernel;
        let mut parameters = self.parameters.take();
        let mut step = None;
        if let Some(parameters) = &mut parameters {
            // Out of line: the code without parameters stays small enough to be inlined.
            step = Some(w.out_of_line(
                #[inline(always)]
                || parameters.step(w, kernel, segment),
            ));
        }
        for (index, node_laws) in nodes.iter().enumerate() {
            self.right_sides(w, tables, index, node_laws);
            let port = tables.ports[index].0;
            self.rows(w, tables, (index, port), node_laws, shift_s);
            if let Some((parameters, step)) = parameters.as_ref().zip(step.as_ref()) {
                let laws = node_laws.at(kernel, tables.ports[index], index);
                let plant = &kernel.plant;
                let system = &mut self.system;
                w.out_of_line(
                    #[inline(always)]
                    || parameters.add_right_sides(w, plant, segment, step, &laws, system),
                );
            }
        }
        self.system.solve(w);
        if let Some((parameters, step)) = parameters.as_mut().zip(step.as_ref()) {
            let system = Some(&mut self.system);
            parameters.add_outputs(kernel, segment, step, &self.tangents, system, shift_s);
        }
        self.advance(w, tables);
        if let Some((parameters, step)) = parameters.as_ref().zip(step.as_ref()) {
            parameters.add_end(step, &mut self.tangents);
        }
        self.parameters = parameters;
    }

    /// Sets the equations of the nodes of one port, given by its index.
    #[inline(always)]
    fn rows<W: Simd>(
        &mut self,
        w: W,
        tables: &JointTables,
        (index, port): (usize, usize),
        nodes: &LawNodes,
        shift_s: Option<&[F64x8]>,
    ) {
        let (stiffness, damping, driven) = (
            w.load(&nodes.stiffness_n_m),
            w.load(&nodes.damping_n_s_m),
            &nodes.driven,
        );
        let force_relative = self.drift.force_relative_of(port);
        let by_force = w.mul(w.splat(force_relative), w.load(&nodes.force_n));
        let by_penetration = w.fma(stiffness, w.load(&driven.penetration_drift_m), by_force);
        let right_sides = w.store(w.fma(damping, w.load(&driven.rate_drift_m_s), by_penetration));
        let by_time = w.fma(
            stiffness,
            w.load(&driven.velocity_m_s),
            w.mul(damping, w.load(&driven.acceleration_m_s2)),
        );
        let by_time = w.store(by_time);
        for i in 0..NODES {
            let right = self.system.right(index * NODES + i);
            self.tangents.drift(right, right_sides.0[i]);
            if let Some(shift_s) = shift_s {
                add_scaled(w, right, by_time.0[i], shift_s);
            }
            for from in 0..tables.ports.len() {
                let mut row = row(
                    tables.responses(from, index),
                    i,
                    nodes.stiffness_n_m.0[i],
                    nodes.damping_n_s_m.0[i],
                );
                row.0[i] += if from == index { 1.0 } else { 0.0 };
                *self.system.matrix(index * NODES + i, from) = row;
            }
        }
    }

    /// Evaluates the law at the nodes of a step of one port.
    #[inline(always)]
    fn nodes<W: Simd>(
        &mut self,
        w: W,
        tables: &JointTables,
        segment: &TrajectorySegment,
        index: usize,
    ) -> LawNodes {
        let (kernel, layout) = (self.kernel, self.kernel.layout);
        let port = tables.ports[index].0;
        let (law, table) = (self.law(port), tables.table(index));
        let driven = self.driven(w, tables.ports[index], tables.length, segment);
        let [prescribed, prescribed_rate] =
            self.forced_motion(tables.ports[index], segment.length_s);
        let driven_m = w.add(w.load(&driven.displacement_m), w.load(&prescribed));
        let start = w.sub(driven_m, w.splat(kernel.plant.system.stops[port].gap_m));
        let mut depth = columns(w, &layout, &self.packed, &table.displacement.columns, start);
        let mut rate = w.zero();
        if law.is_rate_dependent() {
            rate = columns(
                w,
                &layout,
                &self.packed,
                &table.velocity.columns,
                w.add(w.load(&driven.velocity_m_s), w.load(&prescribed_rate)),
            );
        }
        let mut force_n = F64x8::ZERO;
        for (from, force) in segment.forces.iter().enumerate() {
            let mut nodal_n = F64x8::ZERO;
            nodal_n.0[..NODES].copy_from_slice(&force.nodal_n);
            let [displacement, velocity] = tables.responses(from, index);
            depth = add_force_response(w, depth, displacement, &nodal_n);
            if law.is_rate_dependent() {
                rate = add_force_response(w, rate, velocity, &nodal_n);
            }
            force_n = if from == index { nodal_n } else { force_n };
        }
        let (depth, rate) = (w.store(depth), w.store(rate));
        let mut nodes = LawNodes {
            driven,
            stiffness_n_m: F64x8::ZERO,
            damping_n_s_m: F64x8::ZERO,
            force_n,
            depth_m: depth,
            rate_m_s: rate,
        };
        for i in 0..NODES {
            // Past the surface the force is zero for every state.
            if law.acts_on_both_sides() || depth.0[i] > 0.0 {
                let Slopes {
                    stiffness_n_m,
                    damping_n_s_m,
                } = law.slopes(depth.0[i], rate.0[i]);
                (nodes.stiffness_n_m.0[i], nodes.damping_n_s_m.0[i]) =
                    (stiffness_n_m, damping_n_s_m);
            }
        }
        nodes
    }

    /// Returns displacement (m) and velocity (m/s) under constant signals at the nodes and the end
    /// of a step. They depend on the time from its start, so that a shift of that start does not
    /// change them.
    #[inline(always)]
    fn forced_motion(&self, (port, shape): (usize, ForceBasis), length_s: f64) -> [F64x8; 2] {
        let mut motion = [F64x8::ZERO; 2];
        let Some(series) = self.forced.get(port) else {
            return motion;
        };
        for (i, position) in self.kernel.basis(port, shape).positions.iter().enumerate() {
            [motion[0].0[i], motion[1].0[i]] = series.motion(position * length_s);
        }
        motion
    }

    /// Adds `J C dy + J' C' dy` of one port.
    #[inline(always)]
    fn right_sides<W: Simd>(&mut self, w: W, tables: &JointTables, index: usize, nodes: &LawNodes) {
        let layout = self.kernel.layout;
        let (table, needs_rate) = (
            tables.table(index),
            self.law(tables.ports[index].0).is_rate_dependent(),
        );
        let (stiffness, damping) = (w.load(&nodes.stiffness_n_m), w.load(&nodes.damping_n_s_m));
        for (state, factor) in self.factors.iter_mut().enumerate() {
            let column = layout.column(state);
            let mut sum = w.mul(stiffness, w.load(&table.displacement.columns[column]));
            if needs_rate {
                sum = w.fma(damping, w.load(&table.velocity.columns[column]), sum);
            }
            *factor = w.store(sum);
        }
        for (lane, group) in self.tangents.groups().enumerate() {
            // All at once they would exceed the registers of most machines.
            let sums = [
                sums(w, &self.factors, group, 0),
                sums(w, &self.factors, group, NODES_PER_PASS),
            ];
            for (i, sum) in sums.into_iter().flatten().take(NODES).enumerate() {
                self.system.right(index * NODES + i)[lane] = w.store(sum);
            }
        }
    }

    /// Computes `dy = e^{A h} dy + B X` of the first port, and adds `B X` of the others.
    #[inline(always)]
    fn advance<W: Simd>(&mut self, w: W, tables: &JointTables) {
        let (layout, table) = (self.kernel.layout, tables.table(0));
        let pushes = |index: usize| {
            tables
                .table(index)
                .push(&self.kernel.vectors[tables.ports[index].0].column)
        };
        let push = pushes(0);
        for (lane, group) in self.tangents.groups_mut().enumerate() {
            let solution = self.system.column(w, 0, lane);
            let (paired, reals) = group.split_at_mut(2 * layout.pairs);
            for (k, pair) in paired.chunks_exact_mut(2).enumerate() {
                let ([a, b, c, d], index) = (table.flow.pair(k), k % LANES);
                let (push_u, push_v) = (&push[k / LANES], &push[layout.pair_lanes + k / LANES]);
                let (u, v) = (w.load(&pair[0]), w.load(&pair[1]));
                let mut next_u = w.fma(w.splat(a), u, w.mul(w.splat(b), v));
                let mut next_v = w.fma(w.splat(c), u, w.mul(w.splat(d), v));
                for ((by_u, by_v), x) in push_u.iter().zip(push_v).zip(solution) {
                    next_u = w.fma(w.splat(by_u.0[index]), x, next_u);
                    next_v = w.fma(w.splat(by_v.0[index]), x, next_v);
                }
                (pair[0], pair[1]) = (w.store(next_u), w.store(next_v));
            }
            for (k, row) in reals.iter_mut().enumerate() {
                let (push, index) = (&push[2 * layout.pair_lanes + k / LANES], k % LANES);
                let mut next = w.mul(w.splat(table.flow.real(k)), w.load(row));
                for (by, x) in push.iter().zip(solution) {
                    next = w.fma(w.splat(by.0[index]), x, next);
                }
                *row = w.store(next);
            }
            for other in 1..tables.ports.len() {
                let (push, solution) = (pushes(other), self.system.column(w, other, lane));
                for (state, row) in group.iter_mut().enumerate() {
                    let (at, index) = layout.locate(state);
                    let mut next = w.load(row);
                    for (by, x) in push[at].iter().zip(solution) {
                        next = w.fma(w.splat(by.0[index]), x, next);
                    }
                    *row = w.store(next);
                }
            }
        }
    }
}

/// Returns a row of `-J D - J' D'`.
#[inline(always)]
fn row(
    [displacement, velocity]: [&[F64x8; NODES]; 2],
    i: usize,
    stiffness_n_m: f64,
    damping_n_s_m: f64,
) -> F64x8 {
    let mut row = F64x8::ZERO;
    for j in 0..NODES {
        row.0[j] = -stiffness_n_m * displacement[j].0[i] - damping_n_s_m * velocity[j].0[i];
    }
    row
}
