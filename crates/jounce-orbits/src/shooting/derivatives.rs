//! Derivatives of an orbit with respect to parameters of its plant.
//!
//! With `R(u, p) = P(u, p) - u` and the map `P` over the period
//!
//! ```text
//! du/dp = -(dR/du)^-1 dR/dp,   dw/dp = w_u du/dp + w_p
//! ```
//!
//! for each result `w`. `dR/dp`, `w_u` and `w_p` are exact derivatives of the computed motion (see
//! [`jounce_dynamics::FlowSensitivity`]), so that all parameters cost one more integration of the
//! period.
//!
//! Source: the implicit function theorem.

use super::{OrbitError, ParametricModel, Shooting, ShootingEvaluation, cycle_s};
use jounce_continuation::Linearization;
use jounce_dynamics::{FlowSensitivity, ParameterRequest, ParameterSensitivity};
use jounce_linalg::c64;
use jounce_model::plant::{Plant, PlantDerivative, product};

/// An instant of an orbit: a time from the start of one of its drive cycles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OrbitInstant {
    /// Drive cycle, from 0 on.
    pub cycle: usize,
    /// Time from its start, s.
    pub time_s: f64,
}

/// Derivatives of an orbit, one value per parameter in each list.
#[derive(Debug, Clone)]
pub struct OrbitSensitivity {
    /// Derivative of the state at the start of the period, energy coordinates.
    pub start: Vec<Vec<f64>>,
    /// Derivative of the mean power of the loads, W.
    pub mean_power_w: Vec<f64>,

    /// Derivatives at the wanted instants.
    pub instants: Vec<InstantSensitivity>,
}

/// Derivatives at an instant, one list per parameter.
#[derive(Debug, Clone)]
pub struct InstantSensitivity {
    /// Physical state `(q, q', V, i)`.
    pub state: Vec<f64>,
    /// Its derivative.
    pub state_by: Vec<Vec<f64>>,
    /// Displacement towards each stop, m.
    pub displacements_m: Vec<f64>,
    /// Its derivative.
    pub displacements_by: Vec<Vec<f64>>,
    /// Derivative of the contact force of each stop, N.
    pub forces_by: Vec<Vec<f64>>,
}

impl<H: ParametricModel> Shooting<'_, H> {
    /// Computes the derivatives of an integrated orbit, at instants in ascending order.
    ///
    /// # Errors
    /// The integration fails, or the period map has the multiplier 1.
    pub fn sensitivity(
        &self,
        evaluation: &ShootingEvaluation,
        derivatives: &[PlantDerivative],
        instants: &[OrbitInstant],
    ) -> Result<OrbitSensitivity, OrbitError<H::Error>> {
        let plant = &evaluation.kernel.plant;
        let cycles = self.linearized_cycles(evaluation, (derivatives, instants))?;
        let mut result = OrbitSensitivity {
            start: Vec::new(),
            mean_power_w: Vec::new(),
            instants: Vec::new(),
        };
        let mut courses = Vec::with_capacity(derivatives.len());
        for (k, by) in derivatives.iter().enumerate() {
            let steady = by.steady_at(plant, 0.0);
            let residual = self.residual_derivative(plant, &cycles, (k, &steady));
            let start = self.closed(evaluation, by, &residual)?;
            let physical: Vec<f64> = start.iter().zip(&self.scale).map(|(u, w)| u / w).collect();
            let mut y = product(&plant.diagonal.from_physical, &physical);
            y.iter_mut().zip(&steady).for_each(|(y, s)| *y -= s);
            let mut energy_j = 0.0;
            let mut course = Vec::with_capacity(cycles.len());
            for cycle in &cycles {
                energy_j += dot(&cycle.outputs.energy, &y) + cycle.outputs.energy[y.len() + k];
                let next = after(cycle, &y, k);
                course.push(std::mem::replace(&mut y, next));
            }
            result.start.push(start);
            result.mean_power_w.push(energy_j / evaluation.period_s);
            courses.push(course);
        }
        result.instants = of_instants(plant, derivatives, &cycles, &courses);
        Ok(result)
    }

    /// Computes the derivative of the residual of the period map at a fixed state by each parameter,
    /// energy coordinates.
    ///
    /// # Errors
    /// The integration fails.
    pub fn residual_derivatives(
        &self,
        evaluation: &ShootingEvaluation,
        derivatives: &[PlantDerivative],
    ) -> Result<Vec<Vec<f64>>, OrbitError<H::Error>> {
        let plant = &evaluation.kernel.plant;
        let cycles = self.linearized_cycles(evaluation, (derivatives, &[]))?;
        let of = |(k, by): (usize, &PlantDerivative)| {
            self.residual_derivative(plant, &cycles, (k, &by.steady_at(plant, 0.0)))
        };
        Ok(derivatives.iter().enumerate().map(of).collect())
    }

    /// Returns `dR/dp` of one parameter, given the derivative of the steady state at the start.
    fn residual_derivative(
        &self,
        plant: &Plant,
        cycles: &[FlowSensitivity],
        (parameter, steady): (usize, &[f64]),
    ) -> Vec<f64> {
        // At a fixed state, the difference from the steady part moves opposite to it.
        let fixed: Vec<f64> = steady.iter().map(|s| -s).collect();
        let end = (cycles.iter()).fold(fixed, |before, cycle| after(cycle, &before, parameter));
        self.unknown(&product(&plant.diagonal.to_physical, &sum(&end, steady)))
    }

    /// Linearises each drive cycle.
    fn linearized_cycles(
        &self,
        evaluation: &ShootingEvaluation,
        (derivatives, instants): (&[PlantDerivative], &[OrbitInstant]),
    ) -> Result<Vec<FlowSensitivity>, OrbitError<H::Error>> {
        let cycle_s = cycle_s(&evaluation.kernel.plant)?;
        let (kernel, none) = (&evaluation.kernel, ParameterSensitivity::default());
        let mut y = kernel
            .plant
            .from_physical(&self.physical(&evaluation.strobe_states[0]), 0.0);
        let mut cycles = Vec::new();
        for index in 0..self.cycles as usize {
            let wanted = instants.iter().filter(|instant| instant.cycle == index);
            // The end of a cycle is the start of the next, up to the residual.
            let times_s: Vec<f64> = wanted
                .map(|instant| instant.time_s.min(cycle_s * (1.0 - f64::EPSILON)))
                .collect();
            let request = Some(ParameterRequest {
                derivatives,
                times_s: &times_s,
            });
            let (span_s, tolerance) = ((0.0, cycle_s), self.tolerance);
            let cycle =
                FlowSensitivity::with_parameters(kernel, &y, span_s, tolerance, &none, request)?;
            y.clone_from(&cycle.end);
            cycles.push(cycle);
        }
        Ok(cycles)
    }

    /// Returns `du/dp` of a parameter, given `dR/dp`.
    fn closed(
        &self,
        evaluation: &ShootingEvaluation,
        by: &PlantDerivative,
        residual: &[f64],
    ) -> Result<Vec<f64>, OrbitError<H::Error>> {
        let mut right: Vec<f64> = residual.iter().map(|r| -r).collect();
        if evaluation.keeps_charge {
            let charges = self.charges(evaluation, by);
            right
                .iter_mut()
                .zip(charges)
                .for_each(|(r, charge)| *r += charge);
        }
        let fixed = vec![0.0; right.len()];
        let solved = evaluation.bordered(&fixed, 1.0, &right, 0.0);
        solved
            .map(|(start, _)| start)
            .ok_or(OrbitError::Multipliers {
                frequency_hz: 1.0 / evaluation.period_s,
            })
    }

    /// Returns the change of the state that keeps the charges of open nodes at zero where their
    /// capacitance or coupling changes, energy coordinates.
    fn charges(&self, evaluation: &ShootingEvaluation, by: &PlantDerivative) -> Vec<f64> {
        let plant = &evaluation.kernel.plant;
        let start = self.physical(&evaluation.strobe_states[0]);
        let (electrical, first) = (&plant.electrical, 2 * plant.system.modes.len());
        let mut change = vec![0.0; start.len()];
        let open = (0..electrical.nodes.len()).filter(|node| electrical.is_open(*node));
        for (node, row) in open.zip(&by.charges) {
            // One voltage takes the change, because the rows of different nodes do not overlap there.
            let voltage = -dot(row, &start) / electrical.nodes[node].capacitance_f;
            change[first + node] = voltage * self.scale[first + node];
        }
        let rows = super::charges::conserved_charges(plant, &self.scale, &evaluation.trajectories);
        let along = rows.iter().map(|row| (row, dot(row, &change)));
        along.fold(vec![0.0; start.len()], |total, (row, size)| {
            total
                .iter()
                .zip(row)
                .map(|(sum, l)| sum + size * l)
                .collect()
        })
    }
}

