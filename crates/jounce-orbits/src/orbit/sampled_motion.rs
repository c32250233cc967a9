//! Samples of the motion of a port along an orbit, and its turning points between two of them.

use crate::ShootingEvaluation;
use jounce_dynamics::{Kernel, Trajectory};

/// Samples inside an interval in which the speed changes sign.
const REFINED_SAMPLES: usize = 24;

/// Time before an impact of the sample there, as a fraction of the sampling interval.
const BEFORE_IMPACT: f64 = 1e-9;

/// Time, distance past the stop and its rate.
pub type SampledMotion = (f64, f64, f64);

/// Returns the motion at the start of every step, and at samples within a flight.
pub fn sampled_motions(
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

/// Returns the second of two neighbouring samples before any impact on a rigid stop. The speed
/// jumps only at the start of a step, which is a sample. The impact matters only where the speed
/// changes sign.
pub fn turn_without_impact(
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
pub fn beyond(from: SampledMotion, coming: SampledMotion) -> f64 {
    let (step_s, speed_m_s) = (coming.0 - from.0, coming.2);
    let slowing_m_s2 = ((from.2 - speed_m_s) / step_s).max(speed_m_s / step_s);
    0.5 * speed_m_s * speed_m_s / slowing_m_s2
}

/// Returns where the cubic through two neighbouring samples turns, as a fraction of the interval,
/// and the distance there; the first sample where it does not turn.
pub fn turn_between(from: SampledMotion, to: SampledMotion) -> (f64, f64) {
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

/// Returns time and distance of the turning point between two times. The speed is taken as linear
/// between close samples: the error is of second order, because the distance is stationary there.
pub fn refine_samples(
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
