//! Outputs of a linearisation whose derivatives are wanted: the energy of the loads, and states at
//! given times.
//!
//! With the voltage of a load as a Legendre series, its energy on a step is
//! `h sum V_n^2 / ((2 n + 1) R)` (Parseval), so that the derivative is exact for the computed motion.

use super::functional::Functional;
use super::{ParameterStep, Parameters};
use crate::force_response::basis::{NODES, legendre};
use crate::kernel::Kernel;
use crate::record::trajectory::TrajectorySegment;
use crate::sensitivity::elimination::NodeSystem;
use crate::sensitivity::tangents::Tangents;
use jounce_linalg::c64;
use jounce_model::plant::{Plant, Tone};
use jounce_simd::F64x8;

/// A load that a patch feeds.
pub struct LoadOutput {
    /// Row of the voltage, block coordinates.
    row: Vec<f64>,
    /// Complex voltage under each tone.
    steady: Vec<c64>,
    factor_per_ohm: f64,
}

/// A state with its tangents.
pub struct StateTangents {
    pub time_s: f64,
    pub state: Vec<f64>,
    pub by: Vec<Vec<F64x8>>,
    pub forces_by: Vec<Vec<F64x8>>,
}

impl LoadOutput {
    /// Returns the loads of a plant that a patch feeds.
    pub fn of_all(plant: &Plant) -> Vec<Self> {
        let loads = plant.system.loads.iter().enumerate();
        let fed = loads.filter(|(k, _)| plant.electrical.load[*k].is_some());
        fed.map(|(k, load)| {
            let row = plant.load_voltage_row(k);
            Self {
                steady: plant.steady_output(&row),
                factor_per_ohm: 1.0 / load.resistance_ohm,
                row,
            }
        })
        .collect()
    }
}

impl LoadOutput {
    /// Returns the derivative of the energy by a shift of the step in time, at states that the shift
    /// does not change, back at fixed times, W.
    fn by_shift(
        &self,
        plant: &Plant,
        step: &ParameterStep,
        (voltage, weights): (&[f64], &[f64]),
    ) -> f64 {
        let tones = plant.tones.iter().zip(&self.steady).zip(&step.motion.tones);
        let moving = |((tone, steady), series): ((&Tone, &c64), &Vec<c64>)| -> f64 {
            let turned: c64 = weights.iter().zip(series).map(|(w, turn)| turn * *w).sum();
            (c64::new(0.0, tone.angular_frequency_rad_s) * steady * turned).re
        };
        let alternating = |(n, v): (usize, &f64)| if n % 2 == 0 { *v } else { -v };
        let start_v: f64 = voltage.iter().enumerate().map(alternating).sum();
        let end_v: f64 = voltage.iter().sum();
        let gain = self.factor_per_ohm * (end_v * end_v - start_v * start_v);
        tones.map(moving).sum::<f64>() - gain
    }
}

