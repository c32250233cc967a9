//! Parameters on the steps and at the events of a linearisation.

use super::motion::{add_series, forced_by};
use super::{ParameterStep, Parameters, StepMotion};
use crate::force_response::basis::{NODES, legendre};
use crate::kernel::Kernel;
use crate::record::trajectory::TrajectorySegment;
use crate::sensitivity::elimination::NodeSystem;
use crate::sensitivity::tangents::Tangents;
use jounce_model::contact::Law;
use jounce_model::plant::Plant;
use jounce_simd::{F64x8, LANES, Simd};

/// Law of a port at the nodes of a step.
pub struct NodeLaws {
    pub port: usize,
    /// Index among the ports in contact.
    pub index: usize,
    /// Nodes of the step, relative to its length.
    pub positions: [f64; LANES],
    /// `J` and `J'` at the nodes.
    pub slopes: [F64x8; 2],
    /// Penetration (m) and rate (m/s) at the nodes.
    pub depth: F64x8,
    pub rate: F64x8,
}

impl Parameters<'_> {
    /// Returns the motion on a step that the parameters force.
    #[inline(always)]
    pub fn step<W: Simd>(
        &mut self,
        w: W,
        kernel: &Kernel,
        segment: &TrajectorySegment,
    ) -> ParameterStep {
        let motion = StepMotion::of(kernel, segment, &mut self.known);
        let mut forced = Vec::with_capacity(self.groups.len());
        for group in &self.groups {
            forced.push(forced_by(w, kernel, group, &motion));
        }
        ParameterStep { motion, forced }
    }

    /// Adds the forced motion at the end of a step to the tangents.
    pub fn add_end(&self, step: &ParameterStep, tangents: &mut Tangents) {
        let groups = tangents.groups_mut().skip(self.first);
        for (columns, forced) in groups.zip(&step.forced) {
            for (column, series) in columns.iter_mut().zip(forced) {
                *column = series.iter().fold(*column, |sum, c| sum.add_scaled(1.0, c));
            }
        }
    }

    /// Adds the parameters to the right sides of the nodes of a port.
    #[inline(always)]
    pub fn add_right_sides<W: Simd>(
        &self,
        w: W,
        plant: &Plant,
        segment: &TrajectorySegment,
        step: &ParameterStep,
        laws: &NodeLaws,
        system: &mut NodeSystem,
    ) {
        let motion = &step.motion;
        let port = &plant.ports[laws.port];
        let has_rate = laws.slopes[1] != F64x8::ZERO;
        let values: Vec<Vec<f64>> = (0..NODES)
            .map(|i| legendre(laws.positions[i], motion.terms))
            .collect();
        for (g, (group, forced)) in self.groups.iter().zip(&step.forced).enumerate() {
            let by = &group.ports[laws.port];
            let depth = output(w, motion, forced, (&port.displacement, &by.rows[0]));
            let mut rate = Vec::new();
            if has_rate {
                rate = output(w, motion, forced, (&port.velocity, &by.rows[1]));
            }
            for (i, values) in values.iter().enumerate() {
                let time_s = segment.start_s + laws.positions[i] * segment.length_s;
                let tones = by.of_tones(plant, laws.port, time_s, &group.tones);
                let penetration = value_at(&depth, values)
                    .add_scaled(-1.0, &by.gap_m)
                    .add_scaled(1.0, &tones[0]);
                let mut right =
                    changed_force(&by.laws, laws, i).add_scaled(laws.slopes[0].0[i], &penetration);
                if has_rate {
                    let moving = value_at(&rate, values).add_scaled(1.0, &tones[1]);
                    right = right.add_scaled(laws.slopes[1].0[i], &moving);
                }
                let sum = &mut system.right(laws.index, self.first + g)[i];
                *sum = sum.add_scaled(1.0, &right);
            }
        }
    }

    /// Returns the changes of penetration (m) and rate (m/s) of a port at a state without the
    /// steady part, for each group.
    pub fn drifts(
        &self,
        plant: &Plant,
        port: usize,
        (time_s, state): (f64, &[f64]),
    ) -> Vec<[F64x8; 2]> {
        let of = |group: &super::ParameterGroup<'_>| {
            group.ports[port].drift(plant, port, (time_s, state), &group.tones)
        };
        self.groups.iter().map(of).collect()
    }

    /// Adds one of the changes of a port to a row of the columns.
    pub fn add_drift(&self, row: &mut [F64x8], drifts: &[[F64x8; 2]], which: usize) {
        for (lane, drift) in row[self.first..].iter_mut().zip(drifts) {
            *lane = lane.add_scaled(1.0, &drift[which]);
        }
    }

    /// Adds the change of an impulse: of its column, and of its size at a closing speed (m/s).
    pub fn add_impulse(
        &self,
        plant: &Plant,
        (port, impulse_n_s, speed_m_s): (usize, f64, f64),
        tangents: &mut Tangents,
    ) {
        let force = &plant.ports[port].force;
        for (columns, group) in tangents.groups_mut().skip(self.first).zip(&self.groups) {
            let by = &group.ports[port];
            for (i, column) in columns.iter_mut().enumerate() {
                *column = column
                    .add_scaled(impulse_n_s, &by.columns[1][i])
                    .add_scaled(force[i] * speed_m_s, &by.impulse_kg);
            }
        }
    }
}

/// Returns the coefficients of `c p + dc y` of an output with the row `c`, changed by `dc`.
#[inline(always)]
fn output<W: Simd>(
    w: W,
    motion: &StepMotion,
    forced: &[Vec<F64x8>],
    (own, changed): (&[f64], &[F64x8]),
) -> Vec<F64x8> {
    let mut sum = vec![F64x8::ZERO; motion.terms];
    for (c, p) in own.iter().zip(forced) {
        let c = w.splat(*c);
        for (sum, p) in sum.iter_mut().zip(p) {
            *sum = w.store(w.fma(c, w.load(p), w.load(sum)));
        }
    }
    for (by, y) in changed.iter().zip(&motion.states) {
        if *by != F64x8::ZERO {
            add_series(w, &mut sum, by, y);
        }
    }
    sum
}

/// Returns the value of a series, given those of the polynomials.
fn value_at(series: &[F64x8], values: &[f64]) -> F64x8 {
    let pairs = series.iter().zip(values);
    pairs.fold(F64x8::ZERO, |sum, (c, p)| sum.add_scaled(*p, c))
}

/// Returns the change of the force of the laws at a node, N per unit of each parameter.
fn changed_force(changed: &[&[(f64, Law)]; LANES], laws: &NodeLaws, node: usize) -> F64x8 {
    let (depth, rate) = (laws.depth.0[node], laws.rate.0[node]);
    F64x8(changed.map(|weighted| {
        weighted
            .iter()
            .map(|(weight, law)| weight * law.force_n(depth, rate))
            .sum()
    }))
}
