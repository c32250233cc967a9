//! Recorded integration, exact at all times and not only at the steps.
//!
//! A segment stores the state at its start and the polynomial of the contact force. The state at
//! any time inside it is the exact flow plus the Duhamel response, evaluated from its Legendre
//! series.

use crate::contact::step::ContactStep;
use crate::force_response::basis::{NODES, legendre};
use crate::force_response::output_rows::parts;
use crate::force_response::step_response::StepResponse;
use crate::kernel::{ForceBasis, Kernel};
use jounce_model::plant::{Plant, Port, SignalSample};
use jounce_simd::F64x8;
use smallvec::SmallVec;
use std::collections::HashMap;

/// States of a segment that need no allocation: those of nine modes and two voltages.
const INLINE_STATES: usize = 20;

/// Step of a trajectory.
#[derive(Debug, Clone, PartialEq)]
pub struct TrajectorySegment {
    /// Time at its start, s.
    pub start_s: f64,
    /// Length, s.
    pub length_s: f64,
    /// State at its start without the forced part of the signals, block coordinates.
    pub state: SmallVec<[f64; INLINE_STATES]>,
    /// Value and slope of each signal at its start.
    pub sizes: Box<[SignalSample]>,
    /// Contact forces; empty in flight. Records are long and mostly of flights, so that no space is
    /// kept for them.
    pub forces: Box<[PortForce]>,
    /// Conduction state of the bridges; the state is in its block coordinates.
    pub conduction_state: usize,
}

/// Contact force of one port on a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PortForce {
    /// Index of the port.
    pub port: usize,
    /// Basis of the force.
    pub shape: ForceBasis,
    /// Values at the seven nodes, N.
    pub nodal_n: [f64; NODES],
}

impl PortForce {
    /// Takes the force of a step without the last lane.
    pub(crate) fn new(step: &ContactStep, force: &F64x8) -> Self {
        Self {
            port: step.port,
            shape: step.shape,
            nodal_n: std::array::from_fn(|j| force.0[j]),
        }
    }
}

/// Consecutive segments.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Trajectory {
    segments: Vec<TrajectorySegment>,
    impacts: Vec<Impact>,
    changes: Vec<ConductionChange>,
}

/// Impulse of a rigid stop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Impact {
    /// Number of segments before it.
    pub after: usize,
    /// Index of the port.
    pub port: usize,
    /// Impulse, N s.
    pub impulse_n_s: f64,
}

/// Change of the conduction state of the bridges.
#[derive(Debug, Clone, PartialEq)]
pub struct ConductionChange {
    /// Number of segments before it.
    pub after: usize,
    /// Time, s.
    pub time_s: f64,
    /// Conduction state that ends.
    pub conduction_state: usize,
    /// Bridge whose switch closed for an instant; `None` where diodes changed.
    pub flipped: Option<usize>,
    /// Physical state `(q, q', V, i)` before the change.
    pub state: Vec<f64>,
    /// Contact force of each stop, N.
    pub forces_n: Vec<f64>,
}

/// State of a trajectory.
#[derive(Debug, Clone, PartialEq)]
pub struct TrajectoryState {
    /// Time, s.
    pub time_s: f64,
    /// Block coordinates.
    pub state: Vec<f64>,
    /// Contact force of each stop, N.
    pub forces_n: Vec<f64>,
}

impl TrajectoryState {
    /// Returns the displacement of a port, m.
    pub fn displacement_m(&self, plant: &Plant, port: &Port) -> f64 {
        let pairs = port.displacement.iter().zip(&self.state);
        let moving: f64 = pairs.map(|(c, y)| c * y).sum();
        moving + plant.driven(port, self.time_s)[0]
    }
}

/// Values of a trajectory over time.
#[derive(Debug, Clone, PartialEq)]
pub struct SampledRows {
    /// Values of each row.
    pub values: Vec<Vec<f64>>,
    /// Contact force of each stop, N.
    pub forces_n: Vec<Vec<f64>>,
}

impl Trajectory {
    pub(crate) fn push(&mut self, segment: TrajectorySegment) {
        self.segments.push(segment);
    }

    pub(crate) fn push_impact(&mut self, port: usize, impulse_n_s: f64) {
        self.impacts.push(Impact {
            after: self.segments.len(),
            port,
            impulse_n_s,
        });
    }

    pub(crate) fn push_change(&mut self, change: ConductionChange) {
        self.changes.push(change);
    }

    /// Returns the changes of the conduction state.
    pub fn changes(&self) -> &[ConductionChange] {
        &self.changes
    }

    /// Returns the impacts on rigid stops.
    pub fn impacts(&self) -> &[Impact] {
        &self.impacts
    }

    /// Returns the steps.
    pub fn segments(&self) -> &[TrajectorySegment] {
        &self.segments
    }

    /// Returns the states at ascending times; times outside the record use its nearest segment.
    pub fn at(&self, kernel: &Kernel, times_s: &[f64]) -> Vec<TrajectoryState> {
        let mut instants = Vec::with_capacity(times_s.len());
        self.each(
            kernel,
            times_s,
            |state_kernel, conduction_state, mut instant| {
                if conduction_state != 0 {
                    let physical = state_kernel
                        .plant
                        .to_physical(&instant.state, instant.time_s);
                    instant.state = kernel.plant.from_physical(&physical, instant.time_s);
                }
                instants.push(instant);
            },
        );
        instants
    }

