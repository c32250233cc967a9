//! Excitation by signals, which are drives that are linear in time between breakpoints.
//!
//! The integrator advances `y`, the state without its forced part `P` (see
//! [`jounce_model::plant::Forcing`]). At the end of each step the forced motion of local blocks is
//! added to `y`, so that their `P` restarts at zero and stays small. From the current time on, the
//! forced displacement of a port is a polynomial in time. The bound on its fourth derivative adds
//! to the bound of the certificate; it is zero where every block is fast relative to the samples of
//! the drive. No step crosses a breakpoint. The motions of bases under signals are additional
//! cubics (see [`jounce_model::drive::Travel`]).

mod block_sums;
pub(crate) mod breakpoints;
mod cursor;
mod following_blocks;
mod local_blocks;
mod port;
pub(crate) mod row;
pub(crate) mod signal_work;
pub(crate) mod tables;
mod taylor_weights;

use crate::flow::Flow;
use crate::kernel::Kernel;
use cursor::SignalCursor;
use jounce_model::plant::{SignalSample, local_limit_s};
use jounce_simd::{F64x8, LANES, Portable, Simd};
use local_blocks::LocalStep;
use port::PortExcitation;
use signal_work::SignalWork;
use std::sync::Arc;
use tables::ExcitationTables;

/// All signals at the current time of an integration.
#[derive(Debug, Clone)]
pub(super) struct Excitation {
    cursors: Vec<SignalCursor>,
    /// Value and slope of each signal at the current time.
    pub sizes: Vec<SignalSample>,
    /// Earliest breakpoint, s.
    next_s: f64,
    /// Largest `|eigenvalue|` of the blocks that are local to a signal that is not 0, rad/s.
    fastest_rad_s: f64,
    /// For each port, its row over the signals and its forced motion from the current time on.
    ports: Vec<PortExcitation>,
    /// Work of the bases moved by signals through the contacts since the start, J.
    pub base_work_j: f64,
    /// Buffer for a state with its forced part.
    full: Vec<F64x8>,
    tables: Arc<ExcitationTables>,
    pub signal_work: SignalWork,
}

impl Excitation {
    pub fn new(kernel: &Kernel, time_s: f64) -> Self {
        let mut forced = Self {
            cursors: Vec::new(),
            sizes: Vec::new(),
            next_s: 0.0,
            fastest_rad_s: 0.0,
            ports: Vec::new(),
            base_work_j: 0.0,
            full: Vec::new(),
            signal_work: SignalWork::new(kernel, time_s),
            tables: kernel.excitation_tables(),
        };
        forced.enter(kernel, time_s, &[]);
        forced
    }

    /// Enters a kernel at a time; `held_a` are the currents that the bridges draw from their
    /// storages. All conduction states share the first signals, which continue in their pieces; each
    /// has constants of its own after them, for the offsets of its voltages.
    pub fn enter(&mut self, kernel: &Kernel, time_s: f64, held_a: &[f64]) {
        let plant = &kernel.plant;
        let signals = plant.system.signals.iter().zip(&plant.travels);
        let cursors = signals.enumerate().map(|(k, (signal, travel))| {
            let index = match self.cursors.get(k) {
                Some(cursor) => cursor.index,
                None => signal.wave.index_at(time_s),
            };
            SignalCursor::new(signal, travel.clone(), index, held_a)
        });
        self.cursors = cursors.collect();
        let sample = |cursor: &SignalCursor| [cursor.piece.size_at(time_s), cursor.piece.slope];
        self.sizes.clear();
        self.sizes.extend(self.cursors.iter().map(sample));
        self.find_next();
        self.tables = kernel.excitation_tables();
        self.ports.clone_from(&self.tables.ports);
        self.base_work_j = 0.0;
        if !self.is_silent() {
            self.full.resize(kernel.layout.lanes(), F64x8::ZERO);
        }
        self.signal_work.restart(kernel, time_s);
        self.aim(Portable::new(), time_s);
    }

    /// Starts to count energies in a state with its forced part.
    pub fn open(&mut self, full: &[F64x8]) {
        if !self.is_silent() {
            self.signal_work.open(&self.sizes, full);
        }
    }

    /// True when there is no signal.
    #[inline(always)]
    pub fn is_silent(&self) -> bool {
        self.cursors.is_empty()
    }

    /// Returns the vectors of the state with its forced part.
    pub fn full_lanes(&self, y: &[F64x8]) -> Vec<F64x8> {
        let mut full = y.to_vec();
        self.add_forced(Portable::new(), &mut full);
        full
    }

    /// Adds the forced part to a state.
    #[inline(always)]
    fn add_forced<W: Simd>(&self, w: W, state: &mut [F64x8]) {
        for (signal, [size, slope]) in self.tables.signals.iter().zip(&self.sizes) {
            let (size, slope) = (w.splat(*size), w.splat(*slope));
            for (lane, (rest, lag)) in state.iter_mut().zip(signal.rest.iter().zip(&signal.lag)) {
                let by_value = w.fma(size, w.load(rest), w.load(lane));
                *lane = w.store(w.fma(slope, w.load(lag), by_value));
            }
        }
    }

    /// Returns the latest end of a step from a time on, s: a breakpoint, or the limit of the series
    /// of local blocks.
    #[inline(always)]
    pub fn until_s(&self, time_s: f64) -> f64 {
        self.next_s.min(time_s + local_limit_s(self.fastest_rad_s))
    }

    /// True at a breakpoint that has not been passed.
    #[inline(always)]
    pub fn has_breakpoint(&self, time_s: f64) -> bool {
        self.next_s <= time_s
    }

