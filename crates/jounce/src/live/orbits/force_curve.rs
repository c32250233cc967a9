//! Contact forces over the period of an orbit, with samples in every contact.

use jounce_dynamics::Trajectory;
use jounce_orbits::ShootingEvaluation;
use serde::Serialize;

/// Intervals between the samples of a step in contact.
const INTERVALS: usize = 4;

/// Contact forces over the period: equally spaced samples, and further ones in each step in contact,
/// because a contact may be shorter than the interval between samples.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ForceCurves {
    /// Times of the samples, s.
    pub time_s: Vec<f64>,
    /// Force of each stop, N.
    pub force_n: Vec<Vec<f64>>,
}

impl ForceCurves {
    /// Samples an orbit.
    pub(super) fn of(evaluation: &ShootingEvaluation, samples_per_cycle: usize) -> Self {
        let cycle_s = evaluation.cycle_s();
        let stops = evaluation.kernel.plant.system.stops.len();
        let (mut time_s, mut force_n) = (Vec::new(), vec![Vec::new(); stops]);
        for (cycle, trajectory) in evaluation.trajectories.iter().enumerate() {
            let times_s = times_s(trajectory, cycle_s, samples_per_cycle);
            for instant in trajectory.at(&evaluation.kernel, &times_s) {
                time_s.push(cycle as f64 * cycle_s + instant.time_s);
                for (curve, force) in force_n.iter_mut().zip(&instant.forces_n) {
                    curve.push(*force);
                }
            }
        }
        Self { time_s, force_n }
    }
}

/// Returns the times of the samples in a drive cycle.
fn times_s(trajectory: &Trajectory, cycle_s: f64, samples: usize) -> Vec<f64> {
    let even = (0..samples).map(|k| cycle_s * k as f64 / samples as f64);
    let steps = trajectory.segments().iter();
    let contacts = steps.filter(|step| !step.forces.is_empty());
    let within = contacts.flat_map(|step| {
        (0..=INTERVALS).map(|k| step.start_s + step.length_s * k as f64 / INTERVALS as f64)
    });
    let mut times_s: Vec<f64> = even
        .chain(within)
        .filter(|time_s| *time_s < cycle_s)
        .collect();
    times_s.sort_by(f64::total_cmp);
    times_s.dedup();
    times_s
}
