//! Frequency responses of a hammer test, one block per hit, or of a shaker test if the force is
//! continuous.

use crate::Window;

use super::hit_blocks::HitBlocks;
use super::shaker::{is_continuous, shaker_responses};
use super::{Hit, HitSearch, ImpactRecord, ImpactResponses, ImpactSettings, hits};
use crate::spectral::{Segments, SpectralError};

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
        check_record(record, first)?;
    }
    if settings.shaker || records.iter().all(|record| is_continuous(&record.force)) {
        return shaker_responses(records, settings);
    }
    let result = records
        .iter()
        .map(|record| hits(&record.force, HitSearch::default()))
        .collect::<Result<Vec<_>, _>>()?;
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
            samples: first.force.values().len(),
        });
    }
    let mut blocks = HitBlocks::new(settings, segments, rate_hz, first.responses.len());
    for (number, (record, result)) in records.iter().zip(result).enumerate() {
        blocks.add(number, record, result)?;
    }
    Ok(ImpactResponses {
        responses: blocks.responses()?,
        window_decay_per_s: blocks.window_decay_per_s,
        hits: blocks.hits,
        is_sweep: false,
        block_s: length as f64 / rate_hz,
    })
}

/// Checks that the lengths within a record are equal, and its rate and number of responses those of
/// the first record.
fn check_record(record: &ImpactRecord<'_>, first: &ImpactRecord<'_>) -> Result<(), SpectralError> {
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
    let rate_hz = first.force.rate_hz();
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
    Ok(())
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

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests")]
mod tests {
    use super::super::HitWarning;
    use super::super::oscillator::Oscillator;
    use super::*;
    use crate::Samples;

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
