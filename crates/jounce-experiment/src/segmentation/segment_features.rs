//! Features of a segment, corrected for noise.

use jounce_linalg::c64;

/// Relative difference below which amplitudes are equal.
pub(super) const EQUAL_AMPLITUDE_SHARE: f64 = 0.05;
/// Noise deviations below which a difference is insignificant.
pub(super) const NOISE_DEVIATIONS: f64 = 3.0;
/// Maximum residual of one waveform after scaling, relative to the other, for equal shapes.
const SAME_SHAPE_SHARE: f64 = 0.1;
/// Features of one segment, corrected for noise.
pub(super) struct SegmentFeatures {
    pub amplitude: Vec<f64>,
    /// Standard deviation of each amplitude.
    deviation: f64,
    /// Noise of the lines of a block.
    pub noise: f64,
}

impl SegmentFeatures {
    pub fn of(lines: &[Vec<c64>]) -> Self {
        let (count, orders) = (lines.len() as f64, lines.first().map_or(0, Vec::len));
        let steps = (lines.len().saturating_sub(1)).max(1) as f64;
        let noise = |j: usize| {
            lines
                .windows(2)
                .map(|pair| (pair[1][j] - pair[0][j]).norm_sqr())
                .sum::<f64>()
                / (2.0 * steps)
        };
        let mean_square =
            |j: usize| lines.iter().map(|block| block[j].norm_sqr()).sum::<f64>() / count;
        let amplitude = (0..orders)
            .map(|j| (mean_square(j) - noise(j)).max(0.0).sqrt())
            .collect();
        let noise_rms = ((0..orders).map(noise).sum::<f64>() / orders.max(1) as f64).sqrt();
        Self {
            amplitude,
            deviation: noise_rms / count.max(1.0).sqrt(),
            noise: noise_rms,
        }
    }

    pub fn largest_amplitude(&self) -> f64 {
        self.amplitude.iter().copied().fold(0.0, f64::max)
    }

    /// Largest difference of two amplitudes.
    pub fn amplitude_difference(&self, other: &Self) -> f64 {
        self.amplitude
            .iter()
            .zip(&other.amplitude)
            .map(|(a, b)| (a - b).abs())
            .fold(0.0, f64::max)
    }

    pub fn equals(&self, other: &Self) -> bool {
        let noise = NOISE_DEVIATIONS * self.deviation.hypot(other.deviation);
        self.amplitude_difference(other)
            < EQUAL_AMPLITUDE_SHARE * self.largest_amplitude().max(other.largest_amplitude())
                + noise
    }

    /// True where the amplitudes are equal except for a common factor.
    pub fn is_shaped_as(&self, other: &Self) -> bool {
        let product = |a: &Self, b: &Self| {
            a.amplitude
                .iter()
                .zip(&b.amplitude)
                .map(|(a, b)| a * b)
                .sum::<f64>()
        };
        let (one, two) = (product(self, self), product(other, other));
        one * two > 0.0
            && 1.0 - product(self, other).powi(2) / (one * two)
                < SAME_SHAPE_SHARE * SAME_SHAPE_SHARE
    }
}
