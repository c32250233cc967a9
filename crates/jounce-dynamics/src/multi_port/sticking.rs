//! Points that stick to rigid stops while other ports fly or are in contact.
//!
//! The forces `f_a` of the sticking ports hold their relative accelerations at zero,
//!
//! ```text
//! a_a . y(t) + a_drive(t) - sum_b M_ab f_b(t) = 0   for every port a at rest,
//! ```
//!
//! the sum over all ports in contact, with the mobilities `M_ab` (1/kg) between ports. At the nodes
//! of a step this is one linear system for all sticking ports, given the forces of the others.

use super::joint_solve::{JointStep, PortIterate};
use crate::contact::IMPULSE_ERROR_SHARE;
use crate::contact::step::{ContactStep, SolvedStep};
use crate::flow::state::columns;
use crate::force_response::basis::{NODES, SMOOTH_BASIS};
use crate::impact::acceleration::acceleration;
use crate::integrator::Integrator;
use crate::kernel::Kernel;
use crate::tables::contact::StickingTable;
use crate::tables::joint::JointTables;
use crate::tables::step_size::LEVELS_PER_OCTAVE;
use jounce_linalg::{Mat, c64};
use jounce_simd::{F64x8, LANES, Portable, Simd};
use std::sync::Arc;

/// Largest accepted relative mismatch of a holding force at the end of a step, times the tolerance.
const HOLDING_FORCE_TOLERANCE: f64 = 1e-2;

/// Sticking ports on a step.
pub struct StickingPorts {
    /// Indices among the ports of the step.
    positions: Vec<usize>,
    /// Free acceleration of each port at the nodes and the end, m/s^2.
    free: Vec<F64x8>,
    /// Response of each port to the force of each port in contact, without the direct effect at the
    /// nodes: `[sticking][contact][node of force]`.
    responses: Vec<Vec<[F64x8; NODES]>>,
    /// Mobility between each port and each port in contact, 1/kg.
    mobility: Vec<Vec<f64>>,
    /// Matrix from the nodal accelerations of all ports to their nodal forces, kg.
    inverse: Mat<f64>,
    /// Largest relative mismatch.
    allowed: f64,
}

impl StickingPorts {
    /// Prepares the sticking ports among those of a step.
    pub fn new(integrator: &Integrator, tables: &JointTables) -> Self {
        let positions: Vec<usize> = (0..tables.ports.len())
            .filter(|index| integrator.is_rigid(tables.ports[*index].0))
            .collect();
        let mut resting = Self {
            free: Vec::new(),
            responses: Vec::new(),
            mobility: Vec::new(),
            inverse: Mat::zeros(0, 0),
            allowed: integrator.tolerance.max(1e-12) * HOLDING_FORCE_TOLERANCE,
            positions,
        };
        for index in resting.positions.clone() {
            let port = tables.ports[index].0;
            let sticking = tables.length.tables.sticking(integrator.kernel, port);
            resting.free.push(integrator.free_acceleration(
                sticking,
                port,
                tables.length.seconds(),
            ));
            let response = |from: usize| {
                if from == index {
                    sticking.acceleration.push
                } else {
                    tables.cross(from, index).acceleration
                }
            };
            resting
                .responses
                .push((0..tables.ports.len()).map(response).collect());
            resting.mobility.push(
                tables
                    .ports
                    .iter()
                    .map(|(other, _)| integrator.mobility_per_kg(port, *other))
                    .collect(),
            );
        }
        resting.inverse = match resting.positions[..] {
            [] => Mat::zeros(0, 0),
            [index] => {
                let port = tables.ports[index].0;
                let sticking = tables.length.tables.sticking(integrator.kernel, port);
                Mat::from_fn(NODES, NODES, |i, j| sticking.inverse[i][j])
            }
            _ => resting.inverse_of_system(),
        };
        resting
    }

    /// Returns the matrix from the nodal accelerations of several ports to their nodal forces.
    fn inverse_of_system(&self) -> Mat<f64> {
        let count = self.positions.len() * NODES;
        let entry = |row: usize, column: usize| {
            let ((a, i), (b, j)) = ((row / NODES, row % NODES), (column / NODES, column % NODES));
            self.lost_per_kg(a, self.positions[b], [i, j])
        };
        jounce_linalg::inverse(&Mat::from_fn(count, count, entry))
    }