    /// Returns the time from now to a later time, s. A complete piece of an evenly sampled signal
    /// has a bitwise equal length everywhere, so that its tables can be cached.
    #[inline(always)]
    pub fn remaining_s(&self, time_s: f64, end_s: f64) -> f64 {
        match self.tables.moving.map(|index| &self.cursors[index].piece) {
            Some(piece) if end_s == self.next_s && time_s == piece.from_s => piece.length_s,
            _ => end_s - time_s,
        }
    }

    /// Returns the flow over a complete piece of an evenly sampled signal.
    #[inline(always)]
    pub fn flow_over(&self, length_s: f64) -> Option<&Flow> {
        self.tables
            .piece
            .as_ref()
            .filter(|(piece_s, _)| *piece_s == length_s)
            .map(|(_, flow)| flow)
    }

    /// Returns the forced displacement (m) and velocity (m/s) of a port a time after the current
    /// one.
    #[inline(always)]
    pub fn motion_after(&self, port: usize, after_s: f64) -> [f64; 2] {
        self.ports
            .get(port)
            .map_or([0.0; 2], |excitation| excitation.series.motion(after_s))
    }

    /// Returns the forced acceleration of a port a time after the current one, m/s^2.
    #[inline(always)]
    pub fn acceleration_after(&self, port: usize, after_s: f64) -> f64 {
        self.ports
            .get(port)
            .map_or(0.0, |excitation| excitation.series.curvature(after_s))
    }

    /// Returns a bound on the fourth derivative of the forced displacement of a port over a step,
    /// m/s^4.
    #[inline(always)]
    pub fn fourth_bound(&self, port: usize, length_s: f64) -> f64 {
        self.ports
            .get(port)
            .map_or(0.0, |excitation| excitation.series.fourth_bound(length_s))
    }

    /// Adds the forced displacement and velocity of a port at the nodes and the end of a step to
    /// registers.
    #[inline(always)]
    pub fn motions<W: Simd>(
        &self,
        w: W,
        port: usize,
        positions: &[f64; LANES],
        length_s: f64,
        sums: [W::Register; 2],
    ) -> [W::Register; 2] {
        let Some(PortExcitation { series, .. }) = self.ports.get(port) else {
            return sums;
        };
        let (mut displacement, mut speed) = (F64x8::ZERO, F64x8::ZERO);
        for ((part, displacement), speed) in
            positions.iter().zip(&mut displacement.0).zip(&mut speed.0)
        {
            [*displacement, *speed] = series.motion(part * length_s);
        }
        [
            w.add(sums[0], w.load(&displacement)),
            w.add(sums[1], w.load(&speed)),
        ]
    }

    /// Records the nodal forces of the next step, which starts at a time; `weighted` holds force times
    /// weight times length, N s.
    #[inline(always)]
    pub fn push(
        &mut self,
        port: usize,
        positions: &[f64; LANES],
        (time_s, length_s): (f64, f64),
        weighted: &F64x8,
    ) {
        if !self.cursors.is_empty() {
            self.signal_work
                .push(port, &self.sizes, positions, (time_s, length_s), weighted);
            let excitation = &self.ports[port];
            if !excitation.approach.is_empty() {
                self.base_work_j += positions
                    .iter()
                    .zip(weighted.0)
                    .map(|(part, force)| force * excitation.base_speed_m_s(part * length_s))
                    .sum::<f64>();
            }
        }
    }

    /// Records an impulse of a rigid stop, N s.
    pub fn strike_stop(&mut self, port: usize, time_s: f64, impulse_n_s: f64) {
        if !self.cursors.is_empty() {
            self.signal_work
                .strike_stop(port, &self.sizes, time_s, impulse_n_s);
            self.base_work_j += impulse_n_s * self.ports[port].base_speed_m_s(0.0);
        }
    }

    /// Advances to the end of a step; the states are those at its start and at its end, which
    /// receives the forced motion of local blocks.
    #[inline(always)]
    pub fn pass<W: Simd>(
        &mut self,
        w: W,
        kernel: &Kernel,
        length_s: f64,
        time_s: f64,
        (start, y): (&[F64x8], &mut [F64x8]),
    ) {
        if self.cursors.is_empty() {
            return;
        }
        w.out_of_line(
            #[inline(always)]
            || {
                let local = LocalStep {
                    tables: &self.tables,
                    fastest_rad_s: self.fastest_rad_s,
                    generator: &kernel.generator,
                    sizes: &self.sizes,
                    nodes: &self.signal_work.nodes,
                    length_s,
                };
                local.pass(w, start, y, &mut self.signal_work.states);
                self.signal_work.nodes.clear();
                for (size, cursor) in self.sizes.iter_mut().zip(&self.cursors) {
                    size[0] = cursor.piece.size_at(time_s);
                }
                self.aim(w, time_s);
            },
        );
    }

    fn find_next(&mut self) {
        self.next_s = self.cursors.iter().fold(f64::INFINITY, |least, cursor| {
            least.min(cursor.piece.until_s)
        });
    }

    /// Sets the forced displacements of the ports from the current time on.
    #[inline(always)]
    fn aim<W: Simd>(&mut self, w: W, time_s: f64) {
        self.fastest_rad_s = row::fastest_driven_rad_s(&self.tables.fastest_rad_s, &self.sizes);
        let longest_s = self.until_s(time_s) - time_s;
        let terms = row::terms(self.fastest_rad_s, longest_s);
        for excitation in &mut self.ports {
            excitation.series = excitation.reading.first_terms(w, &self.sizes, terms);
            if !excitation.approach.is_empty() {
                excitation.follow(&self.cursors, &self.sizes, time_s);
            }
        }
    }
}
