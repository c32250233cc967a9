//! Detects peaks of the responses that no mode explains.
//!
//! The sum over all responses of `|H|^2`, each over its mean square, has a peak where it is well
//! above the noise and above the valleys on both sides. The noise is the larger of two estimates:
//! from the blocks, and from the second differences of neighbouring lines. Second differences of
//! white noise have six times its variance, those of smooth responses almost 0.

use jounce_linalg::c64;

use super::{Band, Mode, Pole};

/// Minimum ratio of a peak to the higher of its two valleys, and to the noise.
const MIN_VALLEY_RATIO: f64 = 4.0;
const MIN_NOISE_RATIO: f64 = 50.0;
/// Number of lines whose second differences are combined.
const LEVEL_LINES: usize = 101;
/// Median of the squared magnitude of complex noise over its mean.
const NOISE_MEDIAN: f64 = std::f64::consts::LN_2;
/// Maximum distance in lines at which a mode explains a peak.
const EXPLAINED_LINES: f64 = 1.5;
/// Maximum number of peaks, the highest above the noise.
const MAX_PEAKS: usize = 64;

/// Peak of the responses.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct ResponsePeak {
    /// Frequency of its highest line, Hz.
    pub frequency_hz: f64,
    /// Half-width at half power, Hz.
    pub half_width_hz: f64,
    /// Ratio of its power to the noise power.
    #[serde(skip)]
    height: f64,
}

impl ResponsePeak {
    /// Pole that would produce the peak.
    pub(super) fn pole(self) -> Pole {
        Pole {
            frequency_hz: self.frequency_hz,
            damping_ratio: self.half_width_hz / self.frequency_hz,
        }
    }

    fn is_explained(&self, modes: &[Mode], line_hz: f64) -> bool {
        let tolerance_hz = self.half_width_hz.max(EXPLAINED_LINES * line_hz);
        modes
            .iter()
            .any(|mode| (mode.frequency_hz - self.frequency_hz).abs() <= tolerance_hz)
    }
}

/// Returns the unexplained peaks in ascending frequency.
pub(super) fn unexplained(band: &Band, modes: &[Mode]) -> Vec<ResponsePeak> {
    let mut remaining: Vec<ResponsePeak> = peaks(band)
        .into_iter()
        .filter(|peak| !peak.is_explained(modes, band.line_hz()))
        .collect();
    remaining.sort_by(|a, b| b.height.total_cmp(&a.height));
    remaining.truncate(MAX_PEAKS);
    remaining.sort_by(|a, b| a.frequency_hz.total_cmp(&b.frequency_hz));
    remaining
}

fn peaks(band: &Band) -> Vec<ResponsePeak> {
    let lines = band.frequency_hz.len();
    let (mut power, mut noise) = (vec![0.0; lines], vec![0.0; lines]);
    for o in 0..band.response.len() {
        let measured = band.measured(o);
        let mean = measured.iter().map(|h| h.norm_sqr()).sum::<f64>() / lines as f64;
        let noise_power = roughness(&measured);
        for k in (0..lines).filter(|_| mean > 0.0) {
            let stated_variance = band.variance.get(o).map_or(0.0, |variance| {
                variance[k] * band.as_measured(o, k).norm_sqr()
            });
            power[k] += measured[k].norm_sqr() / mean;
            noise[k] += noise_power[k].max(stated_variance) / mean;
        }
    }
    let is_local_maximum = |k: &usize| {
        power[*k] > power[k - 1]
            && power[*k] >= power[k + 1]
            && power[*k] > MIN_NOISE_RATIO * noise[*k]
    };
    let is_prominent = |k: &usize| {
        power[*k] > MIN_VALLEY_RATIO * valley(&power, *k, true).max(valley(&power, *k, false))
    };
    let peak = |k: usize| {
        let lines_above_half = |step: &dyn Fn(usize) -> usize| {
            (1..lines)
                .take_while(|n| power.get(step(*n)).is_some_and(|x| *x > 0.5 * power[k]))
                .count()
        };
        let width = lines_above_half(&|n| k + n) + lines_above_half(&|n| k.wrapping_sub(n)) + 1;
        ResponsePeak {
            frequency_hz: band.frequency_hz[k],
            half_width_hz: 0.5 * width as f64 * band.line_hz(),
            height: power[k] / noise[k].max(f64::MIN_POSITIVE),
        }
    };
    (1..lines.saturating_sub(1))
        .filter(is_local_maximum)
        .filter(is_prominent)
        .map(peak)
        .collect()
}

/// Minimum power between a line and the next higher one.
fn valley(power: &[f64], from: usize, upwards: bool) -> f64 {
    let lowest = |flank: &mut dyn Iterator<Item = &f64>| {
        flank
            .take_while(|x| **x <= power[from])
            .fold(power[from], |low, x| low.min(*x))
    };
    if upwards {
        lowest(&mut power[from..].iter())
    } else {
        lowest(&mut power[..=from].iter().rev())
    }
}

/// Noise variance from second differences, around each line.
fn roughness(values: &[c64]) -> Vec<f64> {
    let second_difference = |k: usize| {
        (values[k + 1] - 2.0 * values[k] + values[k - 1]).norm_sqr() / (6.0 * NOISE_MEDIAN)
    };
    let mut result = Vec::with_capacity(values.len());
    for from in (0..values.len()).step_by(LEVEL_LINES) {
        let end = (from + LEVEL_LINES).min(values.len());
        let mut level: Vec<f64> = (from.max(1)..end.min(values.len() - 1))
            .map(second_difference)
            .collect();
        level.sort_by(f64::total_cmp);
        let median = level
            .get(level.len() / 2)
            .copied()
            .or(result.last().copied())
            .unwrap_or(0.0);
        result.resize(end, median);
    }
    result
}
