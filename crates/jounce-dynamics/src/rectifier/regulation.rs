//! Regulators in an integration: where the storage voltage passes a limit of its band, or a phase of
//! the device ends, the regulator draws another current (see [`jounce_model::plant::Regulator`]).
//!
//! Nothing else changes: the state is continuous, and the plant remains the same.

use super::energies::RectifiedEnergies;
use crate::integrator::Integrator;
use jounce_model::plant::{BridgeChange, EventFunction, Regulator, SignalIntegrals, VoltageBand};
use jounce_simd::Portable;

/// Operation of one device since the start of a run, or since the last reset.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DeviceStatistics {
    /// Time of the first start of the regulator in the complete run, s; `None` before it.
    pub cold_start_s: Option<f64>,
    /// Time on, s.
    pub on_s: f64,
    /// Number of starts.
    pub starts: u64,
    /// Longest time off, s, with one in progress.
    pub longest_outage_s: f64,
    /// Number of completed tasks: a measurement, a transmission, or both, up to the sleep.
    pub completed_tasks: u64,
    /// Number of tasks that a stop of the regulator interrupted.
    pub interrupted_tasks: u64,
    /// Charge drawn from the storage beyond the idle current, C.
    pub drawn_c: f64,
}

/// One regulator at the current time.
#[derive(Debug, Clone)]
pub(crate) struct Regulation {
    regulator: Regulator,
    /// Phase of the device; `None` while off.
    phase: Option<usize>,
    band_index: i32,
    band: VoltageBand,
    /// Time up to which everything is counted, s.
    counted_s: f64,
    /// End of the phase, s.
    until_s: f64,
    /// Start of the current time off, or the last reset, s.
    off_since_s: f64,
    statistics: DeviceStatistics,
    /// Charge drawn in the current conduction state, C.
    drawn_c: f64,
    /// Energy delivered to the device in the current conduction state, J.
    delivered_j: f64,
}

impl Regulation {
    /// Creates a regulator that is off.
    pub fn new(regulator: &Regulator, time_s: f64) -> Self {
        Self {
            regulator: *regulator,
            phase: None,
            band_index: 0,
            band: regulator.off_band(),
            counted_s: time_s,
            until_s: f64::INFINITY,
            off_since_s: time_s,
            statistics: DeviceStatistics::default(),
            drawn_c: 0.0,
            delivered_j: 0.0,
        }
    }

    /// Counts up to a time.
    fn count(&mut self, time_s: f64) {
        let length_s = time_s - self.counted_s;
        self.counted_s = time_s;
        let Some(phase) = self.phase else {
            let outage_s = time_s - self.off_since_s;
            self.statistics.longest_outage_s = self.statistics.longest_outage_s.max(outage_s);
            return;
        };
        let drawn_c = self.band.held_a * length_s;
        self.statistics.on_s += length_s;
        self.statistics.drawn_c += drawn_c;
        self.drawn_c += drawn_c;
        self.delivered_j += self.regulator.output_w(phase) * length_s;
    }

    /// Returns this regulator counted up to a time.
    fn counted(&self, time_s: f64) -> Self {
        let mut counted = self.clone();
        counted.count(time_s);
        counted
    }

    /// Begins a phase.
    fn enter(&mut self, phase: usize, from_s: f64) {
        self.phase = Some(phase);
        self.until_s = from_s + self.regulator.phases[phase].length_s;
        self.band = self.regulator.band(phase, self.band_index);
    }

    /// Passes a limit of the band.
    fn pass_limit(&mut self, change: BridgeChange, time_s: f64) {
        self.count(time_s);
        match (self.phase, change) {
            // Diodes do not discharge the storage.
            (None, BridgeChange::Falls) => {}
            (None, _) => {
                self.statistics.cold_start_s.get_or_insert(time_s);
                self.statistics.starts += 1;
                self.band_index = self.regulator.band_index(self.regulator.start_v);
                self.enter(self.regulator.first_phase(), time_s);
            }
            (Some(phase), BridgeChange::Falls) if self.band_index == 0 => {
                self.statistics.interrupted_tasks += u64::from(phase != Regulator::SLEEP);
                self.off_since_s = time_s;
                (self.phase, self.until_s) = (None, f64::INFINITY);
                self.band = self.regulator.off_band();
            }
            (Some(phase), change) => {
                self.band_index += if change == BridgeChange::Rises { 1 } else { -1 };
                self.band = self.regulator.band(phase, self.band_index);
            }
        }
    }

    /// Passes the end of a phase.
    fn pass_phase(&mut self, time_s: f64) {
        self.count(time_s);
        if let Some(phase) = self.phase {
            let next = self.regulator.phase_after(phase);
            self.statistics.completed_tasks += u64::from(next == Regulator::SLEEP);
            self.enter(next, time_s);
        }
    }
}