impl Parameters<'_> {
    /// Adds the outputs on a step: `tangents` at its start, counted from the start of a contact
    /// that is later by `shift_s`, and the derivatives of the nodal forces in `system`.
    pub fn add_outputs(
        &mut self,
        kernel: &Kernel,
        segment: &TrajectorySegment,
        step: &ParameterStep,
        tangents: &Tangents,
        system: Option<&NodeSystem>,
        shift_s: Option<&[F64x8]>,
    ) {
        for index in 0..self.loads.len() {
            self.add_energy(kernel, step, index, (tangents, system), shift_s);
        }
        let end_s = segment.start_s + segment.length_s;
        let wanted = self.request.times_s;
        for time_s in &wanted[self.states.len()..] {
            if *time_s >= end_s {
                break;
            }
            let x = ((time_s - segment.start_s) / segment.length_s).max(0.0);
            self.states
                .push(self.state(kernel, step, (tangents, system), (*time_s, x), segment));
        }
    }

    /// Adds the energy of a load on a step.
    fn add_energy(
        &mut self,
        kernel: &Kernel,
        step: &ParameterStep,
        index: usize,
        (tangents, system): (&Tangents, Option<&NodeSystem>),
        shift_s: Option<&[F64x8]>,
    ) {
        let (motion, load) = (&step.motion, &self.loads[index]);
        let h = motion.length_s;
        let mut voltage = vec![0.0; motion.terms];
        for (c, series) in load.row.iter().zip(&motion.states) {
            voltage
                .iter_mut()
                .zip(series)
                .for_each(|(v, y)| *v += c * y);
        }
        for (steady, series) in load.steady.iter().zip(&motion.tones) {
            voltage
                .iter_mut()
                .zip(series)
                .for_each(|(v, turn)| *v += (steady * turn).re);
        }
        let norm = |n: usize| h / (2 * n + 1) as f64;
        let square: f64 = voltage
            .iter()
            .enumerate()
            .map(|(n, v)| norm(n) * v * v)
            .sum();
        self.energy_j += load.factor_per_ohm * square;
        let weights: Vec<f64> = (voltage.iter().enumerate())
            .map(|(n, v)| 2.0 * load.factor_per_ohm * norm(n) * v)
            .collect();
        let functional = Functional {
            block: &kernel.plant.diagonal.block,
            row: &load.row,
            weights: &weights,
            length_s: h,
        };
        let by_start = functional.of_start(&motion.free);
        add_rows(&mut self.energy, tangents, &by_start);
        if let Some(system) = system {
            for (at, (port, responses, _)) in motion.forces.iter().enumerate() {
                let by_force = functional.of_force(responses, &kernel.plant.ports[*port].force);
                add_forces(&mut self.energy, (system, at), &by_force);
            }
        }
        if let Some(shift_s) = shift_s {
            let factor = load.by_shift(&kernel.plant, step, (&voltage, &weights));
            add_scaled(&mut self.energy, factor, shift_s);
        }
        for g in 0..self.groups.len() {
            let sum = self.by_parameters(&kernel.plant, step, (index, g), (&weights, square));
            let lane = &mut self.energy[self.first + g];
            *lane = lane.add_scaled(1.0, &sum);
        }
    }

    /// Returns the derivatives of the energy of a load by the parameters of a group at fixed forces
    /// and a fixed start; `square` is the integral of the squared voltage, V^2 s.
    fn by_parameters(
        &self,
        plant: &Plant,
        step: &ParameterStep,
        (index, g): (usize, usize),
        (weights, square): (&[f64], f64),
    ) -> F64x8 {
        let (motion, load) = (&step.motion, &self.loads[index]);
        let (group, forced) = (&self.groups[g], &step.forced[g]);
        let (row, factor) = &group.loads[index];
        let mut sum = F64x8::ZERO.add_scaled(square, factor);
        for (state, (c, p)) in load.row.iter().zip(forced).enumerate() {
            for (weight, p) in weights.iter().zip(p) {
                sum = sum.add_scaled(weight * c, p);
            }
            sum = sum.add_scaled(product(weights, &motion.states[state]), &row[state]);
        }
        for ((tone, series), by) in plant.tones.iter().zip(&motion.tones).zip(&group.tones) {
            let turned: c64 = weights.iter().zip(series).map(|(w, turn)| turn * *w).sum();
            let states = load.row.iter().zip(row).zip(&tone.steady).zip(&by.steady);
            for (((own, row), steady), [re, im]) in states {
                sum = sum
                    .add_scaled(own * turned.re, re)
                    .add_scaled(-own * turned.im, im)
                    .add_scaled((steady * turned).re, row);
            }
        }
        sum
    }

    /// Returns the state at a place of a step with its tangents.
    fn state(
        &self,
        kernel: &Kernel,
        step: &ParameterStep,
        (tangents, system): (&Tangents, Option<&NodeSystem>),
        (time_s, x): (f64, f64),
        segment: &TrajectorySegment,
    ) -> StateTangents {
        let motion = &step.motion;
        let values = legendre(x, motion.terms);
        let n = kernel.plant.len();
        let units: Vec<Vec<f64>> = (0..n)
            .map(|state| (0..n).map(|k| f64::from(u8::from(k == state))).collect())
            .collect();
        let functional = |row| Functional {
            block: &kernel.plant.diagonal.block,
            row,
            weights: &values,
            length_s: motion.length_s,
        };
        let mut by = vec![vec![F64x8::ZERO; tangents.width]; n];
        let none = vec![F64x8::ZERO; tangents.width];
        let mut forces_by = vec![none; kernel.plant.system.stops.len()];
        for (unit, sum) in units.iter().zip(&mut by) {
            add_rows(sum, tangents, &functional(unit).of_start(&motion.free));
        }
        let forces = motion.forces.iter().zip(&segment.forces).enumerate();
        for (at, ((port, responses, _), force)) in forces {
            let Some(system) = system else {
                break;
            };
            let functions = kernel.basis(force.port, force.shape).at(x.min(1.0));
            let column = &kernel.plant.ports[*port].force;
            add_forces(&mut forces_by[*port], (system, at), &functions);
            for (unit, sum) in units.iter().zip(&mut by) {
                let factors = functional(unit).of_force(responses, column);
                add_forces(sum, (system, at), &factors);
            }
        }
        for (g, forced) in step.forced.iter().enumerate() {
            for (sum, p) in by.iter_mut().zip(forced) {
                let pairs = p.iter().zip(&values);
                let lane = &mut sum[self.first + g];
                *lane = pairs.fold(*lane, |sum, (p, value)| sum.add_scaled(*value, p));
            }
        }
        StateTangents {
            time_s,
            state: motion
                .states
                .iter()
                .map(|series| product(&values, series))
                .collect(),
            by,
            forces_by,
        }
    }
}

/// Adds the tangents of all states, each times a factor, to a row of columns.
fn add_rows(sum: &mut [F64x8], tangents: &Tangents, factors: &[f64]) {
    for (lane, group) in sum.iter_mut().zip(tangents.groups()) {
        let pairs = group.iter().zip(factors);
        *lane = pairs.fold(*lane, |sum, (tangent, factor)| {
            sum.add_scaled(*factor, tangent)
        });
    }
}

/// Adds the derivatives of the nodal forces of a port, by its index, each times a factor.
fn add_forces(sum: &mut [F64x8], (system, port): (&NodeSystem, usize), factors: &[f64; NODES]) {
    for (lane, sum) in sum.iter_mut().enumerate() {
        let forces = system.solution(port, lane).iter().zip(factors);
        *sum = forces.fold(*sum, |sum, (force, factor)| sum.add_scaled(*factor, force));
    }
}

fn add_scaled(sum: &mut [F64x8], factor: f64, row: &[F64x8]) {
    for (lane, value) in sum.iter_mut().zip(row) {
        *lane = lane.add_scaled(factor, value);
    }
}

fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
