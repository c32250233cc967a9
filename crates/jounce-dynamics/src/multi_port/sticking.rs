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
use crate::contact::step::SolvedStep;
use crate::error::IntegrationError;
use crate::flow::state::columns;
use crate::force_response::basis::{NODES, SMOOTH_BASIS};
use crate::impact::acceleration::acceleration;
use crate::integrator::Integrator;
use crate::ports::state::ContactState;
use crate::tables::contact::StickingTable;
use crate::tables::joint::JointTables;
use jounce_linalg::{Mat, c64};
use jounce_simd::{F64x8, LANES, Portable, Simd};

/// Largest accepted relative mismatch of a holding force at the end of a step, times the tolerance.
const HOLDING_FORCE_TOLERANCE: f64 = 1e-2;

/// Remaining mobility of a second sticking port, relative to its own, below which both constrain
/// the same motion.
pub(super) const MIN_RELATIVE_MOBILITY: f64 = 1e-10;

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
            let index = self.positions[b];
            (if i == j { self.mobility[a][index] } else { 0.0 }) - self.responses[a][index][j].0[i]
        };
        jounce_linalg::inverse(&Mat::from_fn(count, count, entry))
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
            let (size, mobility) = (
                integrator.largest(&solved[*index].force),
                self.mobility[a][*index],
            );
            let length_s = joint.tables.length.seconds();
            let impulse_roundoff_n_s = integrator.tolerance
                * IMPULSE_ERROR_SHARE
                * integrator.speed_m_s(joint.tables.ports[*index].0)
                / mobility;
            let negligible =
                size * length_s <= HOLDING_FORCE_TOLERANCE * allowed_n_s.max(impulse_roundoff_n_s);
            let allowed = (self.allowed * mobility * size)
                .max(integrator.acceleration_roundoff_m_s2(joint.tables.ports[*index].0));
            let error_n = allowed / mobility;
            // The last node lies before the end of the step.
            let forces = solved[*index].force.0.iter().chain([&at_end[*index]]);
            let pulls = forces.into_iter().any(|f| *f < -error_n);
            let is_good = mismatch.abs() <= allowed && !pulls;
            solved[*index].error_n_s = if is_good || negligible {
                0.0
            } else {
                f64::INFINITY
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

    /// Releases sticking ports whose stop would have to pull, starting with the largest pull.
    ///
    /// # Errors
    /// [`IntegrationError::RestsTwice`] where two stops constrain the same motion.
    pub(super) fn release(&mut self) -> Result<(), IntegrationError> {
        loop {
            let resting: Vec<usize> = self
                .ports_in(ContactState::Contact)
                .filter(|p| self.is_rigid(*p))
                .collect();
            let Some(forces) = self.holding_forces(&resting)? else {
                return Ok(());
            };
            let weakest = (0..resting.len()).min_by(|a, b| forces[*a].total_cmp(&forces[*b]));
            match weakest.filter(|index| self.pulls(resting[*index], forces[*index])) {
                // It leaves from rest, whatever the roundoff of its motion.
                Some(index) => {
                    self.set_motion(resting[index], [0.0, 0.0]);
                    self.ports[resting[index]].contact_state = ContactState::Flight;
                }
                None => return Ok(()),
            }
        }
    }

    /// True where a holding force would have to pull.
    fn pulls(&self, p: usize, force_n: f64) -> bool {
        let acceleration_m_s2 = force_n * self.ports[p].rows.mobility_per_kg;
        !self.presses(p, acceleration_m_s2, || {
            self.jerk_m_s3(p) - self.jerk_by_stops_m_s3(p)
        })
    }

    /// Returns the rate of the acceleration of a port by the forces of the compliant stops in
    /// contact, m/s^3; their damping contributes by the acceleration without forces.
    fn jerk_by_stops_m_s3(&self, p: usize) -> f64 {
        self.ports_in(ContactState::Contact)
            .filter(|q| !self.is_rigid(*q))
            .map(|q| {
                let port = &self.ports[q];
                let slopes = self.law(q).slopes(port.penetration_m, port.rate_m_s);
                let rate_n_s = slopes.stiffness_n_m * port.rate_m_s
                    + slopes.damping_n_s_m * self.acceleration_m_s2(q);
                self.mobility_per_kg(p, q) * rate_n_s
            })
            .sum()
    }

    /// Returns the forces that hold the sticking ports at the current time, N; `None` without one.
    fn holding_forces(&self, resting: &[usize]) -> Result<Option<Vec<f64>>, IntegrationError> {
        if resting.is_empty() {
            return Ok(None);
        }
        let pressed = self.forces_n();
        let count = resting.len();
        let matrix = Mat::from_fn(count, count, |a, b| {
            self.mobility_per_kg(resting[a], resting[b])
        });
        let (inverse, pivots) = jounce_linalg::inverse_fully_pivoted(&matrix);
        if pivots[count - 1] <= MIN_RELATIVE_MOBILITY * pivots[0] {
            let stops = resting
                .iter()
                .map(|p| self.kernel.plant.system.stops[*p].name.clone())
                .collect();
            return Err(IntegrationError::RestsTwice {
                time_s: self.time_s,
                stops,
            });
        }
        let right: Vec<f64> = (resting.iter())
            .map(|a| {
                self.acceleration_m_s2(*a)
                    - pressed
                        .iter()
                        .enumerate()
                        .map(|(c, f)| self.mobility_per_kg(*a, c) * f)
                        .sum::<f64>()
            })
            .collect();
        Ok(Some(
            (0..count)
                .map(|a| (0..count).map(|b| inverse[(a, b)] * right[b]).sum())
                .collect(),
        ))
    }
}