impl Integrator<'_> {
    /// Returns the operation of the device of each bridge since the last
    /// [`Integrator::reset_statistics`]; `None` for a bridge without a regulator.
    pub fn device_statistics(&self) -> Vec<Option<DeviceStatistics>> {
        self.counted_regulations(|regulation| regulation.statistics)
    }

    /// Resets the statistics of the devices, except the time of the first start.
    pub(crate) fn reset_device_statistics(&mut self) {
        let time_s = self.time_s;
        for regulation in self.switching.regulations.iter_mut().flatten() {
            regulation.count(time_s);
            regulation.off_since_s = time_s;
            regulation.statistics = DeviceStatistics {
                cold_start_s: regulation.statistics.cold_start_s,
                ..DeviceStatistics::default()
            };
        }
    }

    /// Returns the current that each bridge draws from its storage, A.
    pub(crate) fn held_a(&self) -> Vec<f64> {
        let held = |regulation: &Option<Regulation>| regulation.as_ref().map(|it| it.band.held_a);
        let all = self.switching.regulations.iter().map(held);
        all.map(Option::unwrap_or_default).collect()
    }

    /// Returns the charge that each bridge has drawn in the current conduction state, C.
    pub(crate) fn drawn_c(&self) -> Vec<f64> {
        let all = self.counted_regulations(|regulation| regulation.drawn_c);
        all.into_iter().map(Option::unwrap_or_default).collect()
    }

    fn counted_regulations<T>(&self, of: impl Fn(Regulation) -> T) -> Vec<Option<T>> {
        let counted = |regulation: &Regulation| of(regulation.counted(self.time_s));
        let all = self.switching.regulations.iter();
        all.map(|regulation| regulation.as_ref().map(counted))
            .collect()
    }

    /// Returns the time at which the next phase of a device ends, s.
    pub(crate) fn next_phase_s(&self) -> f64 {
        let all = self.switching.regulations.iter().flatten();
        all.fold(f64::INFINITY, |least, regulation| {
            least.min(regulation.until_s)
        })
    }

    /// Passes the ends of phases up to the current time.
    pub(crate) fn pass_phases(&mut self) {
        for bridge in 0..self.switching.regulations.len() {
            while let Some(regulation) = &mut self.switching.regulations[bridge]
                && regulation.until_s <= self.time_s
            {
                regulation.pass_phase(self.time_s);
                self.hold(bridge);
            }
        }
    }

    /// Passes a limit of the band of a regulator.
    pub(crate) fn regulate(&mut self, bridge: usize, change: BridgeChange) {
        if let Some(regulation) = &mut self.switching.regulations[bridge] {
            regulation.pass_limit(change, self.time_s);
            self.hold(bridge);
        }
    }

    /// Draws the current of a regulator from now on.
    fn hold(&mut self, bridge: usize) {
        let Some(regulation) = &self.switching.regulations[bridge] else {
            return;
        };
        let signals = &self.kernel.plant.system.signals;
        let signal = (signals.iter()).position(|signal| signal.drawn_from == Some(bridge));
        if let Some(signal) = signal {
            let held = (signal, regulation.band.held_a);
            self.excitation.hold(held, self.time_s, &mut self.y);
        }
        self.aim_at_band(bridge);
        self.update_free_ports(Portable::new());
        let state = self.full_state();
        self.limit_ports(bridge)
            .into_iter()
            .for_each(|p| self.shift_threshold(p, &state));
    }

    /// Sets the thresholds of the events of a regulator to the limits of its band.
    pub(crate) fn aim_at_band(&mut self, bridge: usize) {
        let Some(band) = self.switching.regulations[bridge]
            .as_ref()
            .map(|regulation| regulation.band)
        else {
            return;
        };
        let plant = &self.kernel.plant;
        for p in self.limit_ports(bridge) {
            let gap_v = plant.band_gap(&plant.guards[p - plant.system.stops.len()], &band);
            let port = &mut self.ports[p];
            port.penetration_m += port.gap_m - gap_v;
            port.gap_m = gap_v;
        }
    }

    /// Returns the ports of the events of a regulator.
    fn limit_ports(&self, bridge: usize) -> Vec<usize> {
        let plant = &self.kernel.plant;
        let is_limit = |guard: &EventFunction| {
            guard.bridge == bridge
                && matches!(guard.change, BridgeChange::Rises | BridgeChange::Falls)
        };
        let ports = plant.guards.iter().zip(plant.system.stops.len()..);
        ports
            .filter(|(guard, _)| is_limit(guard))
            .map(|(_, p)| p)
            .collect()
    }

    /// Adds the energies of regulators in the current conduction state; returns the work of their
    /// signals, J, which does not belong to the drives.
    pub(crate) fn add_regulated(
        &self,
        integrals: &SignalIntegrals,
        drawn_c: &[f64],
        rectified: &mut [RectifiedEnergies],
    ) -> f64 {
        let plant = &self.kernel.plant;
        let delivered_j = self.counted_regulations(|regulation| regulation.delivered_j);
        let mut signals_j = 0.0;
        for (index, signal) in plant.system.signals.iter().enumerate() {
            let Some(bridge) = signal.drawn_from else {
                continue;
            };
            let work_j = plant.signal_energy_j(index, integrals);
            let storage = plant.electrical.bridges[bridge].storage;
            let zero_v = storage.map_or(0.0, |node| plant.electrical.zero_v[node]);
            let drawn_j = zero_v * drawn_c[bridge] - work_j;
            let delivered_j = delivered_j[bridge].unwrap_or(0.0);
            rectified[bridge].load_j += delivered_j;
            rectified[bridge].regulator_j += drawn_j - delivered_j;
            signals_j += work_j;
        }
        signals_j
    }

    /// Begins to count the charges of a new conduction state.
    pub(crate) fn open_regulations(&mut self) {
        let time_s = self.time_s;
        for regulation in self.switching.regulations.iter_mut().flatten() {
            regulation.count(time_s);
            (regulation.drawn_c, regulation.delivered_j) = (0.0, 0.0);
        }
    }
}
