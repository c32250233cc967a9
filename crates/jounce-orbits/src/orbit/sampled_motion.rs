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
/// jumps only at the start of a step, which is a sample. The impact matters only where the motion
/// turns.
pub fn turn_without_impact(
    kernel: &Kernel,
    port: usize,
    trajectory: &Trajectory,
    (from, to): (SampledMotion, SampledMotion),
) -> SampledMotion {
    if turns_between(from, to)[0].is_none() {
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

/// Returns where the cubic through two neighbouring samples turns: fractions of the interval in
/// ascending order, each with the distance past the stop. There are two where the speed changes its
/// sign and changes back.
pub fn turns_between(from: SampledMotion, to: SampledMotion) -> [Option<(f64, f64)>; 2] {
    let (step_s, [u, v]) = (to.0 - from.0, [from.2, to.2]);
    // Slope of the cubic in x = t / step: u + 2 b x + c x^2, with b and c from both speeds and the
    // chord.
    let chord = (to.1 - from.1) / step_s;
    let (b, c) = (3.0 * chord - 2.0 * u - v, 3.0 * (u + v - 2.0 * chord));
    let at = |x: f64| (x, from.1 + step_s * x * (u + x * (b + x * c / 3.0)));
    let is_inside = |x: &f64| *x > 0.0 && *x < 1.0;
    let discriminant = b * b - u * c;
    let q = -(b + discriminant.max(0.0).sqrt().copysign(b));
    let roots = [u / q, q / c];
    if u * v < 0.0 {
        // The slope changes sign once: take the root inside the interval.
        let x = roots.into_iter().find(is_inside).unwrap_or(0.5);
        return [Some(at(x)), None];
    }
    if discriminant <= 0.0 || !roots.iter().all(is_inside) {
        return [None; 2];
    }
    let [one, two] = roots;
    [Some(at(one.min(two))), Some(at(one.max(two)))]
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
            let [top, none] = turns_between(sample(from), sample(from + 0.049));
            let is_top = |(_, past_m): (f64, f64)| (past_m - 1.0).abs() < 2e-8;
            assert!(top.is_some_and(is_top) && none.is_none(), "{top:?}");
        }
        let [line, _] = turns_between((0.0, 1.0, -2.0), (2.0, 1.0, 2.0));
        assert!(line.is_some_and(|at| at.1.abs() < 1e-15), "{line:?}");
    }

    /// `t^3 - 0.03 t` turns at -0.1 and 0.1.
    #[test]
    fn two_turns_between_two_samples_are_found() {
        let sample = |t: f64| (t, t * t * t - 0.03 * t, 3.0 * t * t - 0.03);
        let found = turns_between(sample(-0.2), sample(0.3));
        for (turn, (time_s, height_m)) in found.into_iter().zip([(-0.1, 0.002), (0.1, -0.002)]) {
            let is_there = |(share, past_m): (f64, f64)| {
                (0.5 * share - 0.2 - time_s).abs() < 1e-12 && (past_m - height_m).abs() < 1e-15
            };
            assert!(turn.is_some_and(is_there), "{turn:?}");
        }
        assert_eq!(turns_between(sample(0.11), sample(0.3)), [None; 2]);
        assert_eq!(turns_between(sample(-0.3), sample(-0.11)), [None; 2]);
    }
}
