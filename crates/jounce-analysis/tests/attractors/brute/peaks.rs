//! Peaks of the motion of a point without stops.

use super::first_root::value_and_slope;
use super::flow::Flow;
use super::law::Phase;
use super::model::STOPS;
use super::taylor::{Coefficients, Force, ORDER};
use super::taylor_step::vector;

/// Samples of the velocity in a step.
const SAMPLES: usize = 8;

/// Peak of the motion of a point: time (s), displacement (m) and acceleration (m/s^2).
#[derive(Debug, Clone, Copy)]
pub struct Peak {
    pub time_s: f64,
    pub displacement_m: f64,
    pub acceleration_m_s2: f64,
}

impl<const N: usize, const D: usize> Flow<'_, N, D> {
    /// Returns the peaks of the displacement towards a stop, without any stop, from a state at time
    /// zero and for a duration, and its end, without acceleration.
    pub fn free_peaks(&self, stop: usize, state: [f64; D], duration_s: f64) -> Vec<Peak> {
        let (model, free) = (self.model, [Phase::Free; STOPS]);
        let (mut t, mut y, mut peaks) = (0.0, state, Vec::new());
        while t < duration_s {
            let series = model.series((t, &y), &free, (Force::Linear, 0.0));
            let size = model.weights.square(&y).sqrt().max(model.least_size());
            let end = self
                .length(&series, size, Force::Linear)
                .min(duration_s - t)
                .max(1e-9 * duration_s);
            let mut speed: Coefficients = [0.0; ORDER + 1];
            for (speed, state) in speed.iter_mut().zip(&series.state) {
                *speed = model.stops[stop].along(state)[1];
            }
            let part = |i: usize| end * i as f64 / SAMPLES as f64;
            for i in 0..SAMPLES {
                let [before, after] =
                    [part(i), part(i + 1)].map(|at| value_and_slope(&speed, at)[0]);
                if before > 0.0 && after <= 0.0 {
                    let at = falling_zero(&speed, part(i), part(i + 1));
                    peaks.push(Peak {
                        time_s: t + at,
                        displacement_m: model.stops[stop].along(&vector(&series.state, at))[0],
                        acceleration_m_s2: value_and_slope(&speed, at)[1],
                    });
                }
            }
            y = vector(&series.state, end);
            t += end;
        }
        peaks.push(Peak {
            time_s: t,
            displacement_m: model.stops[stop].along(&y)[0],
            acceleration_m_s2: 0.0,
        });
        peaks
    }
}

/// Zero of a polynomial that is positive at `low` and not at `high`, by bisection.
fn falling_zero(p: &Coefficients, mut low: f64, mut high: f64) -> f64 {
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if value_and_slope(p, middle)[0] > 0.0 {
            low = middle
        } else {
            high = middle
        }
    }
    high
}