    /// Returns the acceleration that a sticking port loses at node `i` per unit force at node `j` of
    /// a port in contact, 1/kg.
    fn lost_per_kg(&self, sticking: usize, from: usize, [i, j]: [usize; 2]) -> f64 {
        let direct = if i == j {
            self.mobility[sticking][from]
        } else {
            0.0
        };
        direct - self.responses[sticking][from][j].0[i]
    }

    /// Returns [`Self::lost_per_kg`] by the indices of two ports in contact; `None` where the first
    /// does not stick.
    pub fn coefficient(&self, index: usize, from: usize, nodes: [usize; 2]) -> Option<f64> {
        let sticking = self.positions.iter().position(|other| *other == index)?;
        Some(self.lost_per_kg(sticking, from, nodes))
    }

    /// Sets the forces of the sticking ports, given those of the others.
    pub fn hold(&self, iterates: &mut [PortIterate]) {
        let mut right = Vec::with_capacity(self.positions.len() * NODES);
        for (a, free) in self.free.iter().enumerate() {
            for i in 0..NODES {
                let mut sum = free.0[i];
                for (index, other) in iterates
                    .iter()
                    .enumerate()
                    .filter(|(index, _)| !self.positions.contains(index))
                {
                    sum -= self.mobility[a][index] * other.force.0[i];
                    sum += (0..NODES)
                        .map(|j| self.responses[a][index][j].0[i] * other.force.0[j])
                        .sum::<f64>();
                }
                right.push(sum);
            }
        }
        for (a, index) in self.positions.iter().enumerate() {
            let force = |i: usize| {
                right
                    .iter()
                    .enumerate()
                    .map(|(k, right)| self.inverse[(a * NODES + i, k)] * right)
                    .sum()
            };
            iterates[*index].force =
                F64x8(std::array::from_fn(
                    |i| if i < NODES { force(i) } else { 0.0 },
                ));
        }
    }

    /// Rejects a step on which a holding force misses the end of the step, or would have to pull
    /// for a significant time.
    pub fn judge(&self, integrator: &Integrator, joint: &JointStep, solved: &mut [SolvedStep]) {
        if self.positions.is_empty() {
            return;
        }
        let at_end: Vec<f64> = solved
            .iter()
            .map(|solution| {
                (0..NODES)
                    .map(|j| SMOOTH_BASIS.at_end.0[j] * solution.force.0[j])
                    .sum()
            })
            .collect();
        let allowed_n_s = integrator.allowed_with_others_n_s(&joint.steps, solved);
        for (a, index) in self.positions.iter().enumerate() {
            let mut mismatch = self.free[a].0[NODES];
            for (from, other) in solved.iter().enumerate() {
                mismatch -= self.mobility[a][from] * at_end[from];
                mismatch += (0..NODES)
                    .map(|j| self.responses[a][from][j].0[NODES] * other.force.0[j])
                    .sum::<f64>();
            }
            let (port, size, mobility) = (
                joint.tables.ports[*index].0,
                integrator.largest(&solved[*index].force),
                self.mobility[a][*index],
            );
            let length_s = joint.tables.length.seconds();
            let negligible =
                size * length_s <= integrator.negligible_holding_n_s(port, allowed_n_s);
            let allowed =
                (self.allowed * mobility * size).max(integrator.acceleration_roundoff_m_s2(port));
            let error_n = allowed / mobility;
            // The last node lies before the end of the step.
            let forces = solved[*index].force.0.iter().chain([&at_end[*index]]);
            let pulls = forces.into_iter().any(|f| *f < -error_n);
            let is_good = mismatch.abs() <= allowed && !pulls;
            solved[*index].error_n_s = match (is_good, negligible) {
                (true, _) => allowed_n_s * (mismatch.abs() / allowed),
                (false, true) => 0.0,
                (false, false) => f64::INFINITY,
            };
            solved[*index].force = F64x8(solved[*index].force.0.map(|force| force.max(0.0)));
        }
    }
}

