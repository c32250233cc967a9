//! Quantities of an orbit for which a user may specify a level.

use crate::{OrbitInstant, ShootingEvaluation};
use jounce_dynamics::{Trajectory, TrajectoryState};
use jounce_model::plant::Plant;

/// Samples per drive cycle in the search for the largest value.
const SAMPLES_PER_CYCLE: usize = 1024;

/// Samples between two coarse ones about the largest: the top of the parabola through the highest
/// three is within the integration error.
const REFINED_SAMPLES: usize = 16;

/// Number of such refinements: derivatives need the instant of the peak, whose error is the root of
/// that of the value.
const REFINEMENTS: usize = 3;

/// Quantity of an orbit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OrbitQuantity {
    /// Mean power of all loads and rectified circuits.
    MeanPower,
    /// Largest magnitude of the voltage of a patch, by its number.
    Voltage(usize),
    /// Largest magnitude of the strain of a patch, by its number.
    Strain(usize),
    /// Largest contact force of a stop, by its number.
    ContactForce(usize),
    /// Largest magnitude of the displacement of the point that strikes a stop, by the number of the
    /// stop.
    Displacement(usize),
}

impl OrbitQuantity {
    /// Returns the value on an orbit, SI.
    pub fn of(self, evaluation: &ShootingEvaluation) -> f64 {
        match self {
            Self::MeanPower => evaluation.loads_w.iter().sum(),
            _ => self.peak(evaluation).value,
        }
    }

    /// Returns the largest magnitude on an orbit, SI, and its instant; NaN for a mean.
    pub fn peak(self, evaluation: &ShootingEvaluation) -> OrbitPeak {
        let plant = &evaluation.kernel.plant;
        largest(evaluation, |state, at| self.at(plant, state, at))
    }

    /// Returns the magnitude at an instant with a physical state, SI; NaN for a mean.
    pub fn at(self, plant: &Plant, state: &[f64], at: &TrajectoryState) -> f64 {
        match self {
            Self::MeanPower => f64::NAN,
            Self::Voltage(patch) => plant.patch_voltages_v(state)[patch].abs(),
            Self::Strain(patch) => {
                let patch = plant.system.modes.patch.values().nth(patch);
                let places = patch.map_or(&[][..], |patch| &patch.strain);
                places
                    .iter()
                    .map(|place| place.at(state).abs())
                    .fold(0.0, larger)
            }
            Self::ContactForce(stop) => at.forces_n[stop],
            Self::Displacement(stop) => at.displacement_m(plant, &plant.ports[stop]).abs(),
        }
    }
}

/// Largest magnitude of a quantity on an orbit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OrbitPeak {
    /// Magnitude, SI.
    pub value: f64,
    /// Instant.
    pub instant: OrbitInstant,
}

/// Returns the largest value, over the period, of a function of the physical state and the sample of
/// the trajectory.
fn largest(
    evaluation: &ShootingEvaluation,
    value: impl Fn(&[f64], &TrajectoryState) -> f64,
) -> OrbitPeak {
    let plant = &evaluation.kernel.plant;
    let cycle_s = evaluation.cycle_s();
    let of_cycle = |(cycle, trajectory): (usize, &Trajectory)| {
        let at = |times_s: &[f64]| -> Vec<f64> {
            let instants = trajectory.at(&evaluation.kernel, times_s);
            instants
                .iter()
                .map(|at| value(&plant.to_physical(&at.state, at.time_s), at))
                .collect()
        };
        let step_s = cycle_s / SAMPLES_PER_CYCLE as f64;
        let rough = at(&(0..=SAMPLES_PER_CYCLE)
            .map(|k| k as f64 * step_s)
            .collect::<Vec<_>>());
        let top = highest(&rough);
        let (mut value, mut time_s, mut spacing_s) = (rough[top], top as f64 * step_s, step_s);
        for _ in 0..REFINEMENTS {
            let (from_s, closer_s) = (time_s - spacing_s, 2.0 * spacing_s / REFINED_SAMPLES as f64);
            let times: Vec<f64> = (0..=REFINED_SAMPLES)
                .map(|k| (from_s + k as f64 * closer_s).clamp(0.0, cycle_s))
                .collect();
            let (place, height) = parabola_top(&at(&times));
            if height >= value {
                (value, time_s) = (height, (from_s + place * closer_s).clamp(0.0, cycle_s));
            }
            spacing_s = closer_s;
        }
        OrbitPeak {
            value,
            instant: OrbitInstant { cycle, time_s },
        }
    };
    let start = OrbitPeak {
        value: 0.0,
        instant: OrbitInstant {
            cycle: 0,
            time_s: 0.0,
        },
    };
    let peaks = evaluation.trajectories.iter().enumerate().map(of_cycle);
    peaks.fold(start, |best, peak| {
        if is_beaten(best.value, peak.value) {
            peak
        } else {
            best
        }
    })
}

/// Returns the larger value; NaN if one is NaN.
fn larger(best: f64, value: f64) -> f64 {
    if is_beaten(best, value) { value } else { best }
}

/// True where a value replaces the largest one so far: it is larger, or the first that is NaN.
fn is_beaten(best: f64, value: f64) -> bool {
    value > best || value.is_nan() && !best.is_nan()
}

/// Returns the index of the highest value.
fn highest(values: &[f64]) -> usize {
    (0..values.len())
        .max_by(|a, b| values[*a].total_cmp(&values[*b]))
        .unwrap_or(0)
}

/// Returns place and height of the top of the parabola through the highest of equally spaced values
/// and its two neighbours.
fn parabola_top(values: &[f64]) -> (f64, f64) {
    let top = highest(values);
    if top == 0 || top + 1 >= values.len() {
        return (top as f64, values.get(top).copied().unwrap_or(0.0));
    }
    let (slope, bend) = (
        0.5 * (values[top + 1] - values[top - 1]),
        values[top + 1] - 2.0 * values[top] + values[top - 1],
    );
    if bend < 0.0 {
        (
            top as f64 - slope / bend,
            values[top] - 0.5 * slope * slope / bend,
        )
    } else {
        (top as f64, values[top])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_that_is_not_a_number_is_the_largest() {
        let largest = |values: [f64; 3]| values.into_iter().fold(0.0, larger);
        assert_eq!(largest([1.0, 3.0, 2.0]), 3.0);
        assert!(largest([1.0, f64::NAN, 2.0]).is_nan());
    }

    #[test]
    fn a_parabola_finds_its_own_top() {
        let values: Vec<f64> = (0..5).map(|k| 3.0 - (f64::from(k) - 1.7).powi(2)).collect();
        let (place, height) = parabola_top(&values);
        assert!((height - 3.0).abs() < 1e-14 && (place - 1.7).abs() < 1e-14);
        assert_eq!(parabola_top(&[1.0, 2.0, 3.0]), (2.0, 3.0));
    }
}
