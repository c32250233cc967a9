//! Turning points of the port displacements: the distance of an orbit from grazing, and its
//! amplitude.

use crate::ShootingEvaluation;
use jounce_dynamics::{Kernel, Trajectory};
use jounce_model::contact::Law;

/// Minimum samples per drive cycle in flight in the search for the turning point nearest to a
/// surface, ...
const SAMPLES_PER_CYCLE: f64 = 512.0;

/// ... and in the search for the largest and smallest displacement: a cubic interpolates between
/// neighbours.
const COARSE_SAMPLES_PER_CYCLE: f64 = 128.0;

/// Samples inside an interval in which the speed changes sign.
const REFINED_SAMPLES: usize = 24;

/// Largest number of turning points to refine.
const MAX_REFINED_POINTS: usize = 3;

/// Time before an impact of the sample there, as a fraction of the sampling interval.
const BEFORE_IMPACT: f64 = 1e-9;

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
        let cycle_s = evaluation.period_s / evaluation.trajectories.len() as f64;
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
    let cycle_s = evaluation.period_s / evaluation.trajectories.len() as f64;
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
    let cycle_s = evaluation.period_s / evaluation.trajectories.len() as f64;
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
            let turn = |time_s: f64, past_m: f64, is_impact: bool| TurningPoint {
                port,
                cycle,
                time_s,
                past_m,
                is_maximum: from.2 > 0.0,
                is_impact,
            };
            if from.2 * coming.2 < 0.0 {
                let (share, past_m) = turn_between(from, coming);
                turns.push(turn(from.0 + share * (coming.0 - from.0), past_m, false));
            } else if from.2 > 0.0 && to.2 < 0.0 {
                turns.push(turn(to.0, beyond(from, coming), true));
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
    let cycle_s = evaluation.period_s / evaluation.trajectories.len() as f64;
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
                [pair[0].1, turn_between(pair[0], to).1]
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

/// Returns the second of two neighbouring samples before any impact on a rigid stop. The speed
/// jumps only at the start of a step, which is a sample. The impact matters only where the speed
/// changes sign.
fn turn_without_impact(
    kernel: &Kernel,
    port: usize,
    trajectory: &Trajectory,
    (from, to): (SampledMotion, SampledMotion),
) -> SampledMotion {
    if from.2 * to.2 >= 0.0 {
        return to;
    }
    let just_before_s = to.0 - BEFORE_IMPACT * (to.0 - from.0);
    let coming = trajectory.at(kernel, &[just_before_s]);
    let rate_m_s = coming
        .first()
        .and_then(|at| motion(kernel, port, at.time_s, &at.state))
        .map_or(to.2, |coming| coming.2);
    (to.0, to.1, rate_m_s)
}

/// Returns the distance beyond a rigid stop, m, at which an impacting motion would turn:
/// `v^2 / (2 a)`, at most half the displacement of one sampling interval.
fn beyond(from: SampledMotion, coming: SampledMotion) -> f64 {
    let (step_s, speed_m_s) = (coming.0 - from.0, coming.2);
    let slowing_m_s2 = ((from.2 - speed_m_s) / step_s).max(speed_m_s / step_s);
    0.5 * speed_m_s * speed_m_s / slowing_m_s2
}

/// Returns where the cubic through two neighbouring samples turns, as a fraction of the interval,
/// and the distance there; the first sample where it does not turn.
fn turn_between(from: SampledMotion, to: SampledMotion) -> (f64, f64) {
    let (step_s, [u, v]) = (to.0 - from.0, [from.2, to.2]);
    if u * v >= 0.0 {
        return (0.0, from.1);
    }
    // Slope of the cubic in x = t / step: u + 2 b x + c x^2, with b and c from both speeds and the
    // chord.
    let chord = (to.1 - from.1) / step_s;
    let (b, c) = (3.0 * chord - 2.0 * u - v, 3.0 * (u + v - 2.0 * chord));
    let root = (b * b - u * c).max(0.0).sqrt();
    // The slope changes sign once: take the root inside the interval.
    let q = -(b + root.copysign(b));
    let x = [u / q, q / c]
        .into_iter()
        .find(|x| (0.0..=1.0).contains(x))
        .unwrap_or(0.5);
    (x, from.1 + step_s * x * (u + x * (b + x * c / 3.0)))
}

/// Time, distance past the stop and its rate.
type SampledMotion = (f64, f64, f64);

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

/// Returns the motion at the start of every step, and at samples within a flight.
fn sampled_motions(
    kernel: &Kernel,
    port: usize,
    trajectory: &Trajectory,
    (count, cycle_s): (f64, f64),
) -> Vec<SampledMotion> {
    let mut samples = Vec::new();
    trajectory.walk(
        kernel,
        0,
        cycle_s / count,
        &mut |cycle_samples, time_s, state| {
            samples.extend(motion(cycle_samples, port, time_s, state))
        },
    );
    samples
}

/// Returns time and distance of the turning point between two times. The speed is taken as linear
/// between close samples: the error is of second order, because the distance is stationary there.
fn refine_samples(
    kernel: &Kernel,
    port: usize,
    trajectory: &Trajectory,
    from_s: f64,
    to_s: f64,
) -> Option<(f64, f64)> {
    let times: Vec<f64> = (0..=REFINED_SAMPLES)
        .map(|k| from_s + (to_s - from_s) * k as f64 / REFINED_SAMPLES as f64)
        .collect();
    let states = trajectory.at(kernel, &times);
    let motions: Vec<SampledMotion> = states
        .iter()
        .filter_map(|at| motion(kernel, port, at.time_s, &at.state))
        .collect();
    let (a, b) = motions
        .windows(2)
        .map(|pair| (pair[0], pair[1]))
        .find(|(a, b)| a.2 * b.2 <= 0.0)?;
    let share = if a.2 == b.2 { 0.5 } else { a.2 / (a.2 - b.2) };
    // From the nearer sample, with half the speed over the interval.
    let way_s = share * (b.0 - a.0);
    Some((a.0 + way_s, a.1 + 0.5 * a.2 * way_s))
}

/// Returns the distance past the stop, m, and its rate, m/s, of a port at a time in a drive cycle
/// of the period.
pub(crate) fn port_motion(
    evaluation: &ShootingEvaluation,
    port: usize,
    (cycle, time_s): (usize, f64),
) -> [f64; 2] {
    let at = evaluation.trajectories[cycle].at(&evaluation.kernel, &[time_s]);
    let state = at
        .first()
        .and_then(|at| motion(&evaluation.kernel, port, at.time_s, &at.state));
    state.map_or([f64::NAN; 2], |(_, past_m, rate_m_s)| [past_m, rate_m_s])
}

/// Returns time, distance past the stop and its rate.
fn motion(kernel: &Kernel, port: usize, time_s: f64, state: &[f64]) -> Option<SampledMotion> {
    let plant = &kernel.plant;
    let (port, stop) = plant.ports.get(port).zip(plant.system.stops.get(port))?;
    let dot = |row: &[f64]| row.iter().zip(state).map(|(r, y)| r * y).sum::<f64>();
    let driven = plant.driven(port, time_s);
    Some((
        time_s,
        dot(&port.displacement) + driven[0] - stop.gap_m,
        dot(&port.velocity) + driven[1],
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `sin` between two samples about its top.
    #[test]
    fn a_cubic_finds_the_top_of_a_sine() {
        let sample = |t: f64| (t, t.sin(), t.cos());
        for from in [1.53, 1.55, 1.569] {
            let error = turn_between(sample(from), sample(from + 0.049)).1 - 1.0;
            assert!(error.abs() < 2e-8, "{error:e}");
        }
        let (_, line) = turn_between((0.0, 1.0, -2.0), (2.0, 1.0, 2.0));
        assert!((line + 1.0 - 1.0).abs() < 1e-15, "{line}");
    }
}
