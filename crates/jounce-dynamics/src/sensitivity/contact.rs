//! Linearised contact step for all ports in contact at once.

use super::elimination::{NODES_PER_PASS, NodeSystem};
use super::parameter_sensitivity::DrivenNodeMotion;
use super::parameters::NodeLaws;
use super::tangents::sums;
use super::variational_integration::VariationalIntegration;
use crate::flow::state::{add_force_response, columns};
use crate::force_response::basis::NODES;
use crate::kernel::{ForceBasis, Kernel};
use crate::ports::small_list::SmallList;
use crate::record::trajectory::TrajectorySegment;
use crate::tables::joint::{JointTables, StepLength};
use jounce_model::contact::{ContactLaw, Slopes};
use jounce_simd::{F64x8, Simd};

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
        let ports: SmallList<(usize, ForceBasis)> = segment
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
        let mut nodes = SmallList::<LawNodes>::new();
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
            let system = Some(&self.system);
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
        let (lane, column) = self.tangents.drift_column();
        for (right, drift) in self.system.right(index, lane).iter_mut().zip(right_sides.0) {
            right.0[column] += drift;
        }
        for (lane, shift_s) in shift_s.iter().copied().flatten().enumerate() {
            let shift_s = w.load(shift_s);
            for (right, by_time) in self.system.right(index, lane).iter_mut().zip(by_time.0) {
                *right = w.store(w.fma(w.splat(by_time), shift_s, w.load(right)));
            }
        }
        for from in 0..tables.ports.len() {
            let [displacement, velocity] = tables.responses(from, index);
            let block = self.system.block(from, index);
            for j in 0..NODES {
                let by_depth = w.mul(stiffness, w.load(&displacement[j]));
                let by_rate = w.mul(damping, w.load(&velocity[j]));
                block[j] = w.store(w.sub(w.sub(w.zero(), by_depth), by_rate));
                block[j].0[j] += if from == index { 1.0 } else { 0.0 };
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
        let force = |column: usize| {
            let mut sum = w.mul(stiffness, w.load(&table.displacement.columns[column]));
            if needs_rate {
                sum = w.fma(damping, w.load(&table.velocity.columns[column]), sum);
            }
            w.store(sum)
        };
        let (paired, reals) = self.factors.split_at_mut(2 * layout.pairs);
        for (k, pair) in paired.chunks_exact_mut(2).enumerate() {
            (pair[0], pair[1]) = (force(k), force(layout.pairs + k));
        }
        for (k, real) in reals.iter_mut().enumerate() {
            *real = force(2 * layout.pairs + k);
        }
        for (lane, group) in self.tangents.groups().enumerate() {
            let low: [_; NODES_PER_PASS] = sums(w, &self.factors, group, 0);
            let high: [_; NODES - NODES_PER_PASS] = sums(w, &self.factors, group, NODES_PER_PASS);
            let right = self.system.right(index, lane);
            for (right, sum) in right.iter_mut().zip(low.into_iter().chain(high)) {
                *right = w.store(sum);
            }
        }
    }

    /// Computes `dy = e^{A h} dy + B X` of all ports.
    #[inline(always)]
    fn advance<W: Simd>(&mut self, w: W, tables: &JointTables) {
        let kernel = self.kernel;
        let (layout, flow) = (&kernel.layout, &tables.table(0).flow);
        for (index, (port, _)) in tables.ports.iter().enumerate() {
            let push = tables.table(index).push(&kernel.vectors[*port].column);
            if index == 0 {
                self.tangents.step(w, layout, flow, push, &self.system);
            } else {
                self.tangents.push(w, layout, push, (&self.system, index));
            }
        }
    }
}
