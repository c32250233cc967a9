//! Hits of an impact hammer in a force record.

use crate::{NORMAL_QUARTILE, Samples};
use serde::Serialize;

use super::HitWarning;
use crate::spectral::SpectralError;

/// Settings of the search for hits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HitSearch {
    /// Threshold of a hit, relative to the peak force of the record.
    pub trigger: f64,
    /// Threshold of the start and end of a pulse, relative to its peak.
    pub edge_ratio: f64,
    /// Threshold of a second pulse relative to the first, within `min_spacing_s` of it, for a double hit.
    pub double_hit_ratio: f64,
    /// Pulses closer than this are one hit, s.
    pub min_spacing_s: f64,
}

impl Default for HitSearch {
    fn default() -> Self {
        Self {
            trigger: 0.3,
            edge_ratio: 0.1,
            double_hit_ratio: 0.05,
            min_spacing_s: 0.05,
        }
    }
}

/// Hit of a hammer.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Hit {
    /// First sample of the pulse.
    pub start: usize,
    /// Sample of the peak force.
    pub peak: usize,
    /// Sample after the pulse.
    pub end: usize,
    /// Peak force, N.
    pub peak_force_n: f64,
    /// Time above the edge threshold, interpolated linearly between samples, s.
    pub contact_time_s: f64,
    /// Integral of the force over the pulse, N s.
    pub impulse_n_s: f64,
    /// Faults of the hit.
    pub warnings: Vec<HitWarning>,
}

/// Minimum number of samples for the shape of a pulse.
const MIN_PULSE_SAMPLES: usize = 4;
/// Ratio to the noise above which a force is a hit.
const MIN_NOISE_RATIO: f64 = 8.0;
/// Minimum number of equal samples at the top that are a flat top.
const MIN_FLAT_SAMPLES: usize = 3;

/// Detects all hits in a force record, compression positive.
///
/// # Errors
/// A record without a force above its noise.
pub fn hits(force: &Samples<'_>, search: HitSearch) -> Result<Vec<Hit>, SpectralError> {
    let values = force.values();
    let largest_n = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let noise_n = noise(values);
    if largest_n <= MIN_NOISE_RATIO * noise_n || largest_n <= 0.0 {
        return Err(SpectralError::NoHit { largest_n, noise_n });
    }
    let pulses = pulses(values, search, largest_n, noise_n);
    let min_spacing = (search.min_spacing_s * force.rate_hz()).round() as usize;
    let mut result: Vec<Hit> = Vec::new();
    for (start, peak, end) in pulses {
        match result
            .last_mut()
            .filter(|previous| peak - previous.peak <= min_spacing)
        {
            Some(previous) if values[peak] >= search.double_hit_ratio * previous.peak_force_n => {
                let after_s = (peak - previous.peak) as f64 / force.rate_hz();
                previous.warnings.push(HitWarning::Double {
                    after_s,
                    force_n: values[peak],
                });
            }
            Some(_) => {}
            None if values[peak] >= search.trigger * largest_n => {
                result.push(hit(force, search, start, peak, end))
            }
            None => {}
        }
    }
    if result.is_empty() {
        return Err(SpectralError::NoHit { largest_n, noise_n });
    }
    Ok(result)
}

/// Noise from the median of the absolute values, scaled for a normal distribution: a hit or its
/// ringing hardly affects it.
fn noise(values: &[f64]) -> f64 {
    let mut magnitudes: Vec<f64> = values.iter().map(|x| x.abs()).collect();
    let median_index = magnitudes.len() / 2;
    *magnitudes
        .select_nth_unstable_by(median_index, f64::total_cmp)
        .1
        / NORMAL_QUARTILE
}

