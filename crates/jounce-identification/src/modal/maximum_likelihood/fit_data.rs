//! Responses of a band at the lines used by a fit, with their weights.

use jounce_linalg::c64;
use rayon::prelude::*;
use std::f64::consts::TAU;

use super::line_selection::select_lines;
use crate::modal::{Band, Pole};
use jounce_signal::spectral::WindowBias;

/// Data of the fit.
pub(super) struct FitData {
    /// Indices of the lines used.
    pub lines: Vec<usize>,
    /// Their angular frequencies, rad/s.
    pub angular: Vec<f64>,
    pub window_bias: WindowBias,
    pub responses: Vec<WeightedResponse>,
    /// Measured quantities of the responses, each kind once.
    pub powers: Vec<i32>,
}

/// Response at the lines used.
pub(super) struct WeightedResponse {
    /// Index of its power of `j w` among those of the data.
    pub kind: usize,
    /// Reciprocal standard deviation of each part.
    pub weight: Vec<f64>,
    /// Response times its weight.
    pub value: Vec<c64>,
}

impl FitData {
    pub fn of(band: &Band, start: &[Pole]) -> Self {
        let lines = select_lines(&band.frequency_hz, start);
        // Without window bias, the effect of the power is absorbed by the terms above and below the
        // band.
        let power = |o: usize| {
            if band.window_bias == WindowBias::Whole {
                0
            } else {
                band.power[o]
            }
        };
        let mut powers: Vec<i32> = (0..band.response.len()).map(power).collect();
        powers.sort_unstable();
        powers.dedup();
        let weighted_response = |o: usize| {
            let kind = powers
                .iter()
                .position(|known_power| *known_power == power(o))
                .unwrap_or(0);
            let weight = weights(band, o, &lines);
            let value = lines
                .iter()
                .zip(&weight)
                .map(|(k, weight)| band.response[o][*k] * *weight)
                .collect();
            WeightedResponse {
                kind,
                weight,
                value,
            }
        };
        Self {
            angular: lines.iter().map(|k| TAU * band.frequency_hz[*k]).collect(),
            window_bias: band.window_bias,
            responses: (0..band.response.len())
                .into_par_iter()
                .map(weighted_response)
                .collect(),
            lines,
            powers,
        }
    }

    /// True where one more term per response decreases the error by more than its two numbers would
    /// for noise.
    pub fn justifies_terms(&self, previous_error: f64, new_error: f64) -> bool {
        let numbers = (2 * self.angular.len() * self.responses.len()) as f64;
        numbers * (previous_error / new_error).ln() >= 4.0 * self.responses.len() as f64
    }
}

/// Weight of each line of a response: the reciprocal standard deviation of each part. Where
/// unknown, the noise is assumed white in the measured quantity, so that low lines of an
/// acceleration are not weighted as those of its double integral.
fn weights(band: &Band, o: usize, lines: &[usize]) -> Vec<f64> {
    match band.variance.get(o) {
        Some(variance) => lines.iter().map(|k| (2.0 / variance[*k]).sqrt()).collect(),
        None => {
            let measured = band.measured(o);
            let rms = (measured.iter().map(|h| h.norm_sqr()).sum::<f64>() / measured.len() as f64)
                .sqrt()
                .max(f64::MIN_POSITIVE);
            lines
                .iter()
                .map(|k| band.as_measured(o, *k).norm() / rms)
                .collect()
        }
    }
}
