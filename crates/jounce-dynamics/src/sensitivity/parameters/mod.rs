//! Derivatives with respect to parameters of the plant, next to those with respect to the start.
//!
//! Each parameter is one more column of the tangents. On a step it forces the motion `p` of
//! [`motion`] with the contact force of the unchanged plant. The change `c p + dc y - dg` of the
//! penetration and the change of the law then enter the equations of the nodes. Events and contact
//! are those of the other columns.
//!
//! Limits: plants without bridges, constant signals, and no rest on a rigid stop.

mod functional;
pub mod group;
pub mod motion;
mod outputs;
mod steps;

use crate::kernel::Kernel;
use group::ParameterGroup;
use jounce_model::plant::PlantDerivative;
use jounce_simd::{F64x8, LANES};
use motion::{Responses, StepMotion};
use outputs::{LoadOutput, StateTangents};
pub use steps::NodeLaws;

/// Parameters, and the outputs whose derivatives are wanted.
#[derive(Debug, Clone, Copy)]
pub struct ParameterRequest<'a> {
    /// Derivative of the plant by each parameter.
    pub derivatives: &'a [PlantDerivative],
    /// Times at which the derivative of the state is wanted, s, ascending.
    pub times_s: &'a [f64],
}

/// Derivatives of outputs over an interval. Columns belong to the state at its start, then to the
/// parameters.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct OutputDerivatives {
    /// Derivative of the state at the end by each parameter, at a fixed start: one list of states
    /// per parameter.
    pub end: Vec<Vec<f64>>,
    /// Energy delivered to the loads, J.
    pub energy_j: f64,
    /// Its derivatives.
    pub energy: Vec<f64>,
    /// States at the wanted times with their derivatives.
    pub states: Vec<StateDerivative>,
}

/// A state with its derivatives.
#[derive(Debug, Clone, PartialEq)]
pub struct StateDerivative {
    /// Time, s.
    pub time_s: f64,
    /// State without the steady part, block coordinates.
    pub state: Vec<f64>,
    /// Derivatives of each state, up to a multiple of its rate in the first step of a contact.
    pub by: Vec<Vec<f64>>,
    /// Derivatives of the contact force of each stop, N.
    pub forces_by: Vec<Vec<f64>>,
}

/// Parameters of a linearisation in progress.
pub struct Parameters<'a> {
    request: ParameterRequest<'a>,
    groups: Vec<ParameterGroup<'a>>,
    /// First vector of their columns in the tangents.
    first: usize,
    known: Responses,
    loads: Vec<LoadOutput>,
    energy_j: f64,
    energy: Vec<F64x8>,
    states: Vec<StateTangents>,
}

/// A step with the motion that each group of parameters forces on it.
pub struct ParameterStep {
    motion: StepMotion,
    /// For each group, the coefficients of each state.
    forced: Vec<Vec<Vec<F64x8>>>,
}

impl<'a> Parameters<'a> {
    /// Prepares the parameters of a request.
    pub fn new(kernel: &Kernel, request: ParameterRequest<'a>) -> Self {
        let plant = &kernel.plant;
        let groups = request.derivatives.chunks(LANES);
        let groups: Vec<ParameterGroup<'a>> =
            groups.map(|some| ParameterGroup::of(plant, some)).collect();
        let first = first_vector(plant.len());
        Self {
            energy: vec![F64x8::ZERO; first + groups.len()],
            loads: LoadOutput::of_all(plant),
            known: Responses::default(),
            energy_j: 0.0,
            states: Vec::new(),
            request,
            groups,
            first,
        }
    }

    /// Returns the number of groups of columns.
    pub fn groups(&self) -> usize {
        self.groups.len()
    }

    /// Returns the results; `end` reads the derivative of a state at the end in a column of the
    /// tangents.
    pub fn finish(self, states: usize, end: &dyn Fn(usize, usize) -> f64) -> OutputDerivatives {
        let count = self.request.derivatives.len();
        let columns: Vec<usize> = (0..states)
            .chain((0..count).map(|k| self.first * LANES + k))
            .collect();
        let read = |lanes: &[F64x8]| -> Vec<f64> {
            columns
                .iter()
                .map(|column| lanes[column / LANES].0[column % LANES])
                .collect()
        };
        let of_states = self.states.iter().map(|tangents| StateDerivative {
            time_s: tangents.time_s,
            state: tangents.state.clone(),
            by: tangents.by.iter().map(|row| read(row)).collect(),
            forces_by: tangents.forces_by.iter().map(|row| read(row)).collect(),
        });
        OutputDerivatives {
            end: columns[states..]
                .iter()
                .map(|column| (0..states).map(|state| end(state, *column)).collect())
                .collect(),
            energy_j: self.energy_j,
            energy: read(&self.energy),
            states: of_states.collect(),
        }
    }
}

/// Returns the first vector of the columns of parameters in the tangents of a number of states.
pub fn first_vector(states: usize) -> usize {
    (states + 1).div_ceil(LANES)
}
