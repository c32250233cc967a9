//! Windows, by what they are good for.

use std::f64::consts::TAU;

/// A window: a sum of cosines over one period of the record, `w_n = sum_m (-1)^m c_m cos(2 pi m n / N)`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Window {
    /// No window: exact where the record holds whole periods; else a line leaks and reads up to 3.92 dB low.
    Rectangular,
    /// Hann: little leakage; a line between two bins reads up to 1.42 dB low.
    Hann,
    /// Flat-top: amplitudes within 0.01 dB wherever the line falls; the line is five bins wide each side.
    #[default]
    FlatTop,
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
    /// The window's values for a record of `n` samples (periodic, as the DFT wants it).
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

    /// How many bins to each side of a line the window spreads it (the half width of its main lobe).
    pub fn half_width_bins(self) -> usize {
        match self {
            Self::Rectangular => 1,
            Self::Hann => 2,
            Self::FlatTop => 5,
        }
    }
}