/// Returns the derivative of the state after a cycle by a parameter.
fn after(cycle: &FlowSensitivity, before: &[f64], parameter: usize) -> Vec<f64> {
    sum(
        &product(&cycle.jacobian, before),
        &cycle.outputs.end[parameter],
    )
}

/// Returns the derivatives at the instants; `courses` has the derivatives of the state at the start
/// of each cycle, block coordinates, for each parameter.
fn of_instants(
    plant: &Plant,
    derivatives: &[PlantDerivative],
    cycles: &[FlowSensitivity],
    courses: &[Vec<Vec<f64>>],
) -> Vec<InstantSensitivity> {
    let mut all = Vec::new();
    for (index, cycle) in cycles.iter().enumerate() {
        for at in &cycle.outputs.states {
            let total = |row: &[f64], k: usize| {
                let y = &courses[k][index];
                dot(row, y) + row[y.len() + k]
            };
            let mut instant = InstantSensitivity {
                state: plant.to_physical(&at.state, at.time_s),
                state_by: Vec::new(),
                displacements_m: (plant.ports.iter())
                    .map(|port| {
                        dot(&port.displacement, &at.state) + plant.driven(port, at.time_s)[0]
                    })
                    .collect(),
                displacements_by: Vec::new(),
                forces_by: Vec::new(),
            };
            for (k, by) in derivatives.iter().enumerate() {
                let y: Vec<f64> = at.by.iter().map(|row| total(row, k)).collect();
                let displacement = |(port, changed): (
                    &jounce_model::plant::Port,
                    &jounce_model::plant::PortDerivative,
                )| {
                    let tones = plant.tones.iter().zip(&changed.steady_m);
                    let steady: f64 = tones
                        .map(|(tone, s)| {
                            (c64::cis(tone.angular_frequency_rad_s * at.time_s) * s).re
                        })
                        .sum();
                    dot(&port.displacement, &y) + dot(&changed.displacement, &at.state) + steady
                };
                instant.displacements_by.push(
                    plant
                        .ports
                        .iter()
                        .zip(&by.ports)
                        .map(displacement)
                        .collect(),
                );
                let steady = by.steady_at(plant, at.time_s);
                instant
                    .state_by
                    .push(product(&plant.diagonal.to_physical, &sum(&y, &steady)));
                instant
                    .forces_by
                    .push(at.forces_by.iter().map(|row| total(row, k)).collect());
            }
            all.push(instant);
        }
    }
    all
}

fn dot(row: &[f64], values: &[f64]) -> f64 {
    row.iter().zip(values).map(|(a, b)| a * b).sum()
}

fn sum(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a + b).collect()
}
