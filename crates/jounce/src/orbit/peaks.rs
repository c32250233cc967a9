//! How near an orbit comes to grazing: the turning point of the port displacement that lies nearest to the surface of the stop.

use super::Shot;
use crate::march::{Kernel, Trajectory};
use faer::c64;

/// Looks per drive cycle, at least.
const LOOKS: usize = 512;

/// Distance past the stop, m, of the turning point (maximum or minimum) nearest to the surface; `None` without one.
pub fn nearest_extremum_m(shot: &Shot) -> Option<f64> {
    let cycle_s = shot.period_s / shot.trajectories.len() as f64;
    let turning = shot.trajectories.iter().flat_map(|trajectory| turning_points(&shot.kernel, trajectory, cycle_s));
    turning.min_by(|a, b| a.abs().total_cmp(&b.abs()))
}

fn turning_points(kernel: &Kernel, trajectory: &Trajectory, cycle_s: f64) -> Vec<f64> {
    let times: Vec<f64> = (0..=LOOKS).map(|k| cycle_s * k as f64 / LOOKS as f64).collect();
    let motion = motions(kernel, trajectory, &times);
    let turns = (1..motion.len()).filter(|k| motion[k - 1].1 * motion[*k].1 <= 0.0);
    // Only the ones near the surface are worth the way to roundoff.
    let mut near: Vec<usize> = turns.collect();
    near.sort_by(|a, b| motion[*a].0.abs().total_cmp(&motion[*b].0.abs()));
    near.truncate(3);
    near.into_iter().map(|k| refined(kernel, trajectory, (times[k - 1], times[k]), (motion[k - 1].1, motion[k].1))).collect()
}

/// Distance where the speed passes zero between two times, by false position with halving.
fn refined(kernel: &Kernel, trajectory: &Trajectory, (mut low, mut high): (f64, f64), (mut at_low, mut at_high): (f64, f64)) -> f64 {
    let size = at_low.abs().max(at_high.abs());
    let mut distance = f64::NAN;
    for _ in 0..30 {
        let middle = if at_low == at_high { 0.5 * (low + high) } else { (low * at_high - high * at_low) / (at_high - at_low) };
        let Some((place, speed)) = motions(kernel, trajectory, &[middle]).first().copied() else { break };
        distance = place;
        if speed.abs() <= 1e-10 * size {
            break;
        }
        if (speed > 0.0) == (at_high > 0.0) {
            (high, at_high) = (middle, speed);
            at_low *= 0.5;
        } else {
            (low, at_low) = (middle, speed);
            at_high *= 0.5;
        }
    }
    distance
}

/// Distance past the stop and its rate at ascending times.
fn motions(kernel: &Kernel, trajectory: &Trajectory, times: &[f64]) -> Vec<(f64, f64)> {
    let plant = &kernel.plant;
    let Some((port, stop)) = plant.ports.first().zip(plant.system.stops.first()) else { return Vec::new() };
    let dot = |row: &[f64], y: &[f64]| row.iter().zip(y).map(|(r, y)| r * y).sum::<f64>();
    (trajectory.at(kernel, times).iter())
        .map(|at| {
            let driven = plant.tones.iter().zip(&port.steady_m).fold((0.0, 0.0), |(place, speed), (tone, s)| {
                let turned = s * c64::cis(tone.angular_frequency_rad_s * at.time_s);
                (place + turned.re, speed - tone.angular_frequency_rad_s * turned.im)
            });
            (dot(&port.displacement, &at.state) + driven.0 - stop.gap_m, dot(&port.velocity, &at.state) + driven.1)
        })
        .collect()
}
