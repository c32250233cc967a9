//! Operation of devices behind regulators over the averaging window of a run.

use super::RectifiedResult;
use jounce_dynamics::DeviceStatistics;
use jounce_model::plant::Plant;
use serde::Serialize;

/// Seconds of a day.
const DAY_S: f64 = 86_400.0;

/// Operation of one device over the averaging window.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DeviceResult {
    /// Name of the circuit.
    pub name: String,
    /// Time from the start of the run to the first start of the device, s; `None` where it never
    /// starts.
    pub cold_start_s: Option<f64>,
    /// Share of the time on, 0 to 1.
    pub on_fraction: f64,
    /// Number of starts.
    pub starts: u64,
    /// Longest time off, s.
    pub longest_outage_s: f64,
    /// Number of completed tasks: a measurement, a transmission, or both.
    pub completed_tasks: u64,
    /// Number of tasks that an outage interrupted.
    pub interrupted_tasks: u64,
    /// Energy delivered to the device per day, J.
    pub energy_per_day_j: f64,
    /// Mean power that arrives at the storage, without its leakage, W.
    pub available_w: f64,
    /// Mean power that the regulator would draw if it never stopped, W, at the mean of its two
    /// threshold voltages.
    pub needed_w: f64,
    /// `available_w - needed_w`, W.
    pub margin_w: f64,
}

/// Operation of several devices: each measure is that of the device for which it is worst.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WorstOperation {
    /// Share of the time on, 0 to 1.
    pub on_fraction: f64,
    /// Time to the first start, s; infinite where a device never starts.
    pub cold_start_s: f64,
    /// Longest time off, s.
    pub longest_outage_s: f64,
    /// Available minus needed power, W.
    pub margin_w: f64,
}

impl WorstOperation {
    /// Returns the worst of several devices over a run; `None` without a device.
    pub fn of(devices: &[DeviceResult]) -> Option<Self> {
        let each = |device: &DeviceResult| Self {
            on_fraction: device.on_fraction,
            cold_start_s: device.cold_start_s.unwrap_or(f64::INFINITY),
            longest_outage_s: device.longest_outage_s,
            margin_w: device.margin_w,
        };
        devices.iter().map(each).reduce(Self::and)
    }

    /// Returns the worse value of each measure.
    pub(crate) fn and(self, other: Self) -> Self {
        Self {
            on_fraction: self.on_fraction.min(other.on_fraction),
            cold_start_s: self.cold_start_s.max(other.cold_start_s),
            longest_outage_s: self.longest_outage_s.max(other.longest_outage_s),
            margin_w: self.margin_w.min(other.margin_w),
        }
    }
}

/// Returns the operation of every device from its statistics over the averaging window.
pub(super) fn devices(
    plant: &Plant,
    statistics: &[Option<DeviceStatistics>],
    rectified: &[RectifiedResult],
    average_over_s: f64,
) -> Vec<DeviceResult> {
    let all = plant.system.bridges.iter().zip(statistics).zip(rectified);
    all.filter_map(|((bridge, statistics), circuit)| {
        let (regulator, statistics) = (bridge.regulator()?, statistics.as_ref()?);
        let needed_w = regulator.needed_w();
        let available_w = circuit.mean_power_w + circuit.regulator_loss_w + circuit.storage_w;
        Some(DeviceResult {
            name: bridge.name.clone(),
            cold_start_s: statistics.cold_start_s,
            on_fraction: statistics.on_s / average_over_s,
            starts: statistics.starts,
            longest_outage_s: statistics.longest_outage_s,
            completed_tasks: statistics.completed_tasks,
            interrupted_tasks: statistics.interrupted_tasks,
            energy_per_day_j: circuit.mean_power_w * DAY_S,
            available_w,
            needed_w,
            margin_w: available_w - needed_w,
        })
    })
    .collect()
}