    /// Returns rows of the physical state `(q, q', V, i)` and the contact force of each stop at
    /// ascending times: one list of values for each row and for each stop.
    pub fn sample(&self, kernel: &Kernel, times_s: &[f64], rows: &[Vec<f64>]) -> SampledRows {
        let empty = || Vec::with_capacity(times_s.len());
        let mut sampled = SampledRows {
            values: rows.iter().map(|_| empty()).collect(),
            forces_n: kernel.plant.system.stops.iter().map(|_| empty()).collect(),
        };
        self.each(kernel, times_s, |state_kernel, _, instant| {
            let physical = state_kernel
                .plant
                .to_physical(&instant.state, instant.time_s);
            for (values, row) in sampled.values.iter_mut().zip(rows) {
                values.push(row.iter().zip(&physical).map(|(r, x)| r * x).sum());
            }
            for (forces, force_n) in sampled.forces_n.iter_mut().zip(&instant.forces_n) {
                forces.push(*force_n);
            }
        });
        sampled
    }

    /// Returns the physical state `(q, q', V, i)` at a time. Where diodes conduct, it does not use
    /// the coordinates of blocked ones, in which fast diodes leave few digits.
    pub fn physical_at(&self, kernel: &Kernel, time_s: f64) -> Vec<f64> {
        let mut state = Vec::new();
        self.each(kernel, &[time_s], |state_kernel, _, instant| {
            state = state_kernel
                .plant
                .to_physical(&instant.state, instant.time_s)
        });
        state
    }

    /// Calls a function for the states at ascending times, each in the coordinates of its
    /// conduction state.
    fn each(
        &self,
        kernel: &Kernel,
        times_s: &[f64],
        mut visit: impl FnMut(&Kernel, usize, TrajectoryState),
    ) {
        let mut cache = ResponseCache::default();
        let first_s = times_s.first().copied().unwrap_or(f64::NEG_INFINITY);
        let later = |segment: &TrajectorySegment| segment.start_s <= first_s;
        let mut index = self.segments.partition_point(later).saturating_sub(1);
        for &time_s in times_s {
            while index + 1 < self.segments.len() && self.segments[index + 1].start_s <= time_s {
                index += 1;
            }
            let Some(segment) = self.segments.get(index) else {
                break;
            };
            // The kernel of a conduction state in the record exists.
            let Ok(state_kernel) = kernel.in_conduction_state(segment.conduction_state) else {
                continue;
            };
            let mut instant = segment.free_at(state_kernel, time_s);
            let x = (time_s - segment.start_s) / segment.length_s;
            for force in &segment.forces {
                let functions = state_kernel
                    .basis(force.port, force.shape)
                    .at(x.clamp(0.0, 1.0));
                let force_n: f64 = functions
                    .iter()
                    .zip(&force.nodal_n)
                    .map(|(b, f)| b * f)
                    .sum();
                instant.forces_n[force.port] = force_n.max(0.0);
                segment.add_response(
                    state_kernel,
                    force,
                    &mut cache,
                    &|count| legendre(x, count),
                    &mut instant.state,
                );
            }
            visit(state_kernel, segment.conduction_state, instant);
        }
    }
}

/// Responses for steps of any other length, by length, port, basis and conduction state.
pub(super) type ResponseCache = HashMap<(u64, usize, ForceBasis, usize), Vec<StepResponse>>;

impl TrajectorySegment {
    /// Returns the free motion.
    fn free_at(&self, kernel: &Kernel, time_s: f64) -> TrajectoryState {
        let after_s = time_s - self.start_s;
        let mut state = kernel.plant.diagonal.block.flow(after_s, &self.state);
        kernel.plant.add_forced(&self.sizes, after_s, &mut state);
        TrajectoryState {
            time_s,
            state,
            forces_n: vec![0.0; kernel.plant.system.stops.len()],
        }
    }

    /// Adds the response to a force to a state: its weighted Legendre series.
    pub(super) fn add_response(
        &self,
        kernel: &Kernel,
        force: &PortForce,
        cache: &mut ResponseCache,
        weights: &dyn Fn(usize) -> Vec<f64>,
        state: &mut [f64],
    ) {
        let (length_s, port, shape) = (self.length_s, force.port, force.shape);
        let (block, level) = (&kernel.plant.diagonal.block, Kernel::level_within(length_s));
        let responses = if Kernel::length_s(level) == length_s {
            kernel.tables(level).responses(kernel, (port, shape))
        } else {
            let make = || StepResponse::of_all(block, kernel.basis(port, shape), length_s);
            cache
                .entry((length_s.to_bits(), port, shape, self.conduction_state))
                .or_insert_with(make)
        };
        let column = &kernel.plant.ports[port].force;
        let weights = weights(
            responses
                .iter()
                .map(|response| response.first.len())
                .max()
                .unwrap_or(0),
        );
        for ((first, part), response) in parts(block).zip(responses) {
            let sum = |series: &[F64x8]| -> f64 {
                let nodal = |lane: &F64x8| -> f64 {
                    (0..NODES).map(|j| force.nodal_n[j] * lane.0[j]).sum()
                };
                series
                    .iter()
                    .zip(&weights)
                    .map(|(lane, weight)| weight * nodal(lane))
                    .sum()
            };
            let (one, two) = (sum(&response.first), sum(&response.second));
            for s in 0..part.states() {
                let unit: [f64; 2] = std::array::from_fn(|i| if i == s { 1.0 } else { 0.0 });
                let [f, g] = part.forced(&unit, &column[first..first + part.states()], length_s);
                state[first + s] += f * one + g * two;
            }
        }
    }
}
