//! Samples of the stored end of a run.

use super::RunOptions;
use jounce_analysis::run::{RunPlan, RunResult};
use jounce_dynamics::Kernel;
use jounce_model::plant::Plant;
use std::f64::consts::TAU;

/// Samples of the exact trajectory: evenly spaced, and once per drive cycle, up to the end of the
/// run.
#[derive(Debug, Clone, PartialEq)]
pub struct History {
    /// Names of the points.
    pub point: Vec<String>,
    /// Names of the patches.
    pub patch: Vec<String>,
    /// Names of the stops.
    pub stop: Vec<String>,
    /// Names of the rectified circuits with a storage capacitor.
    pub storage: Vec<String>,
    /// Sampling rate, Hz.
    pub sample_rate_hz: f64,
    /// Frequency of the first drive, Hz.
    pub drive_frequency_hz: Option<f64>,
    /// Evenly spaced samples.
    pub even: HistorySamples,
    /// One sample per drive cycle.
    pub poincare: HistorySamples,
}

/// Motion at given times; rows are points, patches, stops or storages, columns are times.
#[derive(Debug, Clone, PartialEq)]
pub struct HistorySamples {
    /// Time since the start of the run, s.
    pub time_s: Vec<f64>,
    /// Displacement of each point, m.
    pub displacement_m: Vec<Vec<f64>>,
    /// Velocity of each point, m/s.
    pub velocity_m_s: Vec<Vec<f64>>,
    /// Displacement towards each stop, m; contact begins at the gap.
    pub relative_displacement_m: Vec<Vec<f64>>,
    /// Voltage of each patch, V.
    pub voltage_v: Vec<Vec<f64>>,
    /// Contact force of each stop, N.
    pub force_n: Vec<Vec<f64>>,
    /// Voltage of each storage capacitor, V.
    pub storage_voltage_v: Vec<Vec<f64>>,
}

impl History {
    pub(super) fn new(
        kernel: &Kernel,
        result: &RunResult,
        plan: &RunPlan,
        options: &RunOptions,
    ) -> Self {
        let (system, sample_rate_hz) = (&kernel.plant.system, options.sampled_at_hz());
        let begin_s = plan.duration_s - options.record_s;
        let count = (options.record_s * sample_rate_hz * (1.0 + 1e-12)) as usize + 1;
        let even = (0..count).map(|k| begin_s + k as f64 / sample_rate_hz);
        let cycle_s = kernel
            .plant
            .tones
            .first()
            .map(|tone| TAU / tone.angular_frequency_rad_s);
        let cycles = cycle_s.map_or(0, |cycle_s| (options.record_s / cycle_s) as usize + 1);
        let instant_s = |k: usize| plan.duration_s - k as f64 * cycle_s.unwrap_or_default();
        Self {
            even: HistorySamples::new(kernel, result, even.collect()),
            poincare: HistorySamples::new(
                kernel,
                result,
                (0..cycles).rev().map(instant_s).collect(),
            ),
            sample_rate_hz,
            drive_frequency_hz: system.drives.first().map(|drive| drive.frequency_hz),
            point: system.modes.shape.keys().cloned().collect(),
            patch: system.modes.patch.keys().cloned().collect(),
            stop: system.stops.iter().map(|stop| stop.name.clone()).collect(),
            storage: storages(&kernel.plant)
                .map(|(bridge, _)| system.bridges[bridge].name.clone())
                .collect(),
        }
    }
}

/// Returns the rectified circuits with a storage capacitor: index of the bridge and its node.
fn storages(plant: &Plant) -> impl Iterator<Item = (usize, usize)> {
    let bridges = plant.electrical.bridges.iter().enumerate();
    bridges.filter_map(|(bridge, nodes)| Some((bridge, nodes.storage?)))
}

impl HistorySamples {
    fn new(kernel: &Kernel, result: &RunResult, time_s: Vec<f64>) -> Self {
        let plant = &kernel.plant;
        let (modes, n) = (&plant.system.modes, plant.system.modes.len());
        let motion = |shape: &Vec<f64>, first: usize| [vec![0.0; first], shape.clone()].concat();
        let points = modes.shape.values();
        let stops = plant.system.stops.iter();
        let rows: Vec<Vec<f64>> = (points.clone().map(|shape| motion(shape, 0)))
            .chain(points.map(|shape| motion(shape, n)))
            .chain(stops.map(|stop| motion(&stop.shape, 0)))
            .chain(plant.patch_voltage_rows())
            .chain(storages(plant).map(|(_, node)| motion(&vec![1.0], 2 * n + node)))
            .collect();
        let sampled = result.trajectory.sample(kernel, &time_s, &rows);
        let mut values = sampled.values.into_iter();
        let mut take = |count: usize| values.by_ref().take(count).collect();
        Self {
            displacement_m: take(modes.shape.len()),
            velocity_m_s: take(modes.shape.len()),
            relative_displacement_m: take(plant.system.stops.len()),
            voltage_v: take(modes.patch.len()),
            storage_voltage_v: take(storages(plant).count()),
            force_n: sampled.forces_n,
            time_s,
        }
    }
}
