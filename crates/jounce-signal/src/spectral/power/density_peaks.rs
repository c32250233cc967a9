//! Peaks of a density, without side lobes of its window.
//!
//! A tone of the density `S` leaks `S |W(d)|^2 / |W(0)|^2` to a line `d` lines away, where `W` is
//! the transform of the window. A maximum below the possible leakage of any higher peak, or of its
//! mirror image at a negative frequency, is a side lobe. A maximum that the rounding of the samples
//! and of the transform can have made is none. A maximum that hardly exceeds the lowest
//! line between it and a higher one is scatter. The logarithm of a line averaged over `n` segments
//! scatters by `1 / sqrt(n)`, upwards at the maximum and downwards at the lowest line.

use serde::Serialize;

use super::Spectra;

/// Peak of a density.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct DensityPeak {
    /// Frequency of its line, Hz.
    pub frequency_hz: f64,
    /// Density there, unit^2/Hz.
    pub density: f64,
}

/// Values per line of the transform of a window.
const VALUES_PER_LINE: usize = 8;
/// Number of standard deviations of a line that scatter alone does not exceed.
const SCATTER_DEVIATIONS: f64 = 4.0;

impl Spectra {
    /// Returns at most `most` peaks, the highest first.
    pub fn peaks(&self, most: usize) -> Vec<DensityPeak> {
        peaks(self, most)
    }
}

fn peaks(spectra: &Spectra, most: usize) -> Vec<DensityPeak> {
    let (density, segments) = (&spectra.density, &spectra.segments);
    let s = &density.density;
    let mut maxima: Vec<usize> = (1..s.len().saturating_sub(1))
        .filter(|k| s[*k] > s[k - 1] && s[*k] >= s[k + 1])
        .filter(|k| s[*k] > spectra.roundoff_density)
        .collect();
    maxima.sort_by(|a, b| s[*b].total_cmp(&s[*a]));
    let (leaks, rise) = (
        leakage(segments.weights()),
        (2.0 * SCATTER_DEVIATIONS / (density.segments.max(1) as f64).sqrt()).exp(),
    );
    let mut found: Vec<usize> = Vec::new();
    for k in maxima {
        let is_above_leakage = |higher: &usize| {
            let valley = s[k.min(*higher)..k.max(*higher)]
                .iter()
                .copied()
                .fold(f64::INFINITY, f64::min);
            // Leakage from the peak, from its mirror image beyond 0 or half the rate, and the
            // scatter may add up in phase.
            let image = (k + higher).min(2 * (s.len() - 1) - k - higher);
            let leak = |lines: usize| leaks[lines.min(leaks.len() - 1)];
            let leaked = [k.abs_diff(*higher), image].map(|lines| s[*higher] * leak(lines));
            // Near 0 a line and its mirror image coincide.
            let image_leak = s[k] * leak((2 * k).min(2 * (s.len() - 1 - k)));
            let limit = leaked
                .into_iter()
                .chain([image_leak, rise * valley])
                .map(f64::sqrt)
                .sum::<f64>();
            s[k] > limit * limit
        };
        if found.iter().all(is_above_leakage) {
            found.push(k);
        }
        if found.len() == most {
            break;
        }
    }
    found
        .into_iter()
        .map(|k| DensityPeak {
            frequency_hz: density.frequency_hz[k],
            density: s[k],
        })
        .collect()
}

/// Maximum leakage of a tone to a line a number of lines away, relative to its own line, for any
/// position between two lines.
fn leakage(weights: &[f64]) -> Vec<f64> {
    let mut padded = weights.to_vec();
    padded.resize(VALUES_PER_LINE * weights.len(), 0.0);
    let plan = jounce_fft::forward(padded.len());
    let mut bins = plan.make_output_vec();
    plan.process(&mut padded, &mut bins)
        .expect("the plan made the length");
    let power: Vec<f64> = bins.iter().map(|bin| bin.norm_sqr()).collect();
    // A peak's own line is at most half a line away from its tone.
    let main_lobe = power
        .get(VALUES_PER_LINE / 2)
        .copied()
        .unwrap_or(1.0)
        .max(f64::MIN_POSITIVE);
    let mut envelope = power.clone();
    for k in (0..envelope.len().saturating_sub(1)).rev() {
        envelope[k] = envelope[k].max(envelope[k + 1]);
    }
    let at = |line: usize| {
        envelope
            .get((line * VALUES_PER_LINE).saturating_sub(VALUES_PER_LINE / 2))
            .map_or(0.0, |most| most / main_lobe)
    };
    (0..=weights.len() / 2).map(at).collect()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::super::{SpectraSettings, spectra};
    use crate::RandomStream;
    use crate::{Samples, Window};
    use std::f64::consts::TAU;

    fn found(value: impl Fn(f64, f64) -> f64, window: Window) -> Vec<f64> {
        let mut stream = RandomStream::new(7, 0);
        let values: Vec<f64> = (0..32_000)
            .map(|k| value(f64::from(k) / 1000.0, stream.normal_pair()[0]))
            .collect();
        let settings = SpectraSettings {
            drive_hz: None,
            segment_s: Some(1.0),
            overlap: 0.5,
            window,
        };
        spectra(&Samples::new(&values, 1000.0).unwrap(), &settings)
            .unwrap()
            .peaks(5)
            .into_iter()
            .map(|peak| peak.frequency_hz)
            .collect()
    }

    /// Tones between two lines, the smaller one 40 dB below and 37 lines away: two peaks, the
    /// larger first, under every window with less leakage; the side lobes of a rectangular one, -37
    /// dB there, hide it.
    #[test]
    fn tones_are_peaks_by_height_and_side_lobes_none() {
        let tones =
            |t: f64, n: f64| (TAU * 100.3 * t).sin() + 0.01 * (TAU * 63.4 * t).sin() + 1e-4 * n;
        for window in [Window::Hann, Window::FlatTop] {
            assert_eq!(found(tones, window), [100.0, 63.0], "{window:?}");
        }
        assert_eq!(found(tones, Window::Rectangular), [100.0]);
        let three = |t: f64, n: f64| {
            (TAU * 50.0 * t).sin()
                + 3.0 * (TAU * 210.2 * t).sin()
                + 2.0 * (TAU * 120.7 * t).sin()
                + 0.1 * n
        };
        let peaks = found(three, Window::Hann);
        assert_eq!(
            (peaks[0], peaks[1], peaks[2]),
            (210.0, 121.0, 50.0),
            "{peaks:?}"
        );
    }

    /// A constant whose last digit changes every ten samples has peaks of rounding only; a tone of
    /// 1e-12 of the constant is more than rounding can give.
    #[test]
    fn rounding_of_the_samples_is_no_peak() {
        let flicker = |t: f64| f64::from(u8::from((t * 1000.0).round() % 10.0 == 0.0));
        let rounded = |t: f64, _| 1.0 + f64::EPSILON * flicker(t);
        assert_eq!(found(rounded, Window::Hann), [0.0; 0]);
        let tone = |t: f64, _| 1.0 + 1e-12 * (TAU * 50.0 * t).sin();
        assert_eq!(found(tone, Window::Hann)[0], 50.0);
    }

    /// The scatter of white noise does not produce a series of peaks.
    #[test]
    fn scatter_next_to_a_peak_is_no_peak() {
        let noise = found(|_, n| n, Window::Hann);
        assert_eq!(noise.len(), 1, "{noise:?}");
    }
}
