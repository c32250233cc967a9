//! Steady-state test of a run, from the stroboscopic states of the last drive periods.
//!
//! With two successive changes `d_1`, `d_2` of the state over `n` periods, the remaining distance
//! to the orbit is about `d_2 r / (1 - r)`, `r = d_2 / d_1`: a slow mode changes little in a period
//! and may still be far from its orbit.

use super::StartState;
use jounce_dynamics::{Integrator, Kernel, Trajectory, TrajectorySegment};
use serde::Serialize;
use std::f64::consts::TAU;

/// Steady-state test at the end of a run.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Settlement {
    /// True when the distance to the periodic orbit is below the tolerance.
    pub settled: bool,
    /// Period of the orbit in drive cycles, up to the longest tested period.
    pub period_cycles: u32,
    /// Relative change of the state over the last period of the orbit, in the energy norm; a free
    /// displacement counts times the drive frequency.
    pub change: f64,
    /// Estimated relative distance to the periodic orbit; infinite if the changes do not decrease.
    pub distance: f64,
}

/// Longest tested period of an orbit, in drive cycles.
pub(super) const MAX_PERIOD_CYCLES: usize = 4;

/// Number of stroboscopic states: two changes over the longest period need two periods and one
/// state.
pub(super) const STROBE_STATES: usize = 2 * MAX_PERIOD_CYCLES + 1;

/// Relative distance to the orbit below which a run has settled.
pub const SETTLED_DISTANCE: f64 = 1e-4;

/// Motion, relative to the forced response without contact, below which a body counts as at rest.
const REST_MOTION_SHARE: f64 = 1e-9;

/// Error of the integration over a period, in the energy norm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Noise {
    /// Relative to the motion or, in contact, to the largest impact so far.
    pub relative: f64,
    /// Size of that impact; 0 without contact.
    pub largest_impact: f64,
}

impl Noise {
    /// Ten tolerances.
    pub fn of(integrator: &Integrator, tolerance: f64) -> Self {
        Self {
            relative: 10.0 * tolerance.max(1e-13),
            largest_impact: integrator.largest_impact_sqrt_j(),
        }
    }
}

/// Applies the steady-state test to the state at each period of the drives at the end of the run.
pub(super) fn settled(
    kernel: &Kernel,
    trajectory: &Trajectory,
    end_s: f64,
    period_s: f64,
    noise: Noise,
) -> Settlement {
    let times: Vec<f64> = (0..STROBE_STATES)
        .rev()
        .map(|k| end_s - k as f64 * period_s)
        .filter(|time_s| *time_s > -1e-9 * period_s)
        .collect();
    let plant = &kernel.plant;
    let scales = energy_scales(kernel, period_s);
    let states = energy_states(kernel, trajectory, &times, &scales);
    // A ball at rest on its table moves by roundoff of the forced response.
    let driven = plant.tones.iter().map(|tone| {
        let amplitude = |i: usize| {
            (0..plant.len())
                .map(|j| tone.steady[j] * plant.diagonal.to_physical[(i, j)])
                .sum::<jounce_linalg::c64>()
        };
        norm((0..plant.len()).map(|i| scales[i] * amplitude(i).norm()))
    });
    let begin_s = times.first().copied().unwrap_or(end_s);
    let touches = |segment: &TrajectorySegment| {
        segment.start_s + segment.length_s > begin_s && !segment.forces.is_empty()
    };
    let noise = match trajectory.segments().iter().any(touches) {
        true => noise,
        false => Noise {
            largest_impact: 0.0,
            ..noise
        },
    };
    settlement(
        &states,
        noise,
        REST_MOTION_SHARE * driven.fold(0.0, f64::max),
    )
}

/// Returns the length of the part of a window at the end of a run that has its peaks, s: the period of
/// a steady state that repeats over the window, else the window. `begin` is the state at its start.
pub(super) fn repeated_window_s(
    kernel: &Kernel,
    trajectory: &Trajectory,
    (begin, begin_s, end_s): (&StartState, f64, f64),
    settlement: Option<&Settlement>,
) -> f64 {
    let window_s = end_s - begin_s;
    let (Some(period_s), Some(settlement)) = (kernel.plant.period_s(), settlement) else {
        return window_s;
    };
    let orbit_s = f64::from(settlement.period_cycles) * period_s;
    let orbits = (window_s / orbit_s * (1.0 + 1e-12)).floor();
    if !settlement.settled || orbits < 1.0 {
        return window_s;
    }
    let scales = energy_scales(kernel, period_s);
    let last_s = end_s.min(begin_s + orbits * orbit_s);
    let states = energy_states(kernel, trajectory, &[last_s], &scales);
    let Some(last) = states.first() else {
        return window_s;
    };
    let first = begin.physical();
    let first = first.iter().zip(&scales).map(|(x, s)| x * s);
    let change = norm(first.zip(last).map(|(a, b)| a - b));
    match change <= SETTLED_DISTANCE * norm(last.iter().copied()) {
        true => orbit_s,
        false => window_s,
    }
}

/// Returns the factor of each physical state whose square is twice its energy. The displacement of a
/// free body has no energy: its scale is the drive frequency.
fn energy_scales(kernel: &Kernel, period_s: f64) -> Vec<f64> {
    let plant = &kernel.plant;
    let frequencies = &plant.system.modes.frequency_rad_s;
    let mechanical = frequencies
        .iter()
        .map(|w| match *w > 0.0 {
            true => *w,
            false => TAU / period_s,
        })
        .chain(std::iter::repeat_n(1.0, frequencies.len()));
    mechanical.chain(plant.electrical.energy_scale()).collect()
}

