//! Windows of spectra.

use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Window: a sum of cosines over one period of the record,
/// `w_n = sum_m (-1)^m c_m cos(2 pi m n / N)`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Window {
    /// Hann: little leakage; a line between two bins reads up to 1.42 dB low.
    Hann,
    /// Flat-top: amplitudes within 0.01 dB at any position of the line; the line is five bins wide
    /// on each side.
    #[default]
    FlatTop,
    /// No window: exact for an integer number of periods; otherwise a line leaks and reads up to
    /// 3.92 dB low.
    Rectangular,
}

/// Coefficients `c_m`; flat-top: the five terms of MATLAB and SciPy.
const FLAT_TOP: [f64; 5] = [
    0.215_578_95,
    0.416_631_58,
    0.277_263_158,
    0.083_578_947,
    0.006_947_368,
];

impl Window {
    /// All windows.
    pub const ALL: [Self; 3] = [Self::Hann, Self::FlatTop, Self::Rectangular];

    /// Returns the name in options and results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Hann => "hann",
            Self::FlatTop => "flat-top",
            Self::Rectangular => "rectangular",
        }
    }

    /// Returns the periodic (DFT-even) window for a record of `n` samples.
    pub fn values(self, n: usize) -> Vec<f64> {
        let coefficients: &[f64] = match self {
            Self::Rectangular => &[1.0],
            Self::Hann => &[0.5, 0.5],
            Self::FlatTop => &FLAT_TOP,
        };
        let value = |i: usize| {
            let angle = TAU * i as f64 / n as f64;
            let sign = |m: usize| if m.is_multiple_of(2) { 1.0 } else { -1.0 };
            coefficients
                .iter()
                .enumerate()
                .map(|(m, c)| sign(m) * c * (m as f64 * angle).cos())
                .sum()
        };
        (0..n).map(value).collect()
    }
}
