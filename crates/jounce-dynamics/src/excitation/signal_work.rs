//! Integrals that the energy meters need for signals: `V = integral u y dt` and
//! `integral u e^{i w t} dt` for each signal `u`.
//!
//! They are sums over the pieces between breakpoints for following blocks (see
//! [`super::following_blocks`]), and over the steps for local blocks (see [`super::local_blocks`]).

use super::following_blocks::SignalPiece;
use super::local_blocks::NodalForces;
use super::tables::ExcitationTables;
use crate::kernel::Kernel;
use jounce_linalg::c64;
use jounce_model::plant::{SignalIntegrals, SignalSample};
use jounce_simd::{F64x8, LANES, Portable, Simd};
use std::sync::Arc;

/// Sums since the start of an integration, and sums over the current piece.
#[derive(Debug, Clone)]
pub(crate) struct SignalWork {
    /// Per signal: `integral u y dt`.
    pub(super) states: Vec<Vec<F64x8>>,
    /// Per signal and tone: `integral u e^{i w t} dt`.
    tones: Vec<Vec<c64>>,
    /// Start of the current piece: time, signal samples and state.
    since_s: f64,
    sizes: Vec<SignalSample>,
    start: Vec<F64x8>,
    /// For each port, the integral of its force over the piece, N s, and of the force times the time
    /// since the start of the piece, N s^2.
    forces: Vec<[f64; 2]>,
    /// Nodal forces of the current step.
    pub(super) nodes: Vec<NodalForces>,
    /// Angular frequency of each tone, rad/s.
    tones_rad_s: Vec<f64>,
    tables: Arc<ExcitationTables>,
    /// For each such meter, work of the contact forces on the forced motion of signals, J.
    works_j: Vec<f64>,
}

impl SignalWork {
    pub fn new(kernel: &Kernel, time_s: f64) -> Self {
        let mut work = Self {
            states: Vec::new(),
            tones: Vec::new(),
            since_s: time_s,
            sizes: Vec::new(),
            start: Vec::new(),
            forces: Vec::new(),
            nodes: Vec::new(),
            tones_rad_s: Vec::new(),
            tables: kernel.excitation_tables(),
            works_j: Vec::new(),
        };
        work.restart(kernel, time_s);
        work
    }

    /// Empties all sums, and counts in the coordinates of a kernel from a time on.
    pub fn restart(&mut self, kernel: &Kernel, time_s: f64) {
        let (plant, none) = (&kernel.plant, c64::new(0.0, 0.0));
        let signals = plant.forcings.len();
        let lanes = match signals {
            0 => 0,
            _ => kernel.layout.lanes(),
        };
        self.states.resize(signals, Vec::new());
        for state in self.states.iter_mut().chain([&mut self.start]) {
            state.clear();
            state.resize(lanes, F64x8::ZERO);
        }
        self.tones.resize(signals, Vec::new());
        for sums in &mut self.tones {
            sums.clear();
            sums.resize(plant.tones.len(), none);
        }
        self.since_s = time_s;
        self.forces.clear();
        self.forces.resize(plant.ports.len(), [0.0; 2]);
        self.nodes.clear();
        let frequencies = (plant.tones.iter()).map(|tone| tone.angular_frequency_rad_s);
        self.tones_rad_s = frequencies.collect();
        self.tables = kernel.excitation_tables();
        self.works_j = vec![0.0; kernel.meters().loads.len() + 1];
    }

    /// Returns the start time of the current piece, s.
    pub fn since_s(&self) -> f64 {
        self.since_s
    }

    /// Opens a piece at the end of the last one, in a state with its forced part.
    #[inline(always)]
    pub fn open(&mut self, sizes: &[SignalSample], state: &[F64x8]) {
        self.sizes.clear();
        self.sizes.extend_from_slice(sizes);
        self.start.copy_from_slice(state);
        self.turn(sizes, self.since_s, -1.0);
    }