/// Returns the states of a record at some times, in energy coordinates.
fn energy_states(
    kernel: &Kernel,
    trajectory: &Trajectory,
    times_s: &[f64],
    scales: &[f64],
) -> Vec<Vec<f64>> {
    (trajectory.at(kernel, times_s).iter())
        .map(|at| {
            kernel
                .plant
                .to_physical(&at.state, at.time_s)
                .iter()
                .zip(scales)
                .map(|(x, s)| x * s)
                .collect()
        })
        .collect()
}

/// Tests states one drive period apart, oldest first, in energy coordinates.
///
/// Changes below `noise` are errors of the integration, so their ratio is meaningless. Changes are
/// relative to the norm of the last state, or to `least` if it is smaller.
fn settlement(states: &[Vec<f64>], noise: Noise, least: f64) -> Settlement {
    let mut best: Option<Settlement> = None;
    for period in 1..=MAX_PERIOD_CYCLES {
        let Some(first) = states.len().checked_sub(2 * period + 1) else {
            break;
        };
        let (old, middle, last) = (
            &states[first],
            &states[first + period],
            &states[first + 2 * period],
        );
        let size = norm(last.iter().copied());
        let scale = size.max(least).max(f64::MIN_POSITIVE);
        let change = |a: &[f64], b: &[f64]| norm(a.iter().zip(b).map(|(a, b)| a - b)) / scale;
        let is_error =
            |change: f64| change * scale < noise.relative * scale.max(noise.largest_impact);
        let (before, now) = (change(middle, old), change(last, middle));
        let ratio = now / before;
        let distance = match is_error(now) {
            true => now,
            false if ratio < 1.0 => now * (ratio / (1.0 - ratio)).max(1.0),
            false => f64::INFINITY,
        };
        let result = Settlement {
            settled: distance < SETTLED_DISTANCE,
            period_cycles: period as u32,
            change: now,
            distance,
        };
        if result.settled {
            // A free decay that nearly repeats after `period` cycles settles first over these. Two
            // states of an orbit of fewer cycles differ by their distances to it at most.
            let explained = distance * (1.0 + 1.0 / ratio.min(1.0));
            let least = (1..period)
                .filter(|part| period.is_multiple_of(*part))
                .find(|part| change(last, &states[first + 2 * period - part]) <= explained);
            return Settlement {
                period_cycles: least.unwrap_or(period) as u32,
                ..result
            };
        }
        if best.is_none_or(|best| result.change < best.change) {
            best = Some(result);
        }
    }
    best.unwrap_or(Settlement {
        settled: false,
        period_cycles: 1,
        change: f64::INFINITY,
        distance: f64::INFINITY,
    })
}

pub(super) fn norm(values: impl Iterator<Item = f64>) -> f64 {
    values.map(|v| v * v).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    const EXACT: Noise = Noise {
        relative: 1e-12,
        largest_impact: 0.0,
    };

    #[test]
    fn a_slow_decay_is_not_settled_though_it_changes_little() {
        let states: Vec<Vec<f64>> = (0..STROBE_STATES)
            .map(|k| vec![1.0 + 0.05 * 0.999_f64.powi(k as i32)])
            .collect();
        let result = settlement(&states, EXACT, 0.0);
        assert!(
            !result.settled
                && result.change < 1e-4
                && (result.distance / 0.0472 - 1.0).abs() < 0.02,
            "{result:?}"
        );
    }

    #[test]
    fn an_orbit_of_two_cycles_is_found() {
        let states: Vec<Vec<f64>> = (0..STROBE_STATES)
            .map(|k| vec![1.0, if k % 2 == 0 { 0.1 } else { -0.1 }])
            .collect();
        let result = settlement(&states, EXACT, 0.0);
        assert!(result.settled && result.period_cycles == 2, "{result:?}");
    }

    /// Motion of period 1 with a free decay of a third and of a quarter of the drive frequency.
    #[test]
    fn a_decay_that_nearly_repeats_after_some_cycles_is_no_longer_period() {
        for fraction in [3.0, 4.0] {
            let states: Vec<Vec<f64>> = (0..STROBE_STATES)
                .map(|k| {
                    let angle = TAU * k as f64 / fraction;
                    let size = 4e-5 * 0.98_f64.powi(k as i32);
                    vec![1.0 + size * angle.cos(), size * angle.sin()]
                })
                .collect();
            let result = settlement(&states, EXACT, 0.0);
            assert!(result.settled && result.period_cycles == 1, "{result:?}");
            let size = 4e-5 * 0.98_f64.powi(STROBE_STATES as i32 - 1);
            assert!(result.distance >= 0.999 * size, "{result:?}");
        }
    }

    /// States that repeat to 9e-9 of the largest impact, and to 9e-6 of themselves.
    #[test]
    fn errors_relative_to_the_largest_impact_do_not_hide_steady_state() {
        let errors = [1e-9, 3e-9, 0.0, 2e-9, 1e-9, 3e-9, 2e-9, 0.0, 9e-9];
        let states: Vec<Vec<f64>> = errors.map(|error| vec![1e-3, error]).to_vec();
        let noise = |largest_impact| Noise {
            relative: 1e-7,
            largest_impact,
        };
        let quiet = settlement(&states, noise(0.0), 0.0);
        let struck = settlement(&states, noise(1.0), 0.0);
        assert!(!quiet.settled && struck.settled, "{quiet:?} {struck:?}");
        assert_eq!(struck.period_cycles, 1);
    }
}
