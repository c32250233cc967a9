//! Mode with its uncertainties.

use jounce_linalg::c64;
use serde::Serialize;
use std::f64::consts::TAU;

use super::Pole;

/// Mode with its uncertainties.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Mode {
    /// Undamped natural frequency, Hz.
    pub frequency_hz: f64,
    /// Standard deviation of the frequency, Hz.
    pub frequency_deviation_hz: f64,
    /// Damping ratio.
    pub damping_ratio: f64,
    /// Standard deviation of the damping ratio.
    pub damping_deviation: f64,
    /// Quantile of the 95 % confidence interval, in deviations: Student's where the deviations are
    /// from few blocks.
    pub quantile_95: f64,
    /// Residue of each response, in displacement per force times rad/s; for several references, to
    /// the one with the largest participation.
    #[serde(skip)]
    pub residue: Vec<c64>,
    /// Participation of each reference in the mode, 1 at the largest: by reciprocity its shape at
    /// the force locations. One number, 1, for one reference, and for decays.
    #[serde(skip)]
    pub participation: Vec<c64>,
}

impl Mode {
    /// Half-width of the 95 % confidence interval of the frequency, Hz.
    pub fn frequency_half_width_hz(&self) -> f64 {
        self.quantile_95 * self.frequency_deviation_hz
    }

    /// Half-width of the 95 % confidence interval of the damping ratio.
    pub fn damping_half_width(&self) -> f64 {
        self.quantile_95 * self.damping_deviation
    }

    /// Mode shape at the responses: the residues divided by the largest.
    pub fn shape(&self) -> Vec<c64> {
        normalised(&self.residue)
    }

    /// Exchanges outputs and references.
    pub(super) fn swap(&mut self) {
        let largest = largest_entry(&self.residue);
        let participation = normalised(&self.residue);
        self.residue = self.participation.iter().map(|b| b * largest).collect();
        self.participation = participation;
    }

    pub(super) fn pole(&self) -> Pole {
        Pole {
            frequency_hz: self.frequency_hz,
            damping_ratio: self.damping_ratio,
        }
    }

    /// True where the interval of its damping ratio includes 0: such a pole may be noise.
    pub fn is_doubtful(&self) -> bool {
        self.damping_ratio <= self.damping_half_width()
    }

    /// Subtracts the damping added by an exponential window, in 1/s. The window shifts the pole
    /// along the real axis.
    pub fn without_decay(&mut self, decay_per_s: f64) {
        let w = TAU * self.frequency_hz;
        let (re, im) = (
            -self.damping_ratio * w + decay_per_s,
            w * (1.0 - self.damping_ratio.powi(2)).max(0.0).sqrt(),
        );
        let magnitude = re.hypot(im);
        (self.frequency_hz, self.damping_ratio) = (magnitude / TAU, -re / magnitude);
    }
}

fn largest_entry(values: &[c64]) -> c64 {
    values
        .iter()
        .copied()
        .max_by(|a, b| a.norm().total_cmp(&b.norm()))
        .unwrap_or(c64::new(1.0, 0.0))
}

pub(super) fn normalised(values: &[c64]) -> Vec<c64> {
    let largest = largest_entry(values);
    values.iter().map(|value| value / largest).collect()
}
