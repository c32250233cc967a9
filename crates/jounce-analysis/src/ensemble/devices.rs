//! Operation of devices behind regulators over the members of an ensemble, with 95 % intervals.

use super::estimate::{Estimate, IntervalOver};
use super::member::{BATCHES, Member};
use jounce_dynamics::{DeviceStatistics, Energies, Integrator};
use jounce_model::plant::{Bridge, Plant, Regulator};
use serde::Serialize;

/// One device in one member, over its averaging window.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MemberDevice {
    /// Operation in each batch of the window.
    pub batches: Vec<DeviceCount>,
    /// Time from the start of the run to the first start of the device, s; `None` where it never
    /// starts.
    pub cold_start_s: Option<f64>,
    /// Longest time off, s.
    pub longest_outage_s: f64,
    /// Number of starts.
    pub starts: u64,
    /// Number of completed tasks.
    pub completed_tasks: u64,
    /// Number of interrupted tasks.
    pub interrupted_tasks: u64,
}

/// Operation of one device in a time interval.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct DeviceCount {
    /// Time on, s.
    pub on_s: f64,
    /// Energy delivered to the device, J.
    pub delivered_j: f64,
    /// Energy that arrived at the storage, without its leakage, J.
    pub available_j: f64,
}

impl DeviceCount {
    fn since(&self, earlier: &Self) -> Self {
        Self {
            on_s: self.on_s - earlier.on_s,
            delivered_j: self.delivered_j - earlier.delivered_j,
            available_j: self.available_j - earlier.available_j,
        }
    }

    fn and(&self, other: &Self) -> Self {
        Self {
            on_s: self.on_s + other.on_s,
            delivered_j: self.delivered_j + other.delivered_j,
            available_j: self.available_j + other.available_j,
        }
    }
}

/// Counts of the devices of one integration, batch by batch.
pub(super) struct DeviceCounts {
    last: Vec<DeviceCount>,
    batches: Vec<Vec<DeviceCount>>,
}

impl DeviceCounts {
    /// Starts at the current time of an integration.
    pub(super) fn open(plant: &Plant, integrator: &Integrator, energies: &Energies) -> Self {
        let last = counts(plant, integrator, energies);
        Self {
            batches: vec![Vec::with_capacity(BATCHES); last.len()],
            last,
        }
    }

    /// Closes a batch.
    pub(super) fn close(&mut self, plant: &Plant, integrator: &Integrator, energies: &Energies) {
        let now = counts(plant, integrator, energies);
        for ((batches, last), now) in self.batches.iter_mut().zip(&self.last).zip(&now) {
            batches.push(now.since(last));
        }
        self.last = now;
    }

    /// Returns the devices of the member.
    pub(super) fn members(self, integrator: &Integrator) -> Vec<MemberDevice> {
        let statistics = integrator.device_statistics().into_iter().flatten();
        let device = |(batches, statistics): (Vec<DeviceCount>, DeviceStatistics)| MemberDevice {
            batches,
            cold_start_s: statistics.cold_start_s,
            longest_outage_s: statistics.longest_outage_s,
            starts: statistics.starts,
            completed_tasks: statistics.completed_tasks,
            interrupted_tasks: statistics.interrupted_tasks,
        };
        self.batches
            .into_iter()
            .zip(statistics)
            .map(device)
            .collect()
    }
}

/// Returns the counts of each device since the start of an integration.
fn counts(plant: &Plant, integrator: &Integrator, energies: &Energies) -> Vec<DeviceCount> {
    let (first, x) = (2 * plant.system.modes.len(), integrator.physical());
    let statistics = integrator.device_statistics();
    let count = |(k, bridge): (usize, &Bridge)| {
        let (rectified, statistics) = (energies.rectified.get(k)?, statistics.get(k)?.as_ref()?);
        let voltage_v = x[first + plant.electrical.bridges[k].storage?];
        let stored_j = 0.5 * bridge.storage.capacitance_f()? * voltage_v * voltage_v;
        Some(DeviceCount {
            on_s: statistics.on_s,
            delivered_j: rectified.load_j,
            available_j: rectified.load_j + rectified.regulator_j + stored_j,
        })
    };
    let bridges = plant.system.bridges.iter().enumerate();
    bridges.filter_map(count).collect()
}

/// One device over the ensemble.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DeviceEstimates {
    /// Name of the circuit.
    pub name: String,
    /// Share of the time on, 0 to 1.
    pub on_fraction: Estimate,
    /// Mean time to the first start over the members in which the device starts, s.
    pub cold_start_s: Estimate,
    /// Number of members in which the device never starts.
    pub never_started: usize,
    /// Longest time off in any member, s.
    pub longest_outage_s: f64,
    /// Number of completed tasks in all members.
    pub completed_tasks: u64,
    /// Number of interrupted tasks in all members.
    pub interrupted_tasks: u64,
    /// Mean power delivered to the device, W.
    pub mean_power_w: Estimate,
    /// Mean power that arrives at the storage minus the power needed to stay on, W.
    pub margin_w: Estimate,
}

impl DeviceEstimates {
    /// Estimates of all devices; a batch lasts `batch_s`.
    pub(super) fn of_all(plant: &Plant, members: &[Member], batch_s: f64) -> Vec<Self> {
        let regulated = |bridge: &'_ Bridge| Some((bridge.name.clone(), *bridge.regulator()?));
        let devices = plant
            .system
            .bridges
            .iter()
            .filter_map(regulated)
            .enumerate();
        devices
            .map(|(index, (name, regulator))| Self::of(name, &regulator, members, index, batch_s))
            .collect()
    }

    fn of(
        name: String,
        regulator: &Regulator,
        members: &[Member],
        index: usize,
        batch_s: f64,
    ) -> Self {
        let interval = IntervalOver::of(members.len());
        let devices = || members.iter().map(move |member| &member.devices[index]);
        let (counts, length_s): (Vec<DeviceCount>, f64) = match interval {
            IntervalOver::Members => (
                devices().map(MemberDevice::total).collect(),
                batch_s * BATCHES as f64,
            ),
            IntervalOver::Batches => (
                devices()
                    .flat_map(|device| device.batches.iter().copied())
                    .collect(),
                batch_s,
            ),
        };
        let mean = |value: &dyn Fn(&DeviceCount) -> f64| {
            let values: Vec<f64> = counts.iter().map(value).collect();
            Estimate::of(&values, interval)
        };
        let cold_starts: Vec<f64> = devices().filter_map(|device| device.cold_start_s).collect();
        Self {
            name,
            on_fraction: mean(&|count| count.on_s / length_s),
            never_started: members.len() - cold_starts.len(),
            cold_start_s: Estimate::of(&cold_starts, IntervalOver::Members),
            longest_outage_s: devices().fold(0.0, |max, device| device.longest_outage_s.max(max)),
            completed_tasks: devices().map(|device| device.completed_tasks).sum(),
            interrupted_tasks: devices().map(|device| device.interrupted_tasks).sum(),
            mean_power_w: mean(&|count| count.delivered_j / length_s),
            margin_w: mean(&|count| count.available_j / length_s - regulator.needed_w()),
        }
    }
}

impl MemberDevice {
    fn total(&self) -> DeviceCount {
        self.batches
            .iter()
            .fold(DeviceCount::default(), |sum, batch| sum.and(batch))
    }
}