/// First sample, peak and end of every interval above the edge of its own peak.
fn pulses(
    values: &[f64],
    search: HitSearch,
    largest_n: f64,
    noise_n: f64,
) -> Vec<(usize, usize, usize)> {
    let floor =
        (search.double_hit_ratio * search.trigger * largest_n).max(MIN_NOISE_RATIO * noise_n);
    let mut result: Vec<(usize, usize, usize)> = Vec::new();
    let mut k = 0;
    while k < values.len() {
        if values[k] < floor {
            k += 1;
            continue;
        }
        let samples_above = values[k..].iter().take_while(|x| **x >= floor).count();
        let (start, peak, end) = pulse(values, (k, k + samples_above), search.edge_ratio, floor);
        if result.last().is_none_or(|previous| previous.1 != peak) {
            result.push((start, peak, end));
        }
        k = end.max(k + samples_above);
    }
    result
}

/// First sample, maximum and end of the pulse that contains given samples. Noise may cross the
/// threshold several times during a rise, so the maximum up to the end is updated until it does not
/// change.
fn pulse(
    values: &[f64],
    (first, last): (usize, usize),
    edge_ratio: f64,
    floor: f64,
) -> (usize, usize, usize) {
    let index_of_peak = |from: usize, to: usize| {
        (from..to)
            .max_by(|a, b| values[*a].total_cmp(&values[*b]))
            .unwrap_or(from)
    };
    let mut peak = index_of_peak(first, last);
    loop {
        let threshold = (edge_ratio * values[peak]).min(floor);
        let start = (0..peak)
            .rev()
            .find(|i| values[*i] < threshold)
            .map_or(0, |i| i + 1);
        let end = (peak..values.len())
            .find(|i| values[*i] < threshold)
            .unwrap_or(values.len());
        let higher_peak = index_of_peak(start, end);
        if values[higher_peak] <= values[peak] {
            return (start, peak, end);
        }
        peak = higher_peak;
    }
}

