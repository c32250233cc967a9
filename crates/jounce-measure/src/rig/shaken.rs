//! A marched run as sensors record it.

use jounce::drive::Stream;
use jounce::march::{Kernel, Trajectory};

use super::{RigError, Sensor};
use crate::recording::{Channel, Grid, Over, Quantity, Recording};

/// Voltages of all patches, and the force of each stop, of a march between two times. The first sample is at 0 s.
///
/// # Errors
/// A setting out of its range.
pub fn shaken(
    kernel: &Kernel,
    trajectory: &Trajectory,
    between_s: (f64, f64),
    rate_hz: f64,
    sensor: Sensor,
    seed: u64,
) -> Result<Recording, RigError> {
    let samples = (between_s.1 - between_s.0) * rate_hz;
    if !(64.0..=4e6).contains(&samples) {
        return Err(RigError::Setting { name: "the number of samples", value: samples, allowed: "from 64 to 4000000" });
    }
    let count = samples.round() as usize;
    let time_s: Vec<f64> = (0..count).map(|k| between_s.0 + k as f64 / rate_hz).collect();
    let plant = &kernel.plant;
    let instants = trajectory.at(kernel, &time_s);
    let voltages: Vec<Vec<f64>> = instants.iter().map(|at| plant.patch_voltages_v(&plant.to_physical(&at.state, at.time_s))).collect();
    let mut stream = Stream::new(seed, 0);
    let mut channels = Vec::new();
    for (patch, name) in plant.system.modes.patch.keys().enumerate() {
        let truth: Vec<f64> = voltages.iter().map(|v| v[patch]).collect();
        channels.push(Channel::new(&format!("{name}.voltage"), Quantity::Voltage, "V", sensor.read(&truth, &mut stream)));
    }
    for (p, stop) in plant.system.stops.iter().enumerate() {
        let truth: Vec<f64> = instants.iter().map(|at| at.forces_n[p]).collect();
        channels.push(Channel::new(&format!("{}.force", stop.name), Quantity::Force, "N", sensor.read(&truth, &mut stream)));
    }
    let grid = Grid::even(0.0, 1.0 / rate_hz, count)?;
    Ok(Recording { name: "shaken".to_owned(), over: Over::Time, grid, channels, findings: Vec::new() })
}
