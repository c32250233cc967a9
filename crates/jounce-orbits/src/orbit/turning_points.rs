//! Turning points of the port displacements: the distance of an orbit from grazing, and its
//! amplitude.

use super::sampled_motion::{
    SampledMotion, beyond, refine_samples, sampled_motions, turn_without_impact, turns_between,
};
use crate::ShootingEvaluation;
use jounce_dynamics::{Kernel, Trajectory};
use jounce_model::contact::Law;

/// Minimum samples per drive cycle in flight in the search for the turning point nearest to a
/// surface, ...
const SAMPLES_PER_CYCLE: f64 = 512.0;

/// ... and in the search for the largest and smallest displacement: a cubic interpolates between
/// neighbours.
const COARSE_SAMPLES_PER_CYCLE: f64 = 128.0;

/// Largest number of turning points to refine.
const MAX_REFINED_POINTS: usize = 3;

/// Turning point of a port.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TurningPoint {
    /// Index of the port.
    pub port: usize,
    /// Drive cycle of the period, from 0.
    pub cycle: usize,
    /// Time in the cycle, s.
    pub time_s: f64,
    /// Distance past the stop, m.
    pub past_m: f64,
    /// True for a maximum.
    pub is_maximum: bool,
    /// True where an impact on a rigid stop replaces the turning point: the distance belongs to the
    /// motion without the impact.
    pub is_impact: bool,
}

impl TurningPoint {
    /// Returns this turning point with time and distance refined by more samples near it.
    pub fn refined(self, evaluation: &ShootingEvaluation) -> Self {
        if self.is_impact {
            return self;
        }
        let cycle_s = evaluation.cycle_s();
        let half_s = 0.5 * cycle_s / COARSE_SAMPLES_PER_CYCLE;
        let (from_s, to_s) = (
            (self.time_s - half_s).max(0.0),
            (self.time_s + half_s).min(cycle_s),
        );
        let refined_motion = refine_samples(
            &evaluation.kernel,
            self.port,
            &evaluation.trajectories[self.cycle],
            from_s,
            to_s,
        );
        refined_motion.map_or(self, |(time_s, past_m)| Self {
            time_s,
            past_m,
            ..self
        })
    }
}

/// Returns the turning point (maximum or minimum) of any port nearest to the surface of its stop;
/// `None` without one. Laws that act on both sides of their surface have no turning points.
pub fn nearest_turn(evaluation: &ShootingEvaluation) -> Option<TurningPoint> {
    let cycle_s = evaluation.cycle_s();
    let stops = &evaluation.kernel.plant.system.stops;
    let ports = (0..stops.len()).filter(|port| !stops[*port].law.acts_on_both_sides());
    let turning = ports.flat_map(|port| {
        evaluation
            .trajectories
            .iter()
            .enumerate()
            .flat_map(move |(cycle, trajectory)| {
                let candidates = turning_points(&evaluation.kernel, port, trajectory, cycle_s);
                candidates
                    .into_iter()
                    .map(move |(time_s, past_m, is_maximum)| TurningPoint {
                        port,
                        cycle,
                        time_s,
                        past_m,
                        is_maximum,
                        is_impact: false,
                    })
            })
    });
    turning.min_by(|a, b| a.past_m.abs().total_cmp(&b.past_m.abs()))
}

/// Returns all turning points of the port displacements, each from the cubic between two samples.
/// An impact on a rigid stop is replaced by the maximum of the motion without the stop: its
/// distance is zero at grazing and smooth through it. Laws that act on both sides of their surface
/// have no turning points.
pub fn turns(evaluation: &ShootingEvaluation) -> Vec<TurningPoint> {
    let cycle_s = evaluation.cycle_s();
    let stops = &evaluation.kernel.plant.system.stops;
    let ports = (0..stops.len()).filter(|port| !stops[*port].law.acts_on_both_sides());
    ports
        .flat_map(|port| turns_of(evaluation, port, cycle_s))
        .collect()
}

