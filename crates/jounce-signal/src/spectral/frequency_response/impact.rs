//! Frequency responses of a hammer test, one block per hit, or of a shaker test if the force is
//! continuous.

use crate::{Samples, Window};
use realfft::num_complex::Complex;
use serde::Serialize;

use super::pre_trigger_check::ringing;
use super::shaker::{is_continuous, shaker_responses};
use super::{
    Estimator, FrequencyResponse, Hit, HitSearch, SpectrumAverages, WindowBias, exponential_window,
    force_window, hits,
};
use crate::spectral::{Segments, SpectralError};

/// Settings for cutting and windowing the blocks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImpactSettings {
    /// Estimator, by the assumed noise.
    pub estimator: Estimator,
    /// Length of a block, s. Default for hits: the complete record if it contains one hit, else the
    /// shortest distance between hits. Default for a continuous force: an eighth of the shortest
    /// record, or all of it for a sweep.
    pub block_s: Option<f64>,
    /// Sets the force after the hit, which is noise, to zero.
    pub force_window: bool,
    /// Final value of an exponential window on force and responses, for responses that do not decay
    /// within the block.
    pub end_ratio: Option<f64>,
    /// Treats the force as a shaker's; by default only a continuous force of both signs is.
    pub shaker: bool,
}

impl Default for ImpactSettings {
    fn default() -> Self {
        Self {
            estimator: Estimator::H1,
            block_s: None,
            force_window: false,
            end_ratio: None,
            shaker: false,
        }
    }
}

/// Record of a hammer test: the force, and responses of equal length.
#[derive(Debug, Clone)]
pub struct ImpactRecord<'a> {
    /// Force of the hammer, compression positive.
    pub force: Samples<'a>,
    /// Responses.
    pub responses: Vec<Samples<'a>>,
}

/// Hit with its record.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ImpactHit {
    /// Index of the record, from 0.
    pub record: usize,
    /// Hit.
    #[serde(flatten)]
    pub hit: Hit,
    /// False where its block would extend beyond the record, so that it was left out.
    pub used: bool,
}

/// Responses of a hammer test.
#[derive(Debug, Clone, PartialEq)]
pub struct ImpactResponses {
    /// One response function for each response.
    pub responses: Vec<FrequencyResponse>,
    /// All detected hits; empty for a continuous force.
    pub hits: Vec<ImpactHit>,
    /// True for a sweep.
    pub is_sweep: bool,
    /// Length of a block, s.
    pub block_s: f64,
    /// Damping that the exponential window adds to every mode, 1/s: the damping ratio of a mode at
    /// `w` rad/s is too high by this over `w`.
    pub window_decay_per_s: f64,
}

/// Share of a block before its hit.
const PRE_TRIGGER_SHARE: f64 = 0.01;
/// Length of the slope of the force window relative to the pulse.
const WINDOW_SLOPE_RATIO: f64 = 1.0;

