//! Integrals that the energy meters need for signals: `V = integral u y dt` and
//! `integral u e^{i w t} dt` for each signal `u`.
//!
//! On a piece between breakpoints, from `0` to `h`, with `y' = A y + sum_z b_z u_z + b f`, parts of
//! following blocks are
//!
//! ```text
//! Z = int y = A^-1 ([y] - sum_z b_z int u_z - b int f),    V = A^-1 ([u y] - u' Z - sum_z b_z int u u_z - b int u f)
//! ```
//!
//! and of local blocks, step by step, with `U_k` the `k`-th integral of `u` from the start of the
//! step,
//!
//! ```text
//! V = sum_k (-A)^k (U_(k+1)(h) y(h) - sum_z b_z int U_(k+1) u_z - b int U_(k+1) f)
//! ```

use super::repeated_integrals::{repeated, repeated_product};
use super::tables::ExcitationTables;
use crate::kernel::Kernel;
use jounce_linalg::c64;
use jounce_model::plant::{LOCAL_TERMS, SignalIntegrals, SignalSample};
use jounce_simd::{F64x8, LANES, Portable};
use std::sync::Arc;

/// Sums since the start of an integration, and sums over the current piece.
#[derive(Debug, Clone)]
pub(crate) struct SignalWork {
    sums: SignalIntegrals,
    /// Start of the current piece: time, signal samples and state.
    since_s: f64,
    sizes: Vec<SignalSample>,
    start: Vec<f64>,
    /// For each port, the integral of its force over the piece, and of force times each signal.
    forces: Vec<(f64, Vec<f64>)>,
    /// Nodal forces of the current step: port, and time and impulse of each node.
    nodes: Vec<(usize, [f64; LANES], F64x8)>,
    /// Angular frequency of each tone, rad/s.
    tones_rad_s: Vec<f64>,
    /// Columns of signals and ports in local blocks, and 1 in the states of local blocks.
    columns: Vec<Vec<F64x8>>,
    ports: Vec<Vec<F64x8>>,
    is_local: Vec<F64x8>,
    tables: Arc<ExcitationTables>,
    /// For each such meter, work of the contact forces on the forced motion of signals, J.
    works_j: Vec<f64>,
}

impl SignalWork {
    pub fn new(kernel: &Kernel, time_s: f64) -> Self {
        let (plant, layout, meters) = (&kernel.plant, &kernel.layout, kernel.meters());
        let (signals, none) = (plant.forcings.len(), c64::new(0.0, 0.0));
        let local_part = |column: &[f64]| {
            column
                .iter()
                .zip(&plant.local)
                .map(|(b, local)| if *local { *b } else { 0.0 })
                .collect::<Vec<_>>()
        };
        Self {
            sums: SignalIntegrals {
                states: vec![vec![0.0; plant.len()]; signals],
                tones: vec![vec![none; plant.tones.len()]; signals],
            },
            since_s: time_s,
            sizes: Vec::new(),
            start: Vec::new(),
            forces: vec![(0.0, vec![0.0; signals]); plant.ports.len()],
            nodes: Vec::new(),
            tones_rad_s: plant
                .tones
                .iter()
                .map(|tone| tone.angular_frequency_rad_s)
                .collect(),
            columns: plant
                .forcings
                .iter()
                .map(|forcing| layout.pack(&forcing.local))
                .collect(),
            ports: plant
                .ports
                .iter()
                .map(|port| layout.pack(&local_part(&port.force)))
                .collect(),
            is_local: layout.pack(&local_part(&vec![1.0; plant.len()])),
            tables: kernel.excitation_tables(),
            works_j: vec![0.0; meters.loads.len() + 1],
        }
    }

    /// Returns the start time of the current piece, s.
    pub fn since_s(&self) -> f64 {
        self.since_s
    }

    /// Opens a piece at the end of the last one, in a state with its forced part.
    pub fn open(&mut self, sizes: &[SignalSample], state: Vec<f64>) {
        self.sizes = sizes.to_vec();
        self.start = state;
        self.turn(sizes, self.since_s, -1.0);
    }

    /// Closes the current piece; samples and state are those at its end, before any jump.
    pub fn close(
        &mut self,
        kernel: &Kernel,
        sizes: &[SignalSample],
        state: &[f64],
        time_s: f64,
        length_s: Option<f64>,
    ) {
        let (plant, h) = (&kernel.plant, length_s.unwrap_or(time_s - self.since_s));
        let solve = |y: &[f64]| plant.diagonal.block.solve(y, &plant.local);
        let mut change: Vec<f64> = state
            .iter()
            .zip(&self.start)
            .map(|(end, start)| end - start)
            .collect();
        for (forcing, [u, s]) in plant.forcings.iter().zip(&self.sizes) {
            add(&mut change, -h * (u + 0.5 * s * h), &forcing.column);
        }
        for (port, (impulse, _)) in plant.ports.iter().zip(&self.forces) {
            add(&mut change, -impulse, &port.force);
        }
        let mean_state = solve(&change);
        for (k, ([u, s], [end, _])) in self.sizes.iter().zip(sizes).enumerate() {
            let mut change: Vec<f64> = state
                .iter()
                .zip(&self.start)
                .map(|(y1, y0)| end * y1 - u * y0)
                .collect();
            add(&mut change, -s, &mean_state);
            for (forcing, [v, z]) in plant.forcings.iter().zip(&self.sizes) {
                let both = h * (u * v + h * (0.5 * (u * z + s * v) + h * s * z / 3.0));
                add(&mut change, -both, &forcing.column);
            }
            for (port, (_, weighted)) in plant.ports.iter().zip(&self.forces) {
                add(&mut change, -weighted[k], &port.force);
            }
            add(&mut self.sums.states[k], 1.0, &solve(&change));
        }
        self.turn(sizes, time_s, 1.0);
        self.forces.iter_mut().for_each(|(impulse, weighted)| {
            *impulse = 0.0;
            weighted.fill(0.0);
        });
        self.since_s = time_s;
    }