fn hit(force: &Samples<'_>, search: HitSearch, start: usize, peak: usize, end: usize) -> Hit {
    let values = force.values();
    let threshold = search.edge_ratio * values[peak];
    let first = (0..peak).rev().find(|i| values[*i] < threshold);
    let last = (peak..values.len()).find(|i| values[*i] < threshold);
    // Interpolate linearly between the samples on both sides of the edge.
    let rising_edge = first.map_or(0.0, |i| {
        i as f64 + (threshold - values[i]) / (values[i + 1] - values[i])
    });
    let falling_edge = last.map_or(values.len() as f64, |i| {
        i as f64 - (threshold - values[i]) / (values[i - 1] - values[i])
    });
    let mut warnings = Vec::new();
    let flat_samples = values[start..end]
        .iter()
        .filter(|x| **x == values[peak])
        .count();
    if flat_samples >= MIN_FLAT_SAMPLES {
        warnings.push(HitWarning::Clipped {
            samples: flat_samples,
        });
    }
    let pulse_samples = last.unwrap_or(values.len()) - first.map_or(0, |i| i + 1);
    if pulse_samples < MIN_PULSE_SAMPLES {
        warnings.push(HitWarning::Coarse {
            samples: pulse_samples,
        });
    }
    if first.is_none() || last.is_none() {
        warnings.push(HitWarning::Cut);
    }
    Hit {
        start,
        peak,
        end,
        peak_force_n: values[peak],
        contact_time_s: (falling_edge - rising_edge) / force.rate_hz(),
        impulse_n_s: values[start..end].iter().sum::<f64>() / force.rate_hz(),
        warnings,
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    const RATE: f64 = 100_000.0;

    fn with_pulses(pulses: &[(usize, f64)]) -> Vec<f64> {
        let mut values: Vec<f64> = (0..40_000).map(|k| 0.01 * (k as f64 * 0.7).sin()).collect();
        for (at, peak) in pulses {
            // A half sine of 1 ms.
            (0..100).for_each(|k| values[at + k] += peak * (PI * k as f64 / 100.0).sin());
        }
        values
    }

    /// A half sine of length T is above a tenth of its peak for T (1 - 2 asin(0.1) / pi); measured 2e-5 relative. Its impulse is
    /// 2 F T / pi; measured 8e-5 relative.
    #[test]
    fn half_sines_have_their_known_time_and_impulse() {
        let values = with_pulses(&[(5_000, 80.0), (20_000, 60.0)]);
        let result = hits(&Samples::new(&values, RATE).unwrap(), HitSearch::default()).unwrap();
        assert_eq!(result.len(), 2);
        let time = 1e-3 * (1.0 - 2.0 * 0.1_f64.asin() / PI);
        for (hit, peak) in result.iter().zip([80.0, 60.0]) {
            assert!(
                (hit.contact_time_s / time - 1.0).abs() < 1e-4,
                "{}",
                hit.contact_time_s / time
            );
            assert!((hit.peak_force_n / peak - 1.0).abs() < 1e-3);
            assert!(
                (hit.impulse_n_s / (2.0 * peak * 1e-3 / PI) - 1.0).abs() < 1e-3,
                "{hit:?}"
            );
            assert!(hit.warnings.is_empty(), "{hit:?}");
        }
    }

    #[test]
    fn double_hits_flat_tops_and_coarse_pulses_are_reported() {
        let double_hit = with_pulses(&[(5_000, 80.0), (5_900, 12.0)]);
        let result = hits(
            &Samples::new(&double_hit, RATE).unwrap(),
            HitSearch::default(),
        )
        .unwrap();
        assert_eq!(result.len(), 1);
        let [HitWarning::Double { after_s, force_n }] = result[0].warnings[..] else {
            panic!("{result:?}")
        };
        assert!((after_s - 9e-3).abs() < 2e-5 && (force_n - 12.0).abs() < 0.1);
        let clipped: Vec<f64> = with_pulses(&[(5_000, 80.0)])
            .into_iter()
            .map(|x| x.min(60.0))
            .collect();
        let result = hits(&Samples::new(&clipped, RATE).unwrap(), HitSearch::default()).unwrap();
        assert!(
            matches!(result[0].warnings[..], [HitWarning::Clipped { samples }] if samples > 30),
            "{result:?}"
        );
        let coarse_values: Vec<f64> = with_pulses(&[(5_000, 80.0)])
            .into_iter()
            .step_by(40)
            .collect();
        let result = hits(
            &Samples::new(&coarse_values, RATE / 40.0).unwrap(),
            HitSearch::default(),
        )
        .unwrap();
        assert!(
            matches!(result[0].warnings[..], [HitWarning::Coarse { .. }]),
            "{result:?}"
        );
    }

    /// A slow rise under noise of 2 % of the peak crosses the threshold many times: the complete
    /// pulse is found in each of 40 records, its peak within four deviations of the noise and its
    /// time within 15 % of the half sine.
    #[test]
    fn a_noisy_slow_pulse_is_found() {
        let time = 5e-3 * (1.0 - 2.0 * 0.1_f64.asin() / PI);
        for seed in 0..40 {
            let mut stream = crate::RandomStream::new(seed, 0);
            let mut values: Vec<f64> = (0..20_000).map(|_| 3.0 * stream.normal_pair()[0]).collect();
            (0..500).for_each(|k| values[5_000 + k] += 150.0 * (PI * k as f64 / 500.0).sin());
            let result = hits(&Samples::new(&values, RATE).unwrap(), HitSearch::default()).unwrap();
            assert_eq!(result.len(), 1, "{seed}: {result:?}");
            assert!(
                (result[0].peak_force_n - 150.0).abs() < 12.0,
                "{seed}: {result:?}"
            );
            assert!(
                (result[0].contact_time_s / time - 1.0).abs() < 0.15,
                "{seed}: {}",
                result[0].contact_time_s / time
            );
        }
    }

    #[test]
    fn noise_is_no_hit() {
        let values = with_pulses(&[]);
        assert!(matches!(
            hits(&Samples::new(&values, RATE).unwrap(), HitSearch::default()),
            Err(SpectralError::NoHit { .. })
        ));
    }
}
