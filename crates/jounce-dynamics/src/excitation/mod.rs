//! Excitation by signals, which are drives that are linear in time between breakpoints.
//!
//! The integrator advances `y`, the state without its forced part `P` (see
//! [`jounce_model::plant::Forcing`]). At the end of each step the forced motion of local blocks is
//! added to `y`, so that their `P` restarts at zero and stays small. From the current time on, the
//! forced displacement of a port is a polynomial in time. The bound on its fourth derivative adds
//! to the bound of the certificate; it is zero where every block is fast relative to the samples of
//! the drive. No step crosses a breakpoint. The motions of bases under signals are additional
//! cubics (see [`jounce_model::drive::Travel`]).

mod breakpoints;
mod cursor;
mod local_motions;
mod port;
mod repeated_integrals;
pub(crate) mod row;
pub(crate) mod signal_work;
pub(crate) mod tables;

use crate::flow::Flow;
use crate::flow::layout::StateLayout;
use crate::kernel::Kernel;
use cursor::SignalCursor;
use jounce_model::plant::SignalSample;
use jounce_simd::{F64x8, LANES, Simd};
use local_motions::LocalMotions;
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
    /// Longest step under signals that are not silent, s.
    limit_s: f64,
    /// For each port, its row over the signals and its forced motion from the current time on.
    ports: Vec<PortExcitation>,
    /// Work of the bases moved by signals through the contacts since the start, J.
    pub base_work_j: f64,
    has_local: bool,
    local_motions: LocalMotions,
    tables: Arc<ExcitationTables>,
    pub signal_work: SignalWork,
}

impl Excitation {
    pub fn new(kernel: &Kernel, time_s: f64, held_a: &[f64]) -> Self {
        let (plant, layout) = (&kernel.plant, &kernel.layout);
        let cursors: Vec<SignalCursor> = plant
            .system
            .signals
            .iter()
            .zip(&plant.forcings)
            .zip(&plant.travels)
            .map(|(both, travel)| SignalCursor::at(layout, both, travel.clone(), (time_s, held_a)))
            .collect();
        let sizes: Vec<SignalSample> = cursors
            .iter()
            .map(|cursor| [cursor.piece.size_at(time_s), cursor.piece.slope])
            .collect();
        let tables = kernel.excitation_tables();
        let mut forced = Self {
            sizes,
            next_s: 0.0,
            limit_s: plant.local_limit_s(),
            ports: tables.ports.clone(),
            base_work_j: 0.0,
            has_local: !cursors.is_empty() && plant.local.contains(&true),
            local_motions: LocalMotions::default(),
            signal_work: SignalWork::new(kernel, time_s),
            tables,
            cursors,
        };
        forced.find_next();
        forced.aim(time_s);
        forced
    }

    /// Starts to count energies: `y` is the state at the start of the integration.
    pub fn open(&mut self, layout: &StateLayout, y: &[F64x8]) {
        if !self.is_silent() {
            self.signal_work
                .open(&self.sizes, self.full_state(layout, y));
        }
    }

    /// True when there is no signal.
    #[inline(always)]
    pub fn is_silent(&self) -> bool {
        self.cursors.is_empty()
    }

    /// Returns the state with its forced part.
    pub fn full_state(&self, layout: &StateLayout, y: &[F64x8]) -> Vec<f64> {
        let mut full_state = y.to_vec();
        for (cursor, [size, slope]) in self.cursors.iter().zip(&self.sizes) {
            for (i, lane) in full_state.iter_mut().enumerate() {
                *lane = lane
                    .add_scaled(*size, &cursor.rest[i])
                    .add_scaled(*slope, &cursor.lag[i]);
            }
        }
        layout.unpack(&full_state)
    }

    /// Returns the latest end of a step from a time on, s: a breakpoint, or the limit of the series
    /// of local blocks.
    #[inline(always)]
    pub fn until_s(&self, time_s: f64) -> f64 {
        if self.limit_s.is_finite() && self.sizes.iter().any(|size| *size != [0.0; 2]) {
            self.next_s.min(time_s + self.limit_s)
        } else {
            self.next_s
        }
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

    /// Records the nodal forces of the next step; `weighted` holds force times weight times length,
    /// N s.
    #[inline(always)]
    pub fn push(&mut self, port: usize, positions: &[f64; LANES], length_s: f64, weighted: &F64x8) {
        if !self.cursors.is_empty() {
            self.signal_work
                .push(port, &self.sizes, positions, length_s, weighted);
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
    pub fn strike_stop(&mut self, port: usize, impulse_n_s: f64) {
        if !self.cursors.is_empty() {
            self.signal_work.strike_stop(port, &self.sizes, impulse_n_s);
            self.base_work_j += impulse_n_s * self.ports[port].base_speed_m_s(0.0);
        }
    }

    /// Advances to the end of a step; `y` is the state there and receives the forced motion of
    /// local blocks.
    #[inline(always)]
    pub fn pass(&mut self, kernel: &Kernel, length_s: f64, time_s: f64, y: &mut [F64x8]) {
        if self.cursors.is_empty() {
            return;
        }
        if self.has_local && self.sizes.iter().any(|size| *size != [0.0; 2]) {
            let local_motion = self.local_motions.over(
                kernel,
                self.cursors.iter().map(|cursor| &cursor.local),
                length_s,
            );
            for (by, [size, slope]) in local_motion.iter().zip(&self.sizes) {
                for (i, y) in y.iter_mut().enumerate() {
                    *y = y.add_scaled(*size, &by[0][i]).add_scaled(*slope, &by[1][i]);
                }
            }
            self.signal_work
                .pass_local(kernel, &self.sizes, length_s, y);
        }
        self.signal_work.pass();
        for (size, cursor) in self.sizes.iter_mut().zip(&self.cursors) {
            size[0] = cursor.piece.size_at(time_s);
        }
        self.aim(time_s);
    }

    fn find_next(&mut self) {
        self.next_s = self.cursors.iter().fold(f64::INFINITY, |least, cursor| {
            least.min(cursor.piece.until_s)
        });
    }

    /// Sets the forced displacements of the ports from the current time on.
    #[inline(always)]
    fn aim(&mut self, time_s: f64) {
        for excitation in &mut self.ports {
            excitation.series = excitation.reading.series(&self.sizes);
            if !excitation.approach.is_empty() {
                excitation.follow(&self.cursors, &self.sizes, time_s);
            }
        }
    }
}