/// Averages the blocks of all hits of all records, or all blocks of a continuous force.
///
/// # Errors
/// No record, records of unequal rate or number of responses, one without a hit, a block longer
/// than its record.
pub fn impact(
    records: &[ImpactRecord<'_>],
    settings: &ImpactSettings,
) -> Result<ImpactResponses, SpectralError> {
    let first = records.first().ok_or(SpectralError::Nothing)?;
    let rate_hz = first.force.rate_hz();
    for record in records {
        let mismatched = record
            .responses
            .iter()
            .find(|response| response.values().len() != record.force.values().len());
        if let Some(response) = mismatched {
            return Err(SpectralError::Lengths {
                force: record.force.values().len(),
                response: response.values().len(),
            });
        }
        if (record.force.rate_hz() / rate_hz - 1.0).abs() > 1e-6 {
            return Err(SpectralError::Rates {
                first_hz: rate_hz,
                other_hz: record.force.rate_hz(),
            });
        }
        if record.responses.len() != first.responses.len() {
            return Err(SpectralError::Lengths {
                force: first.responses.len(),
                response: record.responses.len(),
            });
        }
    }
    if settings.shaker || records.iter().all(|record| is_continuous(&record.force)) {
        return shaker_responses(records, settings);
    }
    let result = records
        .iter()
        .map(|record| hits(&record.force, HitSearch::default()))
        .collect::<Result<Vec<_>, _>>()?;
    let samples = first.force.values().len();
    let length = match settings.block_s {
        Some(block_s) => (block_s * rate_hz).round() as usize,
        None => default_block_length(records, &result),
    };
    let segments = Segments::new(length, 0.0, Window::Rectangular)?;
    if records
        .iter()
        .any(|record| record.force.values().len() < length)
    {
        return Err(SpectralError::Segment {
            segment: length,
            samples,
        });
    }
    let (decay, window_decay_per_s) = match settings.end_ratio {
        Some(end_ratio) => exponential_window(length, rate_hz, end_ratio),
        None => (vec![1.0; length], 0.0),
    };
    let mut averages = vec![SpectrumAverages::new(length / 2 + 1); first.responses.len()];
    let (mut all_hits, mut tails_s) = (Vec::new(), Vec::new());
    for (number, (record, result)) in records.iter().zip(result).enumerate() {
        let is_full_record = result.len() == 1 && record.force.values().len() == length;
        for mut hit in result {
            let start = if is_full_record {
                0
            } else {
                hit.start
                    .saturating_sub((PRE_TRIGGER_SHARE * length as f64) as usize)
            };
            let used = start + length <= record.force.values().len();
            if used {
                tails_s.push((start + length - hit.peak) as f64 / rate_hz);
                hit.warnings
                    .extend(ringing(&record.responses, (start, hit.start), length));
                let weights = force_weights(settings, &hit, start, &decay);
                let force = transform(&segments, &record.force, start, &weights)?;
                for (average, response) in averages.iter_mut().zip(&record.responses) {
                    average.add(&force, &transform(&segments, response, start, &decay)?)?;
                }
            }
            all_hits.push(ImpactHit {
                record: number,
                hit,
                used,
            });
        }
    }
    let frequency_hz = segments.frequency_hz(rate_hz);
    let window_bias = WindowBias::Cut {
        length_s: tails_s.iter().sum::<f64>() / tails_s.len().max(1) as f64,
    };
    let response = |average: &SpectrumAverages| {
        average.response(frequency_hz.clone(), settings.estimator, window_bias)
    };
    let responses = averages.iter().map(response).collect::<Result<_, _>>()?;
    Ok(ImpactResponses {
        responses,
        hits: all_hits,
        is_sweep: false,
        block_s: length as f64 / rate_hz,
        window_decay_per_s,
    })
}

/// Complete record if each contains one hit, else the shortest distance between hits or from the
/// last one to the end.
fn default_block_length(records: &[ImpactRecord<'_>], result: &[Vec<Hit>]) -> usize {
    let lengths = || records.iter().map(|record| record.force.values().len());
    if result.iter().all(|hits| hits.len() == 1) {
        return lengths().min().unwrap_or(0);
    }
    let hit_spacings = |(hits, length): (&Vec<Hit>, usize)| {
        let starts: Vec<usize> = hits.iter().map(|hit| hit.start).chain([length]).collect();
        starts
            .windows(2)
            .map(|pair| pair[1] - pair[0])
            .collect::<Vec<_>>()
    };
    // The part before a hit shortens the distance to the previous hit.
    result
        .iter()
        .zip(lengths())
        .flat_map(hit_spacings)
        .min()
        .unwrap_or(0)
        / 2
        * 2
}

fn force_weights(settings: &ImpactSettings, hit: &Hit, start: usize, decay: &[f64]) -> Vec<f64> {
    if !settings.force_window {
        return decay.to_vec();
    }
    let slope = (WINDOW_SLOPE_RATIO * (hit.end - hit.start) as f64).ceil() as usize;
    force_window(decay.len(), hit.end - start, slope)
        .iter()
        .zip(decay)
        .map(|(a, b)| a * b)
        .collect()
}

fn transform(
    segments: &Segments,
    samples: &Samples<'_>,
    start: usize,
    weights: &[f64],
) -> Result<Vec<Complex<f64>>, SpectralError> {
    let weighted: Vec<f64> = samples.values()[start..start + weights.len()]
        .iter()
        .zip(weights)
        .map(|(x, w)| x * w)
        .collect();
    Ok(segments.transform(&Samples::new(&weighted, samples.rate_hz())?, 0, 0.0))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::super::HitWarning;
    use super::super::response::tests::Oscillator;
    use super::*;

    const RATE: f64 = 1000.0;

    fn hit_force(at: &[usize], length: usize) -> Vec<f64> {
        let mut force = vec![0.0; length];
        for start in at {
            (0..8).for_each(|k| {
                force[start + k] += 50.0 * (std::f64::consts::PI * (k as f64 + 0.5) / 8.0).sin()
            });
        }
        force
    }

    /// An oscillator at 40 Hz whose response decays within a block is identified at every line
    /// below 170 Hz; measured 1.3e-12 of its peak.
    #[test]
    fn hits_in_a_row_give_the_response_of_the_system() {
        let oscillator = Oscillator::new(40.0, 0.05, RATE);
        let force = hit_force(&[200, 2400, 4800], 8000);
        let response = oscillator.simulate(&force);
        let record = ImpactRecord {
            force: Samples::new(&force, RATE).unwrap(),
            responses: vec![Samples::new(&response, RATE).unwrap()],
        };
        let result = impact(&[record], &ImpactSettings::default()).unwrap();
        assert_eq!((result.hits.len(), result.block_s), (3, 2.2));
        let measured = &result.responses[0];
        let peak = oscillator.exact(0.04).norm();
        let error = measured
            .frequency_hz
            .iter()
            .zip(&measured.value)
            .filter(|(f, _)| **f < 170.0);
        let error = error
            .map(|(f, h)| (h - oscillator.exact(f / RATE)).norm() / peak)
            .fold(0.0, f64::max);
        assert!(error < 1e-10, "{error:e}");
        assert!(measured.coherence[100] > 1.0 - 1e-9);
    }

    /// Two hits before the structure is quiet: reported for the second one, with and without noise;
    /// noise alone is not reported.
    #[test]
    fn residual_ringing_is_reported() {
        let mut stream = crate::RandomStream::new(5, 0);
        let noise: Vec<f64> = (0..8000).map(|_| stream.normal_pair()[0]).collect();
        for (damping_ratio, level, ringing) in [
            (0.002, 0.0, true),
            (0.002, 1e-2, true),
            (0.05, 1e-2, false),
            (0.05, 0.0, false),
        ] {
            let force = hit_force(&[200, 4200], 8000);
            let exact_response = Oscillator::new(40.0, damping_ratio, RATE).simulate(&force);
            let rms = (exact_response.iter().map(|x| x * x).sum::<f64>() / 8000.0).sqrt();
            let response: Vec<f64> = exact_response
                .iter()
                .zip(&noise)
                .map(|(x, n)| x + level * rms * n)
                .collect();
            let record = ImpactRecord {
                force: Samples::new(&force, RATE).unwrap(),
                responses: vec![Samples::new(&response, RATE).unwrap()],
            };
            let result = impact(
                &[record],
                &ImpactSettings {
                    block_s: Some(3.5),
                    ..ImpactSettings::default()
                },
            )
            .unwrap();
            let is_reported = |k: usize| {
                result.hits[k]
                    .hit
                    .warnings
                    .iter()
                    .any(|w| matches!(w, HitWarning::Ringing { .. }))
            };
            assert_eq!(
                (is_reported(0), is_reported(1)),
                (false, ringing),
                "{damping_ratio} {level}: {:?}",
                result.hits
            );
        }
    }

    /// A response that is longer than its block: the exponential window adds its decay to the
    /// damping and returns it. Measured 1.1 %: the nearest line is not at the peak.
    #[test]
    fn exponential_window_reports_its_added_damping() {
        let oscillator = Oscillator::new(40.0, 0.001, RATE);
        let force = hit_force(&[20], 2000);
        let response = oscillator.simulate(&force);
        let record = ImpactRecord {
            force: Samples::new(&force, RATE).unwrap(),
            responses: vec![Samples::new(&response, RATE).unwrap()],
        };
        let settings = ImpactSettings {
            end_ratio: Some(1e-4),
            ..ImpactSettings::default()
        };
        let result = impact(&[record], &settings).unwrap();
        // exp(-a k) x_k is the response of the oscillator whose poles are moved by a.
        let damped = 0.001 + result.window_decay_per_s / (std::f64::consts::TAU * 40.0);
        let peak = result.responses[0].value[60..100]
            .iter()
            .map(|h| h.norm())
            .fold(0.0, f64::max);
        let expected = Oscillator::new(40.0, damped, RATE).exact(0.04).norm();
        assert!((peak / expected - 1.0).abs() < 0.03, "{}", peak / expected);
    }

    #[test]
    fn records_that_do_not_fit_are_errors() {
        let force = hit_force(&[20], 2000);
        let short_response = vec![0.0; 1999];
        let (force, short_response) = (
            Samples::new(&force, RATE).unwrap(),
            Samples::new(&short_response, RATE).unwrap(),
        );
        let mismatched_record = ImpactRecord {
            force,
            responses: vec![short_response],
        };
        assert!(matches!(
            impact(&[mismatched_record], &ImpactSettings::default()),
            Err(SpectralError::Lengths { .. })
        ));
        let record = ImpactRecord {
            force,
            responses: vec![force],
        };
        let long_block = ImpactSettings {
            block_s: Some(3.0),
            ..ImpactSettings::default()
        };
        assert!(matches!(
            impact(std::slice::from_ref(&record), &long_block),
            Err(SpectralError::Segment { .. })
        ));
        assert!(matches!(
            impact(&[], &ImpactSettings::default()),
            Err(SpectralError::Nothing)
        ));
        let zero_record = ImpactRecord {
            force: short_response,
            responses: vec![short_response],
        };
        assert!(matches!(
            impact(&[zero_record], &ImpactSettings::default()),
            Err(SpectralError::NoHit { .. })
        ));
    }
}