fn turns_of(evaluation: &ShootingEvaluation, port: usize, cycle_s: f64) -> Vec<TurningPoint> {
    let kernel = &evaluation.kernel;
    let strikes = matches!(kernel.plant.system.stops[port].law, Law::Rigid(_));
    let samples: Vec<Vec<SampledMotion>> = evaluation
        .trajectories
        .iter()
        .map(|trajectory| {
            sampled_motions(
                kernel,
                port,
                trajectory,
                (COARSE_SAMPLES_PER_CYCLE, cycle_s),
            )
        })
        .collect();
    let mut turns = Vec::new();
    for (cycle, cycle_samples) in samples.iter().enumerate() {
        // The first sample of the next cycle is at the end of this one.
        let end = samples[(cycle + 1) % samples.len()]
            .first()
            .map(|next| (cycle_s, next.1, next.2));
        let cycle_samples: Vec<SampledMotion> = cycle_samples.iter().copied().chain(end).collect();
        for (from, to) in cycle_samples.windows(2).map(|pair| (pair[0], pair[1])) {
            let coming = if strikes {
                turn_without_impact(kernel, port, &evaluation.trajectories[cycle], (from, to))
            } else {
                to
            };
            let turn = |time_s: f64, past_m: f64, is_maximum: bool, is_impact: bool| TurningPoint {
                port,
                cycle,
                time_s,
                past_m,
                is_maximum,
                is_impact,
            };
            // Maxima and minima alternate.
            let mut is_maximum = from.2 > 0.0;
            for (share, past_m) in turns_between(from, coming).into_iter().flatten() {
                let time_s = from.0 + share * (coming.0 - from.0);
                turns.push(turn(time_s, past_m, is_maximum, false));
                is_maximum = !is_maximum;
            }
            if coming.2 >= 0.0 && to.2 < 0.0 {
                turns.push(turn(to.0, beyond(from, coming), true, true));
            }
        }
    }
    turns
}

/// Returns the distance past the stop, m, of [`nearest_turn`].
pub fn nearest_extremum_m(evaluation: &ShootingEvaluation) -> Option<f64> {
    nearest_turn(evaluation).map(|turn| turn.past_m)
}

/// Returns half the peak-to-peak displacement at the first stop, m; 0 without a stop.
pub fn displacement_peak_m(evaluation: &ShootingEvaluation) -> f64 {
    if evaluation.kernel.plant.system.stops.is_empty() {
        return 0.0;
    }
    let cycle_s = evaluation.cycle_s();
    let strikes = evaluation
        .kernel
        .plant
        .system
        .stops
        .iter()
        .any(|stop| matches!(stop.law, Law::Rigid(_)));
    let cycles = evaluation.trajectories.iter().map(|trajectory| {
        (
            trajectory,
            sampled_motions(
                &evaluation.kernel,
                0,
                trajectory,
                (COARSE_SAMPLES_PER_CYCLE, cycle_s),
            ),
        )
    });
    let range = cycles.fold(
        (f64::INFINITY, f64::NEG_INFINITY),
        |range, (trajectory, samples)| {
            let cycle_samples = samples.windows(2).flat_map(|pair| {
                let to = if strikes {
                    turn_without_impact(&evaluation.kernel, 0, trajectory, (pair[0], pair[1]))
                } else {
                    pair[1]
                };
                let turns_m =
                    turns_between(pair[0], to).map(|turn| turn.map_or(pair[0].1, |at| at.1));
                [pair[0].1, turns_m[0], turns_m[1]]
            });
            cycle_samples
                .chain(samples.last().map(|last| last.1))
                .fold(range, |(low, high), past_m| {
                    (low.min(past_m), high.max(past_m))
                })
        },
    );
    0.5 * (range.1 - range.0).max(0.0)
}

fn turning_points(
    kernel: &Kernel,
    port: usize,
    trajectory: &Trajectory,
    cycle_s: f64,
) -> Vec<(f64, f64, bool)> {
    let samples = sampled_motions(kernel, port, trajectory, (SAMPLES_PER_CYCLE, cycle_s));
    let mut turns: Vec<(SampledMotion, SampledMotion)> = samples
        .windows(2)
        .map(|pair| (pair[0], pair[1]))
        .filter(|(a, b)| a.2 * b.2 <= 0.0)
        .collect();
    turns.sort_by(|a, b| a.0.1.abs().total_cmp(&b.0.1.abs()));
    turns.truncate(MAX_REFINED_POINTS);
    let refine = |from: SampledMotion, to: SampledMotion| {
        refine_samples(kernel, port, trajectory, from.0, to.0)
    };
    turns
        .into_iter()
        .filter_map(|(from, to)| {
            refine(from, to).map(|(time_s, past_m)| (time_s, past_m, from.2 > 0.0))
        })
        .collect()
}
