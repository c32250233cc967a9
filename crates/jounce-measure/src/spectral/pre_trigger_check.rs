//! Whether a structure is at rest before it is struck.

use jounce::signal::Samples;

use super::HitWarning;

/// Share of what lies before a hit that is left out: filters that keep a converter from aliasing let a pulse begin early.
const SKIPPED_SHARE: f64 = 1.0 / 3.0;
/// Samples that tell whether the structure is quiet, and from which share of the block's rms on it is not. That share is small because a
/// slow mode has small accelerations.
const MIN_QUIET_SAMPLES: usize = 16;
const MIN_RINGING_SHARE: f64 = 1e-3;
/// How far above the noise a motion must be.
const MIN_NOISE_RATIO: f64 = 2.0;

/// A response that moves before its hit, the one that moves most. Noise, known from the third differences, is no motion.
pub(super) fn ringing(
    responses: &[Samples<'_>],
    (start, hit): (usize, usize),
    length: usize,
) -> Option<HitWarning> {
    let end =
        hit.saturating_sub((SKIPPED_SHARE * hit.saturating_sub(start) as f64).ceil() as usize);
    if end < start + MIN_QUIET_SAMPLES {
        return None;
    }
    // About their own mean: an offset is no motion.
    let rms = |values: &[f64]| {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        (values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / values.len() as f64).sqrt()
    };
    let share = |response: &Samples<'_>| {
        let before = &response.values()[start..end];
        let thirds = before
            .windows(4)
            .map(|x| (x[3] - 3.0 * x[2] + 3.0 * x[1] - x[0]).powi(2))
            .sum::<f64>();
        let noise = (thirds / 20.0 / (before.len() - 3) as f64).sqrt();
        let (motion, block) = (rms(before), rms(&response.values()[start..start + length]));
        if motion > MIN_NOISE_RATIO * noise {
            motion / block
        } else {
            0.0
        }
    };
    let largest = responses.iter().map(share).fold(0.0, f64::max);
    (largest > MIN_RINGING_SHARE).then_some(HitWarning::Ringing { share: largest })
}