    /// Adds the antiderivative of `u e^{i w t}`, which is `e^{i w t} (u / (i w) + u' / w^2)`.
    fn turn(&mut self, sizes: &[SignalSample], time_s: f64, factor: f64) {
        for (size, sums) in sizes.iter().zip(&mut self.sums.tones) {
            for (sum, w) in sums.iter_mut().zip(&self.tones_rad_s) {
                let turn = c64::cis(w * time_s) * factor;
                *sum += turn / c64::new(0.0, *w) * size[0] + turn * (size[1] / (w * w));
            }
        }
    }

    /// Adds an impulse of one signal; `middle` is the mean of the states before and after it, with
    /// their forced part.
    pub fn strike(
        &mut self,
        signal: usize,
        impulse_s: f64,
        middle: impl Iterator<Item = f64>,
        time_s: f64,
    ) {
        self.sums.states[signal]
            .iter_mut()
            .zip(middle)
            .for_each(|(sum, y)| *sum += impulse_s * y);
        for (sum, w) in self.sums.tones[signal].iter_mut().zip(&self.tones_rad_s) {
            *sum += c64::cis(w * time_s) * impulse_s;
        }
    }

    /// Adds the nodal forces of the next contact step; the signal samples are those at its start.
    #[inline(always)]
    pub fn push(
        &mut self,
        port: usize,
        sizes: &[SignalSample],
        positions: &[f64; LANES],
        length_s: f64,
        weighted: &F64x8,
    ) {
        let times_s = positions.map(|position| position * length_s);
        let (impulse, products) = &mut self.forces[port];
        *impulse += weighted.0.iter().sum::<f64>();
        for (product, [u, s]) in products.iter_mut().zip(sizes) {
            *product += times_s
                .iter()
                .zip(weighted.0)
                .map(|(t, force)| force * (u + s * t))
                .sum::<f64>();
        }
        for (work_j, readings) in self.works_j.iter_mut().zip(&self.tables.readings) {
            let series = readings[port].series(sizes);
            *work_j += times_s
                .iter()
                .zip(weighted.0)
                .map(|(t, force)| force * series.value(*t))
                .sum::<f64>();
        }
        self.nodes.push((port, times_s, *weighted));
    }

    /// Adds an impulse of a rigid stop.
    pub fn strike_stop(&mut self, port: usize, sizes: &[SignalSample], impulse_n_s: f64) {
        let impulse = F64x8(std::array::from_fn(
            |i| if i == 0 { impulse_n_s } else { 0.0 },
        ));
        self.push(port, sizes, &[0.0; LANES], 0.0, &impulse);
        // It takes no time and does not contribute to integrals over a step.
        self.nodes.clear();
    }

    /// Ends a step without moving local blocks.
    #[inline(always)]
    pub fn pass(&mut self) {
        self.nodes.clear();
    }

    /// Adds local blocks over a step; the signal samples are those at its start, `y` is the state
    /// at its end.
    #[inline(always)]
    pub fn pass_local(
        &mut self,
        kernel: &Kernel,
        sizes: &[SignalSample],
        length_s: f64,
        y: &[F64x8],
    ) {
        let lanes = y.len();
        let (mut sum, mut applied) = (vec![F64x8::ZERO; lanes], vec![F64x8::ZERO; lanes]);
        let local: Vec<F64x8> = y
            .iter()
            .zip(&self.is_local)
            .map(|(y, is)| F64x8(std::array::from_fn(|i| y.0[i] * is.0[i])))
            .collect();
        for (k, size) in sizes.iter().enumerate() {
            if *size == [0.0; 2] {
                continue;
            }
            sum.fill(F64x8::ZERO);
            for order in (1..=LOCAL_TERMS).rev() {
                // sum <- w - A sum
                kernel.generator.apply(Portable::new(), &sum, &mut applied);
                let at_end = repeated(*size, order, length_s);
                for i in 0..lanes {
                    sum[i] = F64x8::ZERO
                        .add_scaled(-1.0, &applied[i])
                        .add_scaled(at_end, &local[i]);
                }
                for (column, other) in self.columns.iter().zip(sizes) {
                    let both = repeated_product(*size, *other, order, length_s);
                    sum.iter_mut()
                        .zip(column)
                        .for_each(|(sum, b)| *sum = sum.add_scaled(-both, b));
                }
                for (port, times_s, weighted) in &self.nodes {
                    let weighted_force: f64 = times_s
                        .iter()
                        .zip(weighted.0)
                        .map(|(t, force)| force * repeated(*size, order, *t))
                        .sum();
                    sum.iter_mut()
                        .zip(&self.ports[*port])
                        .for_each(|(sum, b)| *sum = sum.add_scaled(-weighted_force, b));
                }
            }
            add(&mut self.sums.states[k], 1.0, &kernel.layout.unpack(&sum));
        }
    }

    /// Returns the integrals up to a time, and for each meter with a quadratic form the work of the
    /// contact forces on the forced motion of signals, J.
    pub fn until(
        &self,
        kernel: &Kernel,
        sizes: &[SignalSample],
        state: &[f64],
        time_s: f64,
    ) -> (SignalIntegrals, Vec<f64>) {
        let mut closed = self.clone();
        if !sizes.is_empty() {
            closed.close(kernel, sizes, state, time_s, None);
        }
        (closed.sums, closed.works_j)
    }
}

fn add(sum: &mut [f64], factor: f64, values: &[f64]) {
    sum.iter_mut()
        .zip(values)
        .for_each(|(sum, value)| *sum += factor * value);
}