impl Integrator<'_> {
    /// Returns the velocity that one port loses per unit impulse at another, 1/kg.
    pub(super) fn mobility_per_kg(&self, port: usize, other: usize) -> f64 {
        let stops = &self.kernel.plant.system.stops;
        stops[port]
            .shape
            .iter()
            .zip(&stops[other].shape)
            .map(|(a, b)| a * b)
            .sum()
    }

    fn largest(&self, force: &F64x8) -> f64 {
        force.0[..NODES]
            .iter()
            .fold(0.0, |max, force| max.max(force.abs()))
    }

    /// Returns the relative acceleration of a port without any contact force on the step, at its
    /// nodes and its end, m/s^2.
    fn free_acceleration(&self, sticking: &StickingTable, port: usize, length_s: f64) -> F64x8 {
        let w = Portable::new();
        let mut free = w.store(columns(
            w,
            &self.layout,
            &self.y,
            &sticking.acceleration.columns,
            w.zero(),
        ));
        for tone in &self.tones {
            let samples = &tone.samples[port];
            for i in 0..LANES {
                let phasor = tone.displacement_m[port]
                    * tone.turn
                    * c64::new(samples.cos.0[i], samples.sin.0[i]);
                free.0[i] += acceleration(phasor, tone.angular_frequency_rad_s);
            }
        }
        for (free, node) in free.0.iter_mut().zip(SMOOTH_BASIS.positions) {
            *free += self.excitation.acceleration_after(port, node * length_s);
        }
        free
    }

    /// Returns the impulse of a holding force below which its sign does not matter, N s.
    fn negligible_holding_n_s(&self, p: usize, allowed_n_s: f64) -> f64 {
        let impulse_roundoff_n_s = self.tolerance * IMPULSE_ERROR_SHARE * self.speed_m_s(p)
            / self.ports[p].rows.mobility_per_kg;
        HOLDING_FORCE_TOLERANCE * allowed_n_s.max(impulse_roundoff_n_s)
    }

    /// Returns the desired level of the step after an accepted one of `level` with a sticking port.
    pub(super) fn next_level_sticking(
        &self,
        level: i32,
        step: &ContactStep,
        solved: &SolvedStep,
        allowed_n_s: f64,
    ) -> i32 {
        // The mismatch of a polynomial through seven nodes grows with the seventh power of the
        // length.
        let is_spare = solved.error_n_s * 2.0_f64.powi(NODES as i32) <= allowed_n_s;
        let longer = if is_spare {
            (level - LEVELS_PER_OCTAVE).max(Kernel::coarsest())
        } else {
            level
        };
        // The force at the end of the step and its slope predict when the port leaves: a step past
        // that time is accepted where the force until then is negligible.
        let by_node = step.basis.at_end.0.iter().zip(&solved.force.0);
        let end_n: f64 = by_node.map(|(at_end, force)| at_end * force).sum();
        let fall_n = solved.force.0[NODES - 1] - end_n;
        let leaving_s = step.last_gap_s() * end_n / fall_n;
        if !(fall_n > 0.0 && end_n > 0.0 && leaving_s < Kernel::length_s(longer)) {
            return longer;
        }
        let is_last =
            2.0 * leaving_s * end_n <= self.negligible_holding_n_s(step.port, allowed_n_s);
        let within_s = if is_last { 2.0 * leaving_s } else { leaving_s };
        longer.max(Kernel::level_within(within_s))
    }

    /// Adds a step of sticking to the statistics.
    pub(crate) fn observe_rest(&mut self, p: usize, length_s: f64, force: &F64x8) {
        let port = &mut self.ports[p];
        port.statistics.max_force_n = force
            .0
            .iter()
            .fold(port.statistics.max_force_n, |max, f| max.max(*f));
        port.statistics.sticking_s += length_s;
        port.stay(length_s);
    }

    /// Removes the drift of collocation: the constraint acts on the acceleration, so that position
    /// and speed drift by roundoff.
    pub(crate) fn reset_onto_stop(&mut self, p: usize) {
        let port = &self.ports[p];
        let [penetration_m, impulse_n_s] = [
            port.penetration_m,
            port.rate_m_s / port.rows.mobility_per_kg,
        ];
        let rows = Arc::clone(&port.rows);
        let rows = rows.rigid(self.kernel, p);
        for ((y, shift), force) in self.y.iter_mut().zip(&rows.shift).zip(&rows.force) {
            *y = y
                .add_scaled(penetration_m, shift)
                .add_scaled(impulse_n_s, force);
        }
        self.set_motion(p, [0.0, 0.0]);
    }
}