    /// Closes the current piece; samples and state are those at its end, before any jump.
    #[inline(always)]
    pub fn close<W: Simd>(
        &mut self,
        w: W,
        sizes: &[SignalSample],
        state: &[F64x8],
        time_s: f64,
        length_s: Option<f64>,
    ) {
        let piece = SignalPiece {
            tables: &self.tables,
            sizes: &self.sizes,
            forces: &self.forces,
            length_s: length_s.unwrap_or(time_s - self.since_s),
        };
        piece.close(w, [&self.start, state], &mut self.states);
        self.turn(sizes, time_s, 1.0);
        self.forces.fill([0.0; 2]);
        self.since_s = time_s;
    }

    /// Adds the antiderivative of `u e^{i w t}`, which is `e^{i w t} (u / (i w) + u' / w^2)`.
    fn turn(&mut self, sizes: &[SignalSample], time_s: f64, factor: f64) {
        for (size, sums) in sizes.iter().zip(&mut self.tones) {
            for (sum, w) in sums.iter_mut().zip(&self.tones_rad_s) {
                let turn = c64::cis(w * time_s) * factor;
                *sum += turn / c64::new(0.0, *w) * size[0] + turn * (size[1] / (w * w));
            }
        }
    }

    /// Adds an impulse of one signal; `middle` is the mean of the states before and after it, with
    /// their forced part.
    pub fn strike(&mut self, signal: usize, impulse_s: f64, middle: &[F64x8], time_s: f64) {
        for (sum, middle) in self.states[signal].iter_mut().zip(middle) {
            *sum = sum.add_scaled(impulse_s, middle);
        }
        for (sum, w) in self.tones[signal].iter_mut().zip(&self.tones_rad_s) {
            *sum += c64::cis(w * time_s) * impulse_s;
        }
    }

    /// Adds the nodal forces of the next contact step, which starts at a time; the signal samples are
    /// those at its start.
    #[inline(always)]
    pub fn push(
        &mut self,
        port: usize,
        sizes: &[SignalSample],
        positions: &[f64; LANES],
        (time_s, length_s): (f64, f64),
        weighted: &F64x8,
    ) {
        let times_s = positions.map(|position| position * length_s);
        let (since_s, impulses) = (time_s - self.since_s, times_s.iter().zip(weighted.0));
        let [impulse, turning] = &mut self.forces[port];
        for (t, force) in impulses {
            *impulse += force;
            *turning += force * (since_s + t);
        }
        for (work_j, readings) in self.works_j.iter_mut().zip(&self.tables.readings) {
            let series = readings[port].series(sizes, length_s);
            *work_j += times_s
                .iter()
                .zip(weighted.0)
                .map(|(t, force)| force * series.value(*t))
                .sum::<f64>();
        }
        self.nodes.push((port, times_s, *weighted));
    }

    /// Adds an impulse of a rigid stop.
    pub fn strike_stop(
        &mut self,
        port: usize,
        sizes: &[SignalSample],
        time_s: f64,
        impulse_n_s: f64,
    ) {
        let impulse = F64x8(std::array::from_fn(
            |i| if i == 0 { impulse_n_s } else { 0.0 },
        ));
        self.push(port, sizes, &[0.0; LANES], (time_s, 0.0), &impulse);
        // It takes no time and does not contribute to integrals over a step.
        self.nodes.clear();
    }

    /// Ends at a time, and returns the integrals up to it, and for each meter with a quadratic form
    /// the work of the contact forces on the forced motion of signals, J. The state has its forced
    /// part. The sums are empty afterwards.
    pub fn end(
        &mut self,
        kernel: &Kernel,
        sizes: &[SignalSample],
        state: &[F64x8],
        time_s: f64,
    ) -> (SignalIntegrals, Vec<f64>) {
        if !sizes.is_empty() {
            self.close(Portable::new(), sizes, state, time_s, None);
        }
        let states = self.states.iter().map(|sum| kernel.layout.unpack(sum));
        let integrals = SignalIntegrals {
            states: states.collect(),
            tones: std::mem::take(&mut self.tones),
        };
        (integrals, std::mem::take(&mut self.works_j))
    }
}
